/** Figures of the mixture in English. */
export const mix = {
  title: "The nearest classes",
  reading: "What the input is recognised as",
  delta: { symbol: "δ", name: "Width δ", description: "How slowly a weight falls with the distance" },
  weight: "weight λ",
  actions: { walk: "walk", run: "run", jump: "jump", punch: "punch", kick: "kick" } as Readonly<Record<string, string>>,
  guess: "Weight of the first of two",
  columns: ["class", "D, cm²", "λ"],
  decay: "Weight over distance",
  distance: "distance D, cm²",
  span: "δ min D",
  least: "min D",
  here: (delta: string, here: string) => `${delta}, here ${here}`,
  class: (name: string, square: string, weight: string) => `${name} at ${square} cm², weight ${weight}`,
  nearest: (classes: string) => `The nearest classes: ${classes}.`,
  readAs: (time: string, actions: string) => `At ${time} s: ${actions}.`,
} as const;
