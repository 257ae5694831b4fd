/** The state of figures about feet: contacts, sliding, and inverse kinematics of a leg. */
import type { LearnInput, Look } from "../../client/learn/protocol";
import { choice, type Fields, flag, number } from "../../link/fields";
import { INPUTS, type InputName, STYLES, type Style } from "../built_in";
import { SIDES, type Side } from "./soles";

/** Which foot of which motion, and the position of a leg's ankle. */
export interface FeetState {
  motion: InputName;
  style: Style;
  /** Frame of the input. */
  at: number;
  foot: Side;
  /** Whether planted feet are held in place. */
  hold: boolean;
  /** Position of the ankle relative to the hip, metres: forwards and upwards. */
  x: number;
  y: number;
}

/** Frames of a range; a plot shows one range. */
export const STRETCH = 120;

/** Range in which the ankle may be dragged, metres. */
export const REACH = { x: { min: -0.6, max: 0.6, digits: 3 }, y: { min: -0.85, max: -0.1, digits: 3 } } as const;

/** Encoding of the state in a link. */
export const FEET_FIELDS: Fields<FeetState> = {
  motion: choice("motion", "neutral walk", INPUTS, true),
  style: choice("style", "old", STYLES, true),
  at: number("i", 160, { min: 2, max: 5000, digits: 0 }, true),
  foot: choice("foot", "left", SIDES, true),
  hold: flag("hold", false, true),
  x: number("x", 0.1, REACH.x, true),
  y: number("y", -0.78, REACH.y, true),
};

/** The input of a state. */
export function inputOf({ motion }: Pick<FeetState, "motion">): LearnInput {
  return { name: motion };
}

/** A frame of a state's motion. */
export function lookOf({ motion, style }: Pick<FeetState, "motion" | "style">, frame: number): Look {
  return { input: inputOf({ motion }), styles: { [style]: 1 }, frame };
}

/** The first frame of the range of a frame. */
export function stretchOf(frame: number): number {
  return STRETCH * Math.floor(frame / STRETCH);
}
