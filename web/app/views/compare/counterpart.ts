/** The real counterpart of a transfer: the input as performed in a style, or in a mixture of styles. Pure functions. */

import type { Performed, StyleWeights } from "../../../client/protocol";
import { POSE_FLOATS } from "../../../humanoid";

/** The styles of a mixture, including neutral, with weights that sum to 1; in the order of the database. */
export function shares(
  weights: StyleWeights,
  styles: readonly string[],
  neutral: string,
): { style: string; weight: number }[] {
  const rest = 1 - Object.values(weights).reduce((sum, weight) => sum + weight, 0);
  return styles
    .map((style) => ({ style, weight: (weights[style] ?? 0) + (style === neutral ? rest : 0) }))
    .filter(({ weight }) => Math.abs(weight) > 1e-6);
}

/** The weighted mean of performances of one content; the contacts are those of the performance with the largest weight. */
export function mixed(performances: readonly (Performed & { weight: number })[]): Performed {
  const [first] = performances;
  if (!first || performances.length === 1) return first ?? EMPTY;
  const poses = new Float32Array(first.poses.length);
  const timeOut = new Float32Array(first.timeOut.length);
  for (const { weight, ...performance } of performances) {
    for (let f = 0; f < timeOut.length; f++) timeOut[f]! += weight * performance.timeOut[f]!;
    for (let at = 0; at < poses.length; at += POSE_FLOATS) addPose(poses, performance.poses, first.poses, at, weight);
  }
  for (let at = 0; at < poses.length; at += POSE_FLOATS)
    for (let q = at + 3; q < at + POSE_FLOATS; q += 4) {
      const length = Math.hypot(poses[q]!, poses[q + 1]!, poses[q + 2]!, poses[q + 3]!);
      for (let k = q; k < q + 4; k++) poses[k] = length > 0 ? poses[k]! / length : first.poses[k]!;
    }
  const heaviest = performances.reduce((a, b) => (b.weight > a.weight ? b : a));
  return { poses, timeOut, planted: heaviest.planted };
}

const EMPTY: Performed = { poses: new Float32Array(0), timeOut: new Float32Array(0), planted: new Uint8Array(0) };

/** Adds a weighted pose to a sum. Quaternions are negated if they are in the opposite hemisphere of those of `like`. */
function addPose(sum: Float32Array, pose: Float32Array, like: Float32Array, at: number, weight: number): void {
  for (let k = at; k < at + 3; k++) sum[k]! += weight * pose[k]!;
  for (let q = at + 3; q < at + POSE_FLOATS; q += 4) {
    let dot = 0;
    for (let k = q; k < q + 4; k++) dot += pose[k]! * like[k]!;
    const signed = dot < 0 ? -weight : weight;
    for (let k = q; k < q + 4; k++) sum[k]! += signed * pose[k]!;
  }
}
