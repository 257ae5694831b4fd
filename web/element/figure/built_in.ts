/** What the built-in motions are called; `built_in.test.ts` holds the lists to the engine. */

/** Styles, neutral first. */
export const STYLES = ["neutral", "angry", "childlike", "depressed", "old", "proud", "sexy", "strutting"] as const;
/** Name of a style. */
export type Style = (typeof STYLES)[number];

/** Inputs, the default first. */
export const INPUTS = [
  "neutral walk",
  "neutral walk with turns",
  "neutral walk in a circle",
  "neutral run",
  "neutral walk, run and walk",
  "neutral run, walk, jump and walk",
  "neutral walk, punch, kick, jump and walk",
] as const;
/** Name of an input. */
export type InputName = (typeof INPUTS)[number];
