/** The state of figures about the line of one degree of freedom. */
import type { FitSettings, Look } from "../../client/learn/protocol";
import { DEFAULT_OPTIONS } from "../../client/protocol";
import { DEGREES, JOINT, ROLES, type Role } from "../../humanoid";
import { choice, type Fields, flag, number } from "../../link/fields";
import type { DialRange } from "../../ui/controls/dial";
import type { Range } from "../../ui/controls/range";
import { FRAMES, INPUTS, type InputName, STYLES, type Style } from "../built_in";

/** Axes of a joint's exponential map. */
export const AXES = ["x", "y", "z"] as const;
export type Axis = (typeof AXES)[number];

/** Which line, and the settings of its fit. */
export interface LineState {
  motion: InputName;
  style: Style;
  /** Frame of the input. */
  at: number;
  joint: Role;
  axis: Axis;
  /** K. */
  k: number;
  /** λ. */
  lambda: number;
  /** ν: noise on the targets, degrees. */
  noise: number;
  /** Whether the weights of neighbours decrease with distance. */
  taper: boolean;
}

/** The knobs. */
export const LINE_RANGES = {
  k: { min: 1, max: 160, digits: 0, scale: "log" },
  lambda: { min: 0.0001, max: 10, digits: 4, scale: "log" },
  noise: { min: 0, max: 8, digits: 1, scale: "linear" },
} as const satisfies Record<string, DialRange>;

/** Selectable instants of the default input; for a longer one a link may have later ones. */
export const INSTANTS: Range = { min: 2, max: FRAMES - 1, digits: 0 };

/** Encoding of the state in a link. The defaults of K and λ are the engine's. */
export const LINE_FIELDS: Fields<LineState> = {
  motion: choice("motion", "neutral walk", INPUTS, true),
  style: choice("style", "old", STYLES, true),
  at: number("i", 160, { min: 2, max: 5000, digits: 0 }, true),
  joint: choice("joint", "left_lower_leg", ROLES, true),
  axis: choice("axis", "x", AXES, true),
  k: number("K", DEFAULT_OPTIONS.k, LINE_RANGES.k, true),
  lambda: number("ridge", DEFAULT_OPTIONS.lambda, LINE_RANGES.lambda, true),
  noise: number("nu", 0, LINE_RANGES.noise, true),
  taper: flag("taper", true, true),
};

/** The engine's frame for a state. */
export function lookOf({ motion, style, at }: Pick<LineState, "motion" | "style" | "at">): Look {
  return { input: { name: motion }, styles: { [style]: 1 }, frame: at };
}

/** The fit settings of a state. */
export function settingsOf({ joint, axis, k, lambda, noise, taper }: LineState): FitSettings {
  return { dof: 3 * JOINT[joint] + AXES.indexOf(axis), k, lambda, noise: noise / DEGREES, taper };
}
