/** Measures for the exercises about the pace of a blend. */
import type { Analysis, LearnEngine, LearnMotion } from "../../client/learn/protocol";
import { DEFAULT_OPTIONS } from "../../client/protocol";
import { POSE_FLOATS } from "../../humanoid";
import { STYLES } from "../built_in";
import type { Measure } from "../kind";
import { memoized } from "../memoized";
import { frameAtTime } from "../pairing";
import { inputOf, neutralOf, type PaceState, stylesOf } from "./pace_state";

/** An input, and its output in a blend. */
export interface Paced {
  input: LearnMotion;
  styled: Analysis;
  /** Length of the input, seconds. */
  secs: number;
}

const pacedBy = memoized(
  async (engine, motion: PaceState["motion"], old: number, childlike: number): Promise<Paced> => {
    const of = inputOf({ motion });
    const [input, styled] = await Promise.all([
      engine.motion(of),
      engine.stylize(of, { ...DEFAULT_OPTIONS, styles: stylesOf({ old, childlike }) }),
    ]);
    return { input, styled, secs: (input.poses.length / POSE_FLOATS - 1) / input.rateHz };
  },
);

/** The output of a state's blend for its input; computed once. */
export function pacedOf(engine: LearnEngine, { motion, old, childlike }: PaceState): Promise<Paced> {
  return pacedBy(engine, motion, old, childlike);
}

/** g of a neighbour at a distance. */
export function kernelAt(distance: number, bandwidth: number): number {
  return Math.exp(-(distance ** 2) / (2 * bandwidth ** 2));
}

/** Length of the output, seconds. */
export function lengthOf({ styled: { timeOut } }: Paced): number {
  return timeOut.at(-1)! - timeOut[0]!;
}

/** Length of the output relative to the input's. */
export function ratioOf(paced: Paced): number {
  return lengthOf(paced) / paced.secs;
}

/** The frame that a blend has reached at a second of its clock; NaN after its end. */
export function frameAtSecond({ styled }: Paced, second: number): number {
  return frameAtTime(styled.timeOut, second);
}

/** The recorded style that takes longest for an input, and its length relative to the input's. */
export const longestOf = memoized(async (engine, motion: PaceState["motion"]) => {
  const performed = await Promise.all(
    STYLES.slice(1).map(async (style) => ({ style, by: await engine.counterpart(motion, style) })),
  );
  const lengths = performed.map(({ style, by }) => ({
    style,
    ratio: by ? (by.timeOut.at(-1)! - by.timeOut[0]!) / (by.timeOut.length - 1) : 0,
  }));
  const { rateHz } = await engine.motion(inputOf({ motion }));
  const { style, ratio } = lengths.reduce((a, b) => (b.ratio > a.ratio ? b : a));
  return { style, ratio: ratio * rateHz };
});

/** The measure of a state. */
export async function measurePace(engine: LearnEngine, state: PaceState): Promise<Measure> {
  const [paced, longest] = await Promise.all([pacedOf(engine, state), longestOf(engine, state.motion)]);
  const { old, childlike, motion } = state;
  return {
    motion,
    old,
    childlike,
    neutral: neutralOf(state),
    ratio: ratioOf(paced),
    length: lengthOf(paced),
    input: paced.secs,
    longest: longest.ratio,
    longestStyle: longest.style,
  };
}
