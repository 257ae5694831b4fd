/** The bones of a character in the picture: which one is at a point, and where a head is. */
import { MathUtils, Quaternion, Vector3 } from "three";
import { JOINT, type Role, type WorldPose } from "../humanoid";
import type { Fit } from "../mannequin/fit";

/** Bones that can be clicked: the joint that rotates each one, and its ends. */
const BONES: readonly [Role, Role, Role][] = [
  ["hips", "hips", "hips"],
  ["spine", "spine", "chest"],
  ["chest", "chest", "neck"],
  ["head", "neck", "head"],
  ...(["left", "right"] as const).flatMap((side): [Role, Role, Role][] => [
    [`${side}_upper_arm`, `${side}_upper_arm`, `${side}_lower_arm`],
    [`${side}_lower_arm`, `${side}_lower_arm`, `${side}_hand`],
    [`${side}_hand`, `${side}_hand`, `${side}_hand`],
    [`${side}_upper_leg`, `${side}_upper_leg`, `${side}_lower_leg`],
    [`${side}_lower_leg`, `${side}_lower_leg`, `${side}_foot`],
    [`${side}_foot`, `${side}_foot`, `${side}_toes`],
  ]),
];
/** A click within this distance of a bone hits it, however small the character is. */
const MIN_REACH_PX = 10;
/** Middle of a mannequin's head above its joint, and its radius, relative to its stature. */
const HEAD = { rise: 0.088, radius: 0.122 };

/** Returns the joint whose bone is at a point of the picture, or `undefined`. @param placeOf position of a joint */
export function jointNear(x: number, y: number, placeOf: (role: Role) => { x: number; y: number }): Role | undefined {
  let nearest: { role: Role; distance: number } | undefined;
  for (const [bone, from, to] of BONES) {
    const [a, b] = [placeOf(from), placeOf(to)];
    const length = Math.hypot(b.x - a.x, b.y - a.y) || 1;
    const along = MathUtils.clamp(((x - a.x) * (b.x - a.x) + (y - a.y) * (b.y - a.y)) / length ** 2, 0, 1);
    const distance = Math.hypot(x - a.x - along * (b.x - a.x), y - a.y - along * (b.y - a.y));
    if (!nearest || distance < nearest.distance) nearest = { role: bone, distance };
  }
  // The trunk is half as wide as it is long.
  const [neck, hips] = [placeOf("neck"), placeOf("hips")];
  const reach = Math.max(MIN_REACH_PX, Math.hypot(neck.x - hips.x, neck.y - hips.y) / 4);
  return nearest && nearest.distance <= reach ? nearest.role : undefined;
}

/** Middle of a mannequin's head above its joint, and its radius, metres. */
export function headOf({ stature }: Pick<Fit, "stature">): { rise: number; radius: number } {
  return { rise: HEAD.rise * stature, radius: HEAD.radius * stature };
}

const head = new Vector3();
const joint = new Vector3();
const rotation = new Quaternion();

/** The middle of a head, `rise` metres above its joint. The next call overwrites it. */
export function aboveHead({ positions, rotations }: WorldPose, rise: number): Vector3 {
  rotation.fromArray(rotations, 4 * JOINT.head);
  return head
    .set(0, rise, 0)
    .applyQuaternion(rotation)
    .add(joint.fromArray(positions, 3 * JOINT.head));
}
