/** Edits of three.js's own shaders. */

import type { IUniform, Material, WebGLProgramParametersWithUniforms } from "three";

/** Gives a material's shader uniforms and edits it, after any edit that was made before. */
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
