/** Names and lengths of the built-in motions; `built_in.test.ts` checks them against the engine. */

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

/** Frames per second of all of them. */
export const RATE_HZ = 60;
/** Frames of the default input. */
export const FRAMES = 882;
