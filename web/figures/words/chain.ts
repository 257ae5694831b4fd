/** Texts of the figures of a synthesised step. */
import type { KnobWords } from "./knob";

export interface ChainWords {
  /** Titles of the states, the trajectory and the walker. */
  chain: string;
  path: string;
  gait: string;
  knobs: Record<"pose" | "velocity" | "acceleration" | "left" | "right" | "share", KnobWords>;
  /** End of a step that can be dragged. */
  ends: Record<"left" | "right", string>;
  steps: Record<"left" | "right", string>;
  state: (n: number) => string;
  /** Axes. */
  time: string;
  angle: (joint: string) => string;
  read: (farthest: string, deviations: string, jerk: string) => string;
  walked: (left: string, right: string, cadence: string) => string;
  said: (joint: string, farthest: string, deviations: string, jerk: string) => string;
  walks: (style: string, share: string) => string;
  walker: string;
  /** Headers of the tables. */
  columns: readonly [string, string, string, string];
  durations: readonly [string, string, string];
  shares: readonly [string, string];
}
