/** Where the soles of a character lie: at the lowest vertex of the skin of its feet (`shared/spec/embedding.md` 5.4). */
import { Quaternion, Vector3 } from "three";
import { JOINT } from "../humanoid";
import type { Joints } from "./joints";

/** Weight from which a vertex belongs to the foot. */
const OF_THE_FOOT = 0.5;

/**
 * Height of the soles in the bind pose along the body's up axis, in the unit of the joints; `undefined` where no skin
 * follows the feet.
 * @param roles joint of each role, −1 where there is none
 * @param worldFromFile from the axes of the file to ours, xyzw
 */
export function soleHeight(joints: Joints, roles: Int32Array, worldFromFile: ArrayLike<number>): number | undefined {
  const feet = new Set<number>();
  for (const [joint, parent] of joints.parents.entries())
    if (joint === roles[JOINT.left_foot] || joint === roles[JOINT.right_foot] || feet.has(parent)) feet.add(joint);
  const footNodes = new Set([...feet].map((joint) => joints.nodes[joint]!));
  const up = new Vector3(0, 1, 0).applyQuaternion(new Quaternion().fromArray(worldFromFile).invert());
  let lowest = Infinity;
  const point = new Vector3();
  for (const { mesh, objectFromSkin } of joints.skins) {
    const { position, skinIndex, skinWeight } = mesh.geometry.attributes;
    if (!position || !skinIndex || !skinWeight) continue;
    const isFoot = mesh.skeleton.bones.map((bone) => bone !== undefined && footNodes.has(bone));
    if (!isFoot.includes(true)) continue;
    const matrix = objectFromSkin.clone().multiply(mesh.bindMatrix);
    for (let v = 0; v < position.count; v++) {
      let weight = 0;
      for (let k = 0; k < 4; k++) if (isFoot[skinIndex.getComponent(v, k)]) weight += skinWeight.getComponent(v, k);
      if (weight < OF_THE_FOOT) continue;
      point.fromBufferAttribute(position, v).applyMatrix4(matrix);
      lowest = Math.min(lowest, point.dot(up));
    }
  }
  return Number.isFinite(lowest) ? lowest : undefined;
}
