/** Figures of the mixture in English. */
import type { MixWords } from "../mix";

export const mix: MixWords = {
  title: "The nearest classes",
  reading: "What the input is recognised as",
  delta: { symbol: "δ", name: "Width δ", description: "How slowly a weight falls with the distance" },
  weight: "weight λ",
  actions: { walk: "walk", run: "run", jump: "jump", punch: "punch", kick: "kick" },
  guess: "Weight of the first of two",
  columns: ["class", "D, cm²", "λ"],
  decay: "Weight over distance",
  distance: "distance D, cm²",
  span: "δ min D",
  least: "min D",
  here: (delta, here) => `${delta}, here ${here}`,
  class: (name, square, weight) => `${name} at ${square} cm², weight ${weight}`,
  nearest: (classes) => `The nearest classes: ${classes}.`,
  readAs: (time, actions) => `At ${time} s: ${actions}.`,
};
