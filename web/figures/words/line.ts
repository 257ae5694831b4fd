/** Texts of the figures of one prediction. */
import type { KnobWords } from "./knob";

/** Texts of the figure of a fitted line. */
export interface LineWords {
  title: string;
  knobs: Record<"k" | "lambda" | "noise", KnobWords>;
  taper: string;
  input: (joint: string) => string;
  output: (joint: string, style: string) => string;
  /** Headers of the table: row of the database, input, target, weight. */
  columns: readonly [string, string, string, string];
  read: (mean: string, above: string) => string;
  /** Title of the terms, their names, headers of their table, and their axis. */
  terms: string;
  termNames: Readonly<Record<"a" | "b" | "c" | "d" | "returned" | "y", string>>;
  termColumns: readonly [string, string, string];
  adds: string;
  summed: (terms: string, y: string) => string;
  said: (joint: string, k: string, x: string, y: string, slope: string, above: string) => string;
}

/** Texts of the figure of the ridge's sweep. */
export interface SweepWords {
  title: string;
  error: string;
  columns: readonly [string, string];
  read: (error: string, least: string, best: string) => string;
  said: (lambda: string, error: string, least: string, best: string) => string;
}
