/** The state of figures about the mixture of classes. */
import type { Look } from "../../../client/learn/protocol";
import { DEFAULT_OPTIONS } from "../../../client/protocol";
import { choice, type Fields, number } from "../../../link/fields";
import type { DialRange } from "../../../ui/controls/dial";
import { INPUTS, type InputName } from "../built_in";

/** Which frame of which input, and how its distances become weights. */
export interface MixState {
  motion: InputName;
  /** Frame of the input. */
  at: number;
  /** δ. */
  delta: number;
  /** A weight that somebody computed; negative while nobody has. */
  guess: number;
}

/** The knob. */
export const DELTA: DialRange = { min: 0.1, max: 5, digits: 2, scale: "log" };

/** The style that the input takes on: weights do not depend on it. */
export const MIX_STYLE = "old";

/** How the state is written into a link. The width is the engine's. */
export const MIX_FIELDS: Fields<MixState> = {
  motion: choice("motion", "neutral run, walk, jump and walk", INPUTS, true),
  at: number("i", 60, { min: 2, max: 5000, digits: 0 }, true),
  delta: number("width", DEFAULT_OPTIONS.delta, DELTA, true),
  guess: number("guess", -1, { min: -1, max: 1, digits: 3 }, true),
};

/** What a state looks at. */
export function lookOf({ motion, at, delta }: MixState): Look {
  return { input: { name: motion }, styles: { [MIX_STYLE]: 1 }, frame: at, options: { delta } };
}
