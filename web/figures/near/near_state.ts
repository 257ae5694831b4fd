/** The state of figures about the distance of two windows: a query, and its changes. */
import type { Look, QueryChange, WindowLength } from "../../client/learn/protocol";
import { DEFAULT_OPTIONS } from "../../client/protocol";
import { choice, type Fields, flag, number } from "../../link/fields";
import type { DialRange } from "../../ui/controls/dial";
import { INPUTS, type InputName } from "../built_in";
import { type TurnedJoint, turnedJoints, turnsOf } from "../turned_joints";

/** s: frames of a window. */
export const WINDOWS = ["1", "5", "9", "15"] as const;
type WindowName = (typeof WINDOWS)[number];

/** Which query is compared, and the number of examined neighbours. */
export interface NearState {
  motion: InputName;
  /** Last frame of the query. */
  at: number;
  /** Limbs that are rotated in every frame of it. */
  turned: readonly TurnedJoint[];
  /** Rotation about the vertical, degrees. */
  heading: number;
  /** Displacement on the ground, metres. */
  x: number;
  z: number;
  window: WindowName;
  /** Whether its time is reversed. */
  reversed: boolean;
  k: number;
  /** Change of √D₁ entered by the learner, millimetres; {@link NO_GUESS} if empty. */
  guess: number;
}

/** Number of nearest examples that are drawn. */
export const DRAWN = 8;

/** Value of an empty field. */
export const NO_GUESS = -1;

/** The knobs. */
export const NEAR_RANGES = {
  heading: { min: -180, max: 180, digits: 0, scale: "linear" },
  x: { min: -1, max: 1, digits: 2, scale: "linear" },
  z: { min: -1, max: 1, digits: 2, scale: "linear" },
  k: { min: 1, max: 160, digits: 0, scale: "log" },
} as const satisfies Record<string, DialRange>;

/** Encoding of the state in a link. */
export const NEAR_FIELDS: Fields<NearState> = {
  motion: choice("motion", "neutral walk", INPUTS, true),
  at: number("i", 160, { min: 14, max: 5000, digits: 0 }, true),
  turned: turnedJoints("turned"),
  heading: number("heading", 0, NEAR_RANGES.heading, true),
  x: number("x", 0, NEAR_RANGES.x, true),
  z: number("z", 0, NEAR_RANGES.z, true),
  window: choice("window", "5", WINDOWS, true),
  reversed: flag("reversed", false, true),
  k: number("K", DEFAULT_OPTIONS.k, NEAR_RANGES.k, true),
  guess: number("guess", NO_GUESS, { min: NO_GUESS, max: 5000, digits: 2 }, true),
};

/** Radians per degree. */
export const RADIANS = Math.PI / 180;

/** The engine's frame for a state. Distances do not depend on the style. */
export function lookOf({ motion, at }: Pick<NearState, "motion" | "at">): Look {
  return { input: { name: motion }, styles: { neutral: 1 }, frame: at };
}

/** The changes of the query. */
export function changeOf({ turned, heading, x, z, reversed }: NearState): QueryChange {
  return { turns: turnsOf(turned), heading: heading * RADIANS, x, z, reversed };
}

/** Frames of a window as a number. */
export function lengthOf({ window }: Pick<NearState, "window">): WindowLength {
  return Number(window) as WindowLength;
}
