/** What the figures of the distance of windows say. */
import type { KnobWords } from "./knob";

export interface NearWords {
  /** Titles of the stage and of the plot. */
  stage: string;
  title: string;
  knobs: Record<"heading" | "x" | "z" | "k", KnobWords>;
  /** Mark on the ground, and how far it is moved. */
  move: string;
  moved: (x: string, z: string) => string;
  /** Puts the query back to the input. */
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
  /** Heads of the table: row, √D in mm, θ in degrees. */
  columns: readonly [string, string, string];
}
