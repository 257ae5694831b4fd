/**
 * Joint angles over time, from poses of the canonical humanoid (`rust/strut-core/src/humanoid.rs`), for the timeline.
 * Pure functions.
 */

import type { CurveSubject } from "../../../../client/protocol";
import { POSE_FLOATS, ROLES } from "../../../../humanoid";
import { strings } from "../../../strings/strings";

type Vector = readonly [number, number, number];

/** Converts a pose to a number. */
export type Measure =
  /**
   * The angle, in degrees, of the child bone of a joint. `bone` is its direction in the T-pose, +X left, +Y up, +Z
   * forward; `bend`: the angle of rotation, 0–180; `swing`: forward of hanging down; `lean`: forward of upright.
   */
  | { kind: "bend" | "swing" | "lean"; joint: number; bone: Vector }
  /** One component of a joint's rotation vector, degrees: a degree of freedom of the engine. */
  | { kind: "turn"; joint: number; axis: 0 | 1 | 2 }
  /** Height of the hips, centimetres. */
  | { kind: "height" };

const DOWN: Vector = [0, -1, 0];
const UP: Vector = [0, 1, 0];

/** The available measures, by name. */
const CHOSEN: Readonly<Record<string, Measure>> = {
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
  "hips height": { kind: "height" },
};

/** Every degree of freedom of every joint, by name: “left foot x”. */
const DEGREES_OF_FREEDOM: Readonly<Record<string, Measure>> = Object.fromEntries(
  ROLES.flatMap((role, joint) =>
    ([0, 1, 2] as const).map((axis) => [
      `${role.replaceAll("_", " ")} ${"xyz"[axis]}`,
      { kind: "turn", joint, axis } satisfies Measure,
    ]),
  ),
);

/** The curves offered by the timeline, in groups. */
export const CURVE_GROUPS: readonly { title: string; names: readonly string[] }[] = [
  { title: strings.play.timeline.curveGroups.angles, names: Object.keys(CHOSEN) },
  { title: strings.play.timeline.curveGroups.freedoms, names: Object.keys(DEGREES_OF_FREEDOM) },
];

/** All curves by name. */
export const CURVES: Readonly<Record<string, Measure>> = { ...CHOSEN, ...DEGREES_OF_FREEDOM };

/** Unit of a curve. */
export function unitOf(measure: Measure): string {
  return measure.kind === "height" ? "cm" : "°";
}

const DEGREES = 180 / Math.PI;

/** v rotated by the quaternion at `offset` (x y z w): v + 2w(u×v) + 2u×(u×v). */
function rotated(q: ArrayLike<number>, offset: number, v: Vector): Vector {
  const [x, y, z, w] = [q[offset]!, q[offset + 1]!, q[offset + 2]!, q[offset + 3]!];
  const tx = 2 * (y * v[2] - z * v[1]);
  const ty = 2 * (z * v[0] - x * v[2]);
  const tz = 2 * (x * v[1] - y * v[0]);
  return [v[0] + w * tx + y * tz - z * ty, v[1] + w * ty + z * tx - x * tz, v[2] + w * tz + x * ty - y * tx];
}

/**
 * The part of a pose from which a measure is computed. The hips rotate with the heading, which differs between
 * examples: `undefined`.
 */
export function subjectOf(measure: Measure): CurveSubject | undefined {
  if (measure.kind === "height") return "height";
  return measure.joint === 0 ? undefined : measure.joint;
}

/** The value of one pose that begins at `start` in `poses`, in the measure's unit. */
export function valueAt(poses: ArrayLike<number>, start: number, measure: Measure): number {
  return measuredAt(poses, measure.kind === "height" ? start + 1 : start + 3 + 4 * measure.joint, measure);
}

/** The value of a measure from the numbers at `offset`: a height in metres or a rotation x y z w. */
export function measuredAt(numbers: ArrayLike<number>, offset: number, measure: Measure): number {
  if (measure.kind === "height") return 100 * numbers[offset]!;
  if (measure.kind === "turn") {
    const sign = numbers[offset + 3]! < 0 ? -1 : 1;
    const [x, y, z] = [0, 1, 2].map((i) => sign * numbers[offset + i]!) as [number, number, number];
    const sine = Math.hypot(x, y, z);
    // Near the identity the vector is twice the quaternion's.
    const scale = sine > 1e-6 ? (2 * Math.atan2(sine, sign * numbers[offset + 3]!)) / sine : 2;
    return [x, y, z][measure.axis]! * scale * DEGREES;
  }
  const { bone } = measure;
  const [x, y, z] = rotated(numbers, offset, bone);
  switch (measure.kind) {
    case "bend":
      return Math.acos(Math.min(1, Math.max(-1, x * bone[0] + y * bone[1] + z * bone[2]))) * DEGREES;
    case "swing":
      return Math.atan2(z, -y) * DEGREES;
    case "lean":
      return Math.atan2(z, y) * DEGREES;
  }
}

/** The value of every pose of a clip. */
export function curveOf(poses: Float32Array, measure: Measure): Float32Array {
  const frames = Math.floor(poses.length / POSE_FLOATS);
  return Float32Array.from({ length: frames }, (_, i) => valueAt(poses, i * POSE_FLOATS, measure));
}

/** Minimum and maximum of several curves with a margin, at least `minSpan` apart; `undefined` without values. */
export function spanOf(curves: readonly Float32Array[], minSpan: number): { low: number; high: number } | undefined {
  let [low, high] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  for (const curve of curves)
    for (const value of curve) {
      low = Math.min(low, value);
      high = Math.max(high, value);
    }
  if (low > high) return undefined;
  const air = Math.max(0, minSpan - (high - low)) / 2 + 0.06 * (high - low);
  return { low: low - air, high: high + air };
}

/** Ranges of frames, [from, to), in which a foot is planted; `contacts` has two per frame, `foot` is 0 or 1. */
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

/** Pairs of an input frame and its output time, one pair every `everyFrames`: lines of the timing map. */
export function timingMap(timeOut: Float32Array, everyFrames: number): { frame: number; timeOut: number }[] {
  const pairs: { frame: number; timeOut: number }[] = [];
  for (let frame = 0; frame < timeOut.length; frame += everyFrames) pairs.push({ frame, timeOut: timeOut[frame]! });
  return pairs;
}

/** A range of frames, [from, to), that is recognised as one class, and the mean weight of that class in it. */
export interface ReadStretch {
  from: number;
  to: number;
  /** Index of the class. */
  class: number;
  weight: number;
}

/** The recognised class of each frame: the heaviest one, merged to ranges. */
export function readStretches(weights: Float32Array, classes: number): ReadStretch[] {
  const stretches: ReadStretch[] = [];
  const frames = classes > 0 ? weights.length / classes : 0;
  for (let i = 0; i < frames; i++) {
    let heaviest = 0;
    for (let c = 1; c < classes; c++) if (weights[i * classes + c]! > weights[i * classes + heaviest]!) heaviest = c;
    const weight = weights[i * classes + heaviest]!;
    const last = stretches.at(-1);
    if (last && last.class === heaviest) {
      const length = last.to - last.from;
      last.weight = (last.weight * length + weight) / (length + 1);
      last.to = i + 1;
    } else stretches.push({ from: i, to: i + 1, class: heaviest, weight });
  }
  return stretches;
}
