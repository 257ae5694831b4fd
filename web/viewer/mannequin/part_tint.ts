/** A tint on the parts of a body that follow certain joints. */

import { Color, type IUniform, type Material } from "three";
import { JOINT, type Role } from "../../humanoid";
import { RIGID_SLOTS, SLOT_JOINTS, SLOTS } from "../../mannequin/slots";
import { editShader } from "./shader_edit";

/** Share of the tint in the colour of a tinted part. */
const SHARE = 0.34;
/** Bits of a mask word. */
const WORD = 31;

/** Uniforms of one body. */
interface TintUniforms {
  [name: string]: IUniform;
  /** One bit per slot, in two words. */
  tintedSlots: IUniform<[number, number]>;
  tint: IUniform<Color>;
}

/** No part is tinted. */
export function noTint(): TintUniforms {
  return { tintedSlots: { value: [0, 0] }, tint: { value: new Color() } };
}

/** The mask of the slots that follow some joints; the waist follows the spine. */
export function slotsOf(joints: readonly Role[]): [number, number] {
  const numbers = new Set(joints.map((role) => JOINT[role]));
  const mask: [number, number] = [0, 0];
  for (const slot of SLOTS.keys()) {
    const joint = slot < RIGID_SLOTS.length ? SLOT_JOINTS[slot]! : JOINT.spine;
    if (numbers.has(joint)) mask[slot < WORD ? 0 : 1] |= 1 << (slot % WORD);
  }
  return mask;
}

/** Tints one of three.js's own materials that skins by slots; call it before `useSlots`. */
export function useTint(material: Material, uniforms: TintUniforms): void {
  editShader(material, uniforms, (shader) => {
    shader.vertexShader = shader.vertexShader
      .replace("void main() {", "uniform ivec2 tintedSlots;\nvarying float vTinted;\nvoid main() {")
      .replace(
        "#include <begin_vertex>",
        `#include <begin_vertex>
  int slotNumber = int(slot + 0.5);
  int word = slotNumber < ${WORD} ? tintedSlots.x : tintedSlots.y;
  vTinted = float((word >> (slotNumber % ${WORD})) & 1);`,
      );
    shader.fragmentShader = shader.fragmentShader
      .replace("void main() {", "uniform vec3 tint;\nvarying float vTinted;\nvoid main() {")
      .replace(
        "#include <color_fragment>",
        `#include <color_fragment>\n  diffuseColor.rgb = mix(diffuseColor.rgb, tint, ${SHARE} * vTinted);`,
      );
  });
}
