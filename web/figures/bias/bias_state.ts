/** The state of figures about the bias: the part of an input outside all neighbours, and how much of it returns. */
import type { FitSettings, LearnInput, Look } from "../../client/learn/protocol";
import { DEFAULT_OPTIONS } from "../../client/protocol";
import { DEGREES, JOINT } from "../../humanoid";
import { choice, type Fields, number } from "../../link/fields";
import type { DialRange } from "../../ui/controls/dial";
import { INPUTS, type InputName, STYLES, type Style } from "../built_in";

/** Which frame of which input, and the treatment of its bias. */
export interface BiasState {
  motion: InputName;
  style: Style;
  /** Frame of the input. */
  at: number;
  /** φ: how far both arms are raised forwards, degrees. */
  raise: number;
  /** κ: half the width of the band, in standard deviations. */
  reach: number;
  /** ρ: the share of the bias that returns. */
  keep: number;
  /** ρΔx as entered by the learner, degrees; {@link NO_GUESS} if empty. */
  guess: number;
}

/** Value of an empty field. */
export const NO_GUESS = -181;

/** The knobs. */
export const BIAS_RANGES = {
  raise: { min: 0, max: 90, digits: 0, scale: "linear" },
  reach: { min: 0.5, max: 16, digits: 1, scale: "log" },
  keep: { min: 0, max: 1, digits: 2, scale: "linear" },
} as const satisfies Record<string, DialRange>;

/** Encoding of the state in a link. The defaults of the bias are the engine's. */
export const BIAS_FIELDS: Fields<BiasState> = {
  motion: choice("motion", "neutral walk", INPUTS, true),
  style: choice("style", "depressed", STYLES, true),
  at: number("i", 160, { min: 2, max: 5000, digits: 0 }, true),
  raise: number("raise", 60, BIAS_RANGES.raise, true),
  reach: number("reach", DEFAULT_OPTIONS.kappa, BIAS_RANGES.reach, true),
  keep: number("keep", DEFAULT_OPTIONS.rho, BIAS_RANGES.keep, true),
  guess: number("guess", NO_GUESS, { min: NO_GUESS, max: 180, digits: 1 }, true),
};

/** The examined degree of freedom: a raise of the right arm is a rotation about this axis from its mean. */
export const BIAS_JOINT = "right_upper_arm";
const AXIS = 1;

/** An input with both arms raised forwards, about the axis through the shoulders. */
export function raisedInput({ motion, raise }: Pick<BiasState, "motion" | "raise">): LearnInput {
  if (raise === 0) return { name: motion };
  const by = [-raise / DEGREES, 0, 0] as const;
  return {
    name: motion,
    turns: (["left", "right"] as const).map((side) => ({ joint: JOINT[`${side}_upper_arm`], by })),
  };
}

/** The engine's frame for a state. */
export function lookOf(state: BiasState): Look {
  const { style, at, keep, reach } = state;
  return { input: raisedInput(state), styles: { [style]: 1 }, frame: at, options: { rho: keep, kappa: reach } };
}

/** The line whose bias is shown, fitted as in the engine. */
export const SETTINGS: FitSettings = {
  dof: 3 * JOINT[BIAS_JOINT] + AXIS,
  k: DEFAULT_OPTIONS.k,
  lambda: DEFAULT_OPTIONS.lambda,
  noise: 0,
  taper: true,
};
