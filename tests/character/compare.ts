/** Comparison of two copies of a character, or of two rotations. */
import { type Object3D, Quaternion, Vector3 } from "three";
import { POSE_FLOATS, ROLES } from "../../web/humanoid";

/** Difference of two objects: millimetres and degrees. */
export interface Difference {
  millimetres: number;
  degrees: number;
}

/** Returns the degrees between two rotations. Unlike `angleTo` it is accurate for small angles. */
export function angleBetween(a: Quaternion, b: Quaternion): number {
  const { x, y, z } = a.clone().normalize().invert().multiply(b.clone().normalize());
  return (2 * Math.asin(Math.min(1, Math.hypot(x, y, z))) * 180) / Math.PI;
}

/** Returns corresponding nodes of two copies of a file. */
export function pairs(a: Object3D, b: Object3D): [Object3D, Object3D][] {
  return [[a, b], ...a.children.flatMap((child, i) => pairs(child, b.children[i]!))];
}

/** Returns the largest world difference between corresponding nodes. Their world matrices must be up to date. */
export function farthest(
  twins: readonly (readonly [Object3D, Object3D])[],
  so: Difference = { millimetres: 0, degrees: 0 },
) {
  for (const [a, b] of twins) {
    const distance = a.getWorldPosition(new Vector3()).distanceTo(b.getWorldPosition(new Vector3()));
    const angle = angleBetween(a.getWorldQuaternion(new Quaternion()), b.getWorldQuaternion(new Quaternion()));
    so = { millimetres: Math.max(so.millimetres, 1000 * distance), degrees: Math.max(so.degrees, angle) };
  }
  return so;
}

/**
 * Returns the largest angle between the joints of two motions, frame by frame, in degrees.
 * @param but names of roles that are not compared
 */
export function turnsApart(
  a: Float32Array,
  b: Float32Array,
  frames: number,
  but?: RegExp,
): { degrees: number; role: string } {
  let worst = { degrees: 0, role: "" };
  for (let f = 0; f < frames; f++)
    for (const [j, role] of ROLES.entries()) {
      if (but?.test(role)) continue;
      const at = f * POSE_FLOATS + 3 + 4 * j;
      const degrees = angleBetween(new Quaternion().fromArray(a, at), new Quaternion().fromArray(b, at));
      if (degrees > worst.degrees) worst = { degrees, role };
    }
  return worst;
}
