/** Rotations as quaternions x y z w and as vectors: an axis times an angle, the exponential map. */

export type Vector = readonly [x: number, y: number, z: number];
export type Quaternion = readonly [x: number, y: number, z: number, w: number];

/** Degrees per radian. */
export const DEGREES = 180 / Math.PI;

/** Below this the sine of half an angle equals half the angle, to double precision. */
const TINY = 1e-8;

/** The rotation by a vector's length, radians, about its direction. */
export function exp([x, y, z]: Vector): Quaternion {
  const angle = Math.hypot(x, y, z);
  const scale = angle < TINY ? 0.5 : Math.sin(angle / 2) / angle;
  return [scale * x, scale * y, scale * z, Math.cos(angle / 2)];
}

/** The vector of a rotation, with length 0 to π: the inverse of {@link exp}. */
export function log([x, y, z, w]: Quaternion): Vector {
  // q and −q are the same rotation; the one with w ≥ 0 has the smaller angle.
  const sign = w < 0 ? -1 : 1;
  const sine = Math.hypot(x, y, z);
  const scale = sign * (sine < TINY ? 2 : (2 * Math.atan2(sine, Math.abs(w))) / sine);
  return [scale * x, scale * y, scale * z];
}

/** First `b`, then `a`. */
export function multiply([ax, ay, az, aw]: Quaternion, [bx, by, bz, bw]: Quaternion): Quaternion {
  return [
    aw * bx + ax * bw + ay * bz - az * by,
    aw * by - ax * bz + ay * bw + az * bx,
    aw * bz + ax * by - ay * bx + az * bw,
    aw * bw - ax * bx - ay * by - az * bz,
  ];
}

/** The inverse rotation of a unit quaternion. */
export function inverse([x, y, z, w]: Quaternion): Quaternion {
  return [-x, -y, -z, w];
}

/** A vector rotated by a unit quaternion. */
export function turned(q: Quaternion, [x, y, z]: Vector): Vector {
  const [a, b, c] = multiply(multiply(q, [x, y, z, 0]), inverse(q));
  return [a, b, c];
}

/** The quaternion at an index, of four numbers each. */
export function quaternionAt(numbers: ArrayLike<number>, index: number): Quaternion {
  return [numbers[4 * index]!, numbers[4 * index + 1]!, numbers[4 * index + 2]!, numbers[4 * index + 3]!];
}
