/** The canonical humanoid in glTF: its joints as nodes 0 to 20, in canonical order, and its animations. */

import { JOINTS, PARENTS } from "../humanoid";
import { type HumanoidAnimation, hipsPositions, jointRotations } from "./animation";
import type { BufferBuilder } from "./glb";

/**
 * The joints as nodes in the T-pose, without rotations or scales.
 *
 * @param names - Names of the nodes, 21.
 * @param hips - Position of the hips, xyz, metres.
 * @param offsets - Bone offsets, 21 × xyz, metres; the hips' entry is not used.
 */
export function jointNodes(names: readonly string[], hips: ArrayLike<number>, offsets: ArrayLike<number>): object[] {
  return names.map((name, j) => {
    const translation = j === 0 ? Array.from(hips) : [0, 1, 2].map((axis) => offsets[3 * j + axis]!);
    const children = PARENTS.flatMap((parent, child) => (parent === j ? [child] : []));
    return { name, translation, ...(children.length > 0 ? { children } : {}) };
  });
}

/** glTF's animation of nodes 0 to 20: one translation of the hips and one rotation per joint, one key per frame. */
export function jointAnimation(buffer: BufferBuilder, animation: HumanoidAnimation): object {
  const input = buffer.add(animation.times, "SCALAR", true);
  const samplers: object[] = [];
  const channels: object[] = [];
  const add = (node: number, path: string, output: number) => {
    samplers.push({ input, output, interpolation: "LINEAR" });
    channels.push({ sampler: samplers.length - 1, target: { node, path } });
  };
  add(0, "translation", buffer.add(hipsPositions(animation), "VEC3"));
  for (let j = 0; j < JOINTS; j++) add(j, "rotation", buffer.add(jointRotations(animation, j), "VEC4"));
  return { name: animation.name, samplers, channels };
}
