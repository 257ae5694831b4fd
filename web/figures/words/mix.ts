/** Texts of the figures of the mixture. */
import type { KnobWords } from "./knob";

export interface MixWords {
  title: string;
  reading: string;
  delta: KnobWords;
  weight: string;
  actions: Readonly<Record<string, string>>;
  guess: string;
  /** Headers of the table: class, D, λ. */
  columns: readonly [string, string, string];
  /** Title of the curve, the name of its width, and the smallest distance. */
  decay: string;
  distance: string;
  span: string;
  least: string;
  here: (delta: string, here: string) => string;
  class: (name: string, square: string, weight: string) => string;
  nearest: (classes: string) => string;
  readAs: (time: string, actions: string) => string;
}
