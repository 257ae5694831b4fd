/** Texts of the figures of the pace of a blend. */
import type { KnobWords } from "./knob";

export interface PaceWords {
  /** Titles of the triangle, the clock, the walkers and the votes. */
  blend: string;
  clock: string;
  paced: string;
  votes: string;
  handle: string;
  knobs: Record<"old" | "childlike", KnobWords>;
  /** Axes. */
  input: string;
  output: string;
  distance: string;
  duration: string;
  weights: (old: string, childlike: string, neutral: string) => string;
  read: (output: string, input: string, ratio: string) => string;
  blended: (old: string, childlike: string, neutral: string, ratio: string) => string;
  clocked: (time: string, output: string, length: string, ratio: string) => string;
  walking: (time: string, behind: string) => string;
  ended: (time: string) => string;
  mean: (ms: string, bandwidth: string) => string;
  voted: (style: string, count: string, ms: string, bandwidth: string) => string;
  /** Name of the blended walker. */
  blendName: string;
  /** Headers of the tables. */
  shares: readonly [string, string];
  times: readonly [string, string];
  voices: readonly [string, string, string];
}
