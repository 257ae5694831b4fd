/** What graphics cards measured: `gpu` of the JSON file of `npm run bench -- --gpu`, and when. */

/** One card's figures, on one database. */
export interface Card {
  adapter: string;
  driver: string;
  backend: string;
  /** Whether a program plays the card: then nothing is worth telling. */
  software: boolean;
  frames: number;
  classes: number;
  /** Sets of neighbours, and how many are the engine's to the bit. */
  sets: number;
  identical: number;
  /** How many times faster the engine's search is than the card's, a window at a time and 256 together. */
  engine_is_faster?: { all: number; batch: number };
  /** Milliseconds a window by the card: the medians of the rows of `gpu-brute`. */
  all_ms: number;
  batch_ms: number;
  /** ISO date. */
  date: string;
}

/** Real cards only, in the order in which they came. */
export const CARDS: readonly Card[] = [];
