/** The state of figures about the mixture of classes. */
import type { Look } from "../../client/learn/protocol";
import { DEFAULT_OPTIONS } from "../../client/protocol";
import { choice, type Fields, number } from "../../link/fields";
import type { DialRange } from "../../ui/controls/dial";
import { INPUTS, type InputName } from "../built_in";

/** Which frame of which input, and the conversion of its distances to weights. */
export interface MixState {
  motion: InputName;
  /** Frame of the input. */
  at: number;
  /** δ. */
  delta: number;
  /** A weight entered by the learner; negative if empty. */
  guess: number;
}

/** The knob. */
export const DELTA: DialRange = { min: 0.1, max: 5, digits: 2, scale: "log" };

/** The target style of the input: weights do not depend on it. */
export const MIX_STYLE = "old";

/** Encoding of the state in a link. The default width is the engine's. */
export const MIX_FIELDS: Fields<MixState> = {
  motion: choice("motion", "neutral run, walk, jump and walk", INPUTS, true),
  at: number("i", 60, { min: 2, max: 5000, digits: 0 }, true),
  delta: number("width", DEFAULT_OPTIONS.delta, DELTA, true),
  guess: number("guess", -1, { min: -1, max: 1, digits: 3 }, true),
};

/** The engine's frame for a state. */
export function lookOf({ motion, at, delta }: MixState): Look {
  return { input: { name: motion }, styles: { [MIX_STYLE]: 1 }, frame: at, options: { delta } };
}
