/** Texts of the figures of key-styling. */
import type { KnobWords } from "./knob";

export interface MapWords {
  /** Titles. */
  som: string;
  learning: string;
  pad: string;
  posed: string;
  update: string;
  keys: string;
  temperature: KnobWords;
  /** Buttons: single updates, a pass, all, and restart. */
  steps: Record<"one" | "ten" | "pass" | "all" | "restart", string>;
  printed: string;
  handle: string;
  key: (n: number) => string;
  add: string;
  remove: string;
  /** Axes. */
  separation: string;
  height: string;
  pass: string;
  error: string;
  time: string;
  at: (updates: string, pass: string, error: string) => string;
  learned: (pass: string, error: string) => string;
  unlearned: string;
  dragged: (change: string, error: string) => string;
  keyed: (count: string, error: string) => string;
  stepped: (updates: string, count: string, error: string) => string;
  fallen: (pass: string, error: string) => string;
  asked: (separation: string, height: string) => string;
  interpolated: (count: string, error: string, from: string, to: string, worst: string) => string;
  pose: string;
  /** The two bodies of an update, and their distance. */
  sampled: string;
  predicted: string;
  predictedOff: (degrees: string) => string;
  noUpdate: string;
  /** Headers of the tables. */
  components: readonly [string, string, string, string];
  passes: readonly [string, string];
  variables: readonly [string, string];
  frames: readonly [string, string, string];
}
