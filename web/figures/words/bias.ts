/** Texts of the figures of the bias. */
import type { KnobWords } from "./knob";

export interface BiasWords {
  title: string;
  /** Title of the two walkers. */
  stage: string;
  knobs: Record<"raise" | "reach" | "keep", KnobWords>;
  axis: (joint: string) => string;
  input: string;
  output: string;
  guess: string;
  /** Headers of the table: quantity, degrees. */
  columns: readonly [string, string];
  /** Rows of the table. */
  rows: Readonly<Record<"x" | "mean" | "deviation" | "bias" | "y", string>>;
  read: (low: string, high: string) => string;
  said: (x: string, low: string, high: string, bias: string, y: string) => string;
  /** Headers of the stage's table: walker, elevation of its arms in degrees. */
  elevations: readonly [string, string];
  posed: (style: string, time: string, raise: string) => string;
}
