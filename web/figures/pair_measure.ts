/** Measures for the exercises about paired performances. */
import type { LearnEngine } from "../client/learn/protocol";
import { JOINT, JOINTS, ROLES } from "../humanoid";
import { STYLES } from "./built_in";
import type { Measure } from "./kind";
import type { PairState } from "./pair_state";
import { jointCurve, meanOf, type Pair, type Pairing } from "./pairing";
import { sharedPair } from "./shared";

/** Index of the smallest or largest finite number. */
const best = (values: readonly number[], sign: 1 | -1) =>
  values.reduce((found, value, i) => (sign * value < sign * values[found]! ? i : found), 0);

/** Mean difference of every style but neutral, cm. */
export async function styleMeans(engine: LearnEngine, motion: string, pairing: Pairing): Promise<Map<string, number>> {
  const styles = STYLES.slice(1);
  const means = new Map<string, number>();
  // One after another: each takes a while on this thread, and pictures are drawn in between.
  for (const style of styles) {
    const pair = await sharedPair(engine, motion, style);
    means.set(style, meanOf(pair?.difference[pairing] ?? []));
  }
  return means;
}

/** Mean distance of every joint, cm. */
export function jointMeans(pair: Pair, pairing: Pairing): number[] {
  return Array.from({ length: JOINTS }, (_, joint) => meanOf(jointCurve(pair, pairing, joint)));
}

/** The style with the smallest mean difference. */
export function nearestStyle(means: ReadonlyMap<string, number>): string {
  const styles = [...means.keys()];
  return styles[best([...means.values()], 1)]!;
}

/** The joint with the largest mean distance. */
export function farthestJoint(means: readonly number[]): number {
  return best(means, -1);
}

/** Number of frames over which the growth of the ratio is determined. */
const AROUND = 5;

/** Ratio of the difference by second to that by content. */
function ratioAt({ difference }: Pair, frame: number): number {
  const f = Math.min(difference.content.length - 1, Math.max(0, frame));
  return difference.second[f]! / difference.content[f]!;
}

/** The measure of a state. */
export async function measurePair(engine: LearnEngine, state: PairState): Promise<Measure> {
  const { motion, style, pairing, joint } = state;
  const pair = await sharedPair(engine, motion, style);
  if (!pair) return {};
  const at = Math.min(state.at, pair.input.frames - 1);
  const means = await styleMeans(engine, motion, "content");
  const nearest = nearestStyle(means);
  const joints = jointMeans(pair, "content");
  return {
    motion,
    style,
    pairing,
    joint,
    at,
    secs: at / pair.rateHz,
    content: pair.difference.content[at]!,
    second: pair.difference.second[at]!,
    meanContent: meanOf(pair.difference.content),
    meanSecond: meanOf(pair.difference.second),
    ratioBefore: ratioAt(pair, at - AROUND),
    ratioAfter: ratioAt(pair, at + AROUND),
    nearest,
    nearestBySecond: nearestStyle(await styleMeans(engine, motion, "second")),
    farthest: ROLES[farthestJoint(joints)]!,
    jointMean: joint === "" ? Number.NaN : joints[JOINT[joint]]!,
    jointMeanSecond: joint === "" ? Number.NaN : meanOf(jointCurve(pair, "second", JOINT[joint])),
    farthestMean: Math.max(...joints),
  };
}
