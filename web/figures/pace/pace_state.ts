/** The state of figures about the pace of a blend of styles. */
import type { LearnInput, Look, StyleWeights } from "../../client/learn/protocol";
import { choice, type Fields, number } from "../../link/fields";
import { INPUTS, type InputName } from "../built_in";

/** The blended styles; the remainder to 1 is the neutral style's. */
export const BLENDED = ["old", "childlike"] as const;
export type Blended = (typeof BLENDED)[number];

/** Which frame of which input, in which blend. */
export interface PaceState {
  motion: InputName;
  /** Frame of the input. */
  at: number;
  /** s of either style; outside 0 to 1 it is extrapolated. */
  old: number;
  childlike: number;
}

/** Range of a weight. */
export const WEIGHT = { min: -0.25, max: 1.75, digits: 2, scale: "linear" } as const;

/** Encoding of the state in a link. */
export const PACE_FIELDS: Fields<PaceState> = {
  motion: choice("motion", "neutral walk", INPUTS, true),
  at: number("i", 160, { min: 2, max: 5000, digits: 0 }, true),
  old: number("old", 1, WEIGHT, true),
  childlike: number("childlike", 0, WEIGHT, true),
};

/** The weights of a blend for the engine. */
export function stylesOf({ old, childlike }: Pick<PaceState, Blended>): StyleWeights {
  return { old, childlike };
}

/** The share of the neutral style. */
export function neutralOf({ old, childlike }: Pick<PaceState, Blended>): number {
  return 1 - old - childlike;
}

/** The input of a state. */
export function inputOf({ motion }: Pick<PaceState, "motion">): LearnInput {
  return { name: motion };
}

/** The engine's frame for a state. */
export function lookOf(state: PaceState): Look {
  return { input: inputOf(state), styles: stylesOf(state), frame: state.at };
}
