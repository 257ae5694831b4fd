/**
 * An animation as VRM Animation 1.0: binary glTF with the extension `VRMC_vrm_animation`, which plays on every VRM. The
 * nodes rest in the T-pose facing +Z without rotations or scales, like the canonical humanoid, so that its rotations
 * are VRM's.
 */

import { JOINTS, ROLES, type Role } from "../humanoid";
import type { HumanoidAnimation } from "./animation";
import { BufferBuilder, glbFile } from "./glb";
import { jointAnimation, jointNodes } from "./humanoid_gltf";

const EXTENSION = "VRMC_vrm_animation";

/**
 * VRM's name of a role. The roles are VRM's bones in another case. The chest of the canonical humanoid carries neck and
 * shoulders and is VRM's `chest`, because VRM allows `upperChest` only together with it.
 */
const vrmBone = (role: Role): string => role.replace(/_(.)/g, (_, letter: string) => letter.toUpperCase());

/**
 * Writes the file: the hips' translation and 21 rotations, one key per frame at the animation's times. There is no
 * mesh.
 *
 * @throws RangeError unless there are 63 proportions.
 */
export function vrmAnimation(animation: HumanoidAnimation): Uint8Array<ArrayBuffer> {
  const { proportions } = animation;
  if (proportions.length !== 3 * JOINTS)
    throw new RangeError(`expected ${3 * JOINTS} numbers, not ${proportions.length}`);
  const buffer = new BufferBuilder();
  const bones = ROLES.map(vrmBone);
  const humanBones = Object.fromEntries(bones.map((bone, node) => [bone, { node }]));
  const content = {
    extensionsUsed: [EXTENSION],
    extensions: { [EXTENSION]: { specVersion: "1.0", humanoid: { humanBones } } },
    scene: 0,
    scenes: [{ nodes: [0] }],
    // Readers scale the hips' motion by their height at rest, which is the body's, above the soles.
    nodes: jointNodes(bones, [0, proportions[1]!, 0], proportions),
    animations: [jointAnimation(buffer, animation)],
  };
  return glbFile(content, buffer);
}
