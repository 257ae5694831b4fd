/** Vectors, unit quaternions and affine matrices in plain tuples and arrays, as the mannequin needs them. */

/** A direction, a point or three factors. */
export type Vec3 = readonly [x: number, y: number, z: number];

/** A rotation as a unit quaternion. */
export type Quat = readonly [x: number, y: number, z: number, w: number];

/** The identity rotation. */
export const NO_TURN: Quat = [0, 0, 0, 1];

/** Component-wise sum. */
export const sum = (a: Vec3, b: Vec3): Vec3 => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];

/** Component-wise difference. */
export const difference = (a: Vec3, b: Vec3): Vec3 => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];

/** Component-wise product. */
export const product = (a: Vec3, b: Vec3): Vec3 => [a[0] * b[0], a[1] * b[1], a[2] * b[2]];

/** A vector times a number. */
export const scaled = (v: Vec3, factor: number): Vec3 => [v[0] * factor, v[1] * factor, v[2] * factor];

/** Euclidean length. */
export const lengthOf = (v: Vec3): number => Math.sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);

/** The shortest rotation from one unit vector to another; for opposite ones, half a turn about any normal. */
export function turnBetween(from: Vec3, to: Vec3): Quat {
  const w = from[0] * to[0] + from[1] * to[1] + from[2] * to[2] + 1;
  if (w >= 1e-8)
    return unit([
      from[1] * to[2] - from[2] * to[1],
      from[2] * to[0] - from[0] * to[2],
      from[0] * to[1] - from[1] * to[0],
      w,
    ]);
  return unit(Math.abs(from[0]) > Math.abs(from[2]) ? [-from[1], from[0], 0, 0] : [0, -from[2], from[1], 0]);
}

/** The rotation about +Y by an angle in radians. */
export const turnAboutUp = (angle: number): Quat => [0, Math.sin(angle / 2), 0, Math.cos(angle / 2)];

/**
 * Writes translation · rotation · scale as a 4 × 4 matrix, column-major.
 *
 * @param out - Receives 16 numbers.
 * @param offset - Index of the first of them.
 */
export function composeInto(out: Float32Array, offset: number, position: Vec3, [x, y, z, w]: Quat, scale: Vec3): void {
  const [x2, y2, z2] = [x + x, y + y, z + z];
  const [xx, xy, xz, yy, yz, zz] = [x * x2, x * y2, x * z2, y * y2, y * z2, z * z2];
  const [wx, wy, wz] = [w * x2, w * y2, w * z2];
  const [sx, sy, sz] = scale;
  out.set([(1 - (yy + zz)) * sx, (xy + wz) * sx, (xz - wy) * sx, 0], offset);
  out.set([(xy - wz) * sy, (1 - (xx + zz)) * sy, (yz + wx) * sy, 0], offset + 4);
  out.set([(xz + wy) * sz, (yz - wx) * sz, (1 - (xx + yy)) * sz, 0], offset + 8);
  out.set([...position, 1], offset + 12);
}

function unit([x, y, z, w]: Quat): Quat {
  const scale = 1 / Math.sqrt(x * x + y * y + z * z + w * w);
  return [x * scale, y * scale, z * scale, w * scale];
}
