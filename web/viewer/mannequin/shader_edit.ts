/** Edits of three.js's own shaders. */

import type { IUniform, Material, WebGLProgramParametersWithUniforms } from "three";

/** Adds uniforms to a material's shader and edits it, after any earlier edit. */
export function editShader(
  material: Material,
  uniforms: Record<string, IUniform>,
  edit: (shader: WebGLProgramParametersWithUniforms) => void,
): void {
  const before = material.onBeforeCompile;
  material.onBeforeCompile = (shader, renderer) => {
    before.call(material, shader, renderer);
    Object.assign(shader.uniforms, uniforms);
    edit(shader);
  };
}
