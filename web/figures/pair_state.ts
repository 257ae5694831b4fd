/** The state of figures that show an input next to its performance in a style. */
import { ROLES, type Role } from "../humanoid";
import { choice, type Fields, number } from "../link/fields";
import { INPUTS, type InputName, STYLES, type Style } from "./built_in";
import { PAIRINGS, type Pairing } from "./pairing";

/** What is compared, and the examined part. */
export interface PairState {
  motion: InputName;
  style: Style;
  pairing: Pairing;
  /** Frame of the input. */
  at: number;
  /** The joint whose distance is displayed; empty for the mean of all. */
  joint: Role | "";
}

/** The longest built-in input has fewer frames; figures clamp to the current one. */
const FRAMES = { min: 0, max: 5000, digits: 0 };

/** Encoding of the state in a link. */
export const PAIR_FIELDS: Fields<PairState> = {
  motion: choice("motion", "neutral walk", INPUTS, true),
  style: choice("style", "old", STYLES, true),
  pairing: choice("pair", "second", PAIRINGS, true),
  at: number("i", 160, FRAMES, true),
  joint: choice("joint", "", ["", ...ROLES], true),
};
