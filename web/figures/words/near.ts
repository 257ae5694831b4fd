/** Texts of the figures of the distance of windows. */
import type { KnobWords } from "./knob";

export interface NearWords {
  /** Titles of the stage and of the plot. */
  stage: string;
  title: string;
  knobs: Record<"heading" | "x" | "z" | "k", KnobWords>;
  /** Mark on the ground, and its displacement. */
  move: string;
  moved: (x: string, z: string) => string;
  /** Resets the query to the input. */
  restore: string;
  window: string;
  reversed: string;
  guess: string;
  query: string;
  /** Axes. */
  rows: string;
  distance: string;
  read: (first: string, k: string, last: string) => string;
  said: (window: string, reversed: boolean, first: string, k: string, last: string) => string;
  posed: (heading: string, x: string, z: string, limbs: string, first: string) => string;
  /** Headers of the table: row, √D in mm, θ in degrees. */
  columns: readonly [string, string, string];
}
