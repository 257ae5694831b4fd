/** What figures say; `languages.ts` has it in each language. */
import type { Role } from "../../humanoid";
import type { InputName, Style } from "./built_in";

/** What a language has to say of figures. */
export interface Words {
  /** What stands between a number's whole part and its decimals. */
  decimal: string;
  loading: string;
  table: string;
  play: string;
  pause: string;
  noGraphics: string;
  failed: (why: string) => string;
  unknown: (kind: string) => string;
  styles: Record<Style, string>;
  inputs: Record<InputName, string>;
  joints: Record<Role, string>;
  style: string;
  pairing: string;
  second: string;
  content: string;
  joint: string;
  allJoints: string;
  playhead: string;
  time: string;
  difference: string;
  distance: (joint: string) => string;
  legend: (pairing: string, now: string, mean: string) => string;
  two: string;
  ended: string;
  times: (input: string, style: string, styled: string) => string;
  pictured: (style: string, time: string, pairing: string, e: string, most: string, cm: string) => string;
  line: LineWords;
  sweep: SweepWords;
  mix: MixWords;
  curved: (style: string, time: string, content: string, second: string, mean: string, meanSecond: string) => string;
}

/** A knob: what is printed, what is said, and what it does. */
interface KnobWords {
  symbol: string;
  name: string;
  description: string;
}

/** What the figure of a fitted line says. */
export interface LineWords {
  title: string;
  knobs: Record<"k" | "lambda" | "noise", KnobWords>;
  taper: string;
  input: (joint: string) => string;
  output: (joint: string, style: string) => string;
  /** Heads of the table: row of the database, input, target, weight. */
  columns: readonly [string, string, string, string];
  read: (mean: string, above: string) => string;
  said: (joint: string, k: string, x: string, y: string, slope: string, above: string) => string;
}

/** What the figures of the mixture say. */
export interface MixWords {
  title: string;
  reading: string;
  delta: KnobWords;
  weight: string;
  actions: Readonly<Record<string, string>>;
  guess: string;
  /** Heads of the table: class, D, λ. */
  columns: readonly [string, string, string];
  class: (name: string, square: string, weight: string) => string;
  nearest: (classes: string) => string;
  readAs: (time: string, actions: string) => string;
}

/** What the figure of the ridge's sweep says. */
export interface SweepWords {
  title: string;
  error: string;
  columns: readonly [string, string];
  read: (error: string, least: string, best: string) => string;
  said: (lambda: string, error: string, least: string, best: string) => string;
}

/** A number in a language. */
export function figure(value: number, digits: number, { decimal }: Pick<Words, "decimal">): string {
  if (!Number.isFinite(value)) return "–";
  return value
    .toFixed(digits)
    .replace(/^-(?=0(\.0*)?$)/, "")
    .replace("-", "−")
    .replace(".", decimal);
}
