/**
 * Skinning by slots in the vertex shader: every vertex belongs to exactly one slot, so it costs one affine transform
 * from uniforms, a quarter of general skinning, and no texture.
 */

import type { IUniform, Material } from "three";
import { SLOTS } from "../../mannequin/slots";
import { editShader } from "./shader_edit";

/** Uniforms of one mannequin, shared by all its materials. */
export interface SlotUniforms {
  [name: string]: IUniform;
  /** Three rows per slot, see `SlotRows`. */
  slotRows: IUniform<Float32Array>;
}

/** GLSL: `slotPoint(p)` and `slotDirection(n)`, from the vertex's slot to the world. */
export const SLOT_SHADER = /* glsl */ `
attribute float slot;
uniform vec4 slotRows[${3 * SLOTS.length}];
vec3 slotPoint(vec3 p) {
  int row = 3 * int(slot + 0.5);
  vec4 q = vec4(p, 1.0);
  return vec3(dot(slotRows[row], q), dot(slotRows[row + 1], q), dot(slotRows[row + 2], q));
}
vec3 slotDirection(vec3 n) {
  int row = 3 * int(slot + 0.5);
  return vec3(dot(slotRows[row].xyz, n), dot(slotRows[row + 1].xyz, n), dot(slotRows[row + 2].xyz, n));
}`;

/** Makes one of three.js's own materials skin by slots; runs after any earlier edit of its shader. */
export function useSlots(material: Material, uniforms: SlotUniforms): void {
  editShader(material, uniforms, (shader) => {
    shader.vertexShader = shader.vertexShader
      .replace("void main() {", `${SLOT_SHADER}\nvoid main() {`)
      .replace("#include <beginnormal_vertex>", "vec3 objectNormal = slotDirection(normal);")
      .replace("#include <begin_vertex>", "vec3 transformed = slotPoint(position);");
  });
}
