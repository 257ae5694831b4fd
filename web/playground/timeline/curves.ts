/**
 * Joint angles over time, from poses of the canonical humanoid (`rust/strut-core/src/humanoid.rs`): what the
 * timeline draws. Pure.
 */
import { POSE_FLOATS } from "../../worker/protocol";

type Vector = readonly [number, number, number];

/** How a joint's rotation becomes one angle, in degrees, of the bone that hangs on it. */
interface Measure {
  /** Index of the joint. */
  joint: number;
  /** Direction of its bone in the T-pose, +X left, +Y up, +Z forward. */
  bone: Vector;
  /** `bend`: how far the bone turned, 0–180; `swing`: forward of hanging down; `lean`: forward of upright. */
  kind: "bend" | "swing" | "lean";
}

const DOWN: Vector = [0, -1, 0];
const UP: Vector = [0, 1, 0];

/** Joints that the timeline offers, by name. */
export const CURVES: Readonly<Record<string, Measure>> = {
  "knee L": { joint: 14, bone: DOWN, kind: "bend" },
  "knee R": { joint: 18, bone: DOWN, kind: "bend" },
  "hip L": { joint: 13, bone: DOWN, kind: "swing" },
  "hip R": { joint: 17, bone: DOWN, kind: "swing" },
  "elbow L": { joint: 7, bone: [1, 0, 0], kind: "bend" },
  "elbow R": { joint: 11, bone: [-1, 0, 0], kind: "bend" },
  "shoulder L": { joint: 6, bone: [1, 0, 0], kind: "swing" },
  "shoulder R": { joint: 10, bone: [-1, 0, 0], kind: "swing" },
  "chest lean": { joint: 2, bone: UP, kind: "lean" },
  "head lean": { joint: 4, bone: UP, kind: "lean" },
};

const DEGREES = 180 / Math.PI;

/** v turned by the quaternion at `offset` (x y z w): v + 2w(u×v) + 2u×(u×v). */
function rotated(q: ArrayLike<number>, offset: number, v: Vector): Vector {
  const [x, y, z, w] = [q[offset]!, q[offset + 1]!, q[offset + 2]!, q[offset + 3]!];
  const tx = 2 * (y * v[2] - z * v[1]);
  const ty = 2 * (z * v[0] - x * v[2]);
  const tz = 2 * (x * v[1] - y * v[0]);
  return [v[0] + w * tx + y * tz - z * ty, v[1] + w * ty + z * tx - x * tz, v[2] + w * tz + x * ty - y * tx];
}

/** The angle of one pose that begins at `start` in `poses`, degrees. */
export function angleAt(poses: ArrayLike<number>, start: number, { joint, bone, kind }: Measure): number {
  const [x, y, z] = rotated(poses, start + 3 + 4 * joint, bone);
  switch (kind) {
    case "bend":
      return Math.acos(Math.min(1, Math.max(-1, x * bone[0] + y * bone[1] + z * bone[2]))) * DEGREES;
    case "swing":
      return Math.atan2(z, -y) * DEGREES;
    case "lean":
      return Math.atan2(z, y) * DEGREES;
  }
}

/** The angle of every pose of a clip, degrees. */
export function curveOf(poses: Float32Array, measure: Measure): Float32Array {
  const frames = Math.floor(poses.length / POSE_FLOATS);
  return Float32Array.from({ length: frames }, (_, i) => angleAt(poses, i * POSE_FLOATS, measure));
}

/** Least and greatest value of several curves, with some air, at least `least` apart; `undefined` without values. */
export function spanOf(curves: readonly Float32Array[], least: number): { low: number; high: number } | undefined {
  let [low, high] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  for (const curve of curves)
    for (const value of curve) {
      low = Math.min(low, value);
      high = Math.max(high, value);
    }
  if (low > high) return undefined;
  const air = Math.max(0, least - (high - low)) / 2 + 0.06 * (high - low);
  return { low: low - air, high: high + air };
}

/** Stretches of frames, [from, to), in which a foot is planted; `contacts` has two per frame, `foot` is 0 or 1. */
export function plantedStretches(contacts: Uint8Array, foot: 0 | 1): [number, number][] {
  const stretches: [number, number][] = [];
  const frames = contacts.length / 2;
  let from = -1;
  for (let i = 0; i <= frames; i++) {
    const planted = i < frames && contacts[2 * i + foot] === 1;
    if (planted && from < 0) from = i;
    if (!planted && from >= 0) {
      stretches.push([from, i]);
      from = -1;
    }
  }
  return stretches;
}

/**
 * Input frames (fractional) at which the output passes multiples of `everySecs`: dense ticks where the style takes
 * longer than the input, wide ones where it is quicker.
 */
export function timingTicks(timeOut: Float32Array, everySecs: number): number[] {
  const ticks: number[] = [];
  let next = timeOut.length > 0 ? timeOut[0]! : 0;
  for (let i = 1; i < timeOut.length; i++) {
    const [before, after] = [timeOut[i - 1]!, timeOut[i]!];
    while (next <= after && after > before) {
      ticks.push(i - 1 + (next - before) / (after - before));
      next += everySecs;
    }
  }
  return ticks;
}

/** Spacing of labelled ticks in seconds so that they stand at least `minPx` apart: 1, 2 or 5 times a power of ten. */
export function tickSpacing(durationSecs: number, widthPx: number, minPx: number): number {
  const least = (durationSecs * minPx) / Math.max(1, widthPx);
  const power = 10 ** Math.floor(Math.log10(Math.max(least, 1e-3)));
  return ([1, 2, 5, 10].find((m) => m * power >= least) ?? 10) * power;
}
