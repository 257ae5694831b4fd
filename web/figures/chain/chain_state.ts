/** The state of figures about a synthesised step: its states, their durations, and the trajectory through them. */
import type { StyleWeights, WalkDof } from "../../client/learn/protocol";
import { JOINT, ROLES, type Role } from "../../humanoid";
import { choice, type Fields, number } from "../../link/fields";
import type { DialRange } from "../../ui/controls/dial";
import { STYLES, type Style } from "../built_in";
import { AXES, type Axis } from "../line/line_state";

/** Which walk, which degree of freedom, and the changes of its model. */
export interface ChainState {
  style: Style;
  /** k: 0 is neutral, 1 the style; below 0 it is negated, above 1 exaggerated. */
  share: number;
  joint: Role;
  axis: Axis;
  /** Factors of σ², σ′² and σ″². */
  pose: number;
  velocity: number;
  acceleration: number;
  /** ρ of left and right steps: number of variances by which their states last longer. */
  left: number;
  right: number;
}

/** The knobs. */
const FACTOR = { min: 0.001, max: 1000, digits: 3, scale: "log" } as const;
export const CHAIN_RANGES = {
  share: { min: -1, max: 2, digits: 2, scale: "linear" },
  pose: FACTOR,
  velocity: FACTOR,
  acceleration: FACTOR,
  left: { min: -2, max: 3, digits: 2, scale: "linear" },
  right: { min: -2, max: 3, digits: 2, scale: "linear" },
} as const satisfies Record<string, DialRange>;

/** The three statistics, in the order of the model. */
export const PROMISES = ["pose", "velocity", "acceleration"] as const;

/** Encoding of the state in a link. */
export const CHAIN_FIELDS: Fields<ChainState> = {
  style: choice("style", "old", STYLES, true),
  share: number("share", 0, CHAIN_RANGES.share, true),
  joint: choice("joint", "left_upper_leg", ROLES, true),
  axis: choice("axis", "x", AXES, true),
  pose: number("var", 1, FACTOR, true),
  velocity: number("dvar", 1, FACTOR, true),
  acceleration: number("ddvar", 1, FACTOR, true),
  left: number("rhol", 0, CHAIN_RANGES.left, true),
  right: number("rhor", 0, CHAIN_RANGES.right, true),
};

/** The weights of m₁ + k(m₂ − m₁), with m₁ the neutral model. */
export function stylesOf({ style, share }: Pick<ChainState, "style" | "share">): StyleWeights {
  return style === "neutral" ? { neutral: 1 } : { neutral: 1 - share, [style]: share };
}

/** The degree of freedom of a state. */
export function dofOf({ joint, axis }: Pick<ChainState, "joint" | "axis">): WalkDof {
  return { joint: JOINT[joint], axis: AXES.indexOf(axis) };
}
