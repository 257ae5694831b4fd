/** The state of figures about feet: when they stand, how they slide, and how a leg reaches for a place. */
import type { LearnInput, Look } from "../../../client/learn/protocol";
import { choice, type Fields, flag, number } from "../../../link/fields";
import { INPUTS, type InputName, STYLES, type Style } from "../built_in";
import { SIDES, type Side } from "./soles";

/** Which foot of which motion, and where a leg's ankle is. */
export interface FeetState {
  motion: InputName;
  style: Style;
  /** Frame of the input. */
  at: number;
  foot: Side;
  /** Whether standing feet are held. */
  hold: boolean;
  /** The ankle from the hip, metres: forwards and upwards. */
  x: number;
  y: number;
}

/** Frames of a stretch, of which a plot shows one. */
export const STRETCH = 120;

/** How far the ankle may be dragged, metres. */
export const REACH = { x: { min: -0.6, max: 0.6, digits: 3 }, y: { min: -0.85, max: -0.1, digits: 3 } } as const;

/** How the state is written into a link. */
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

/** The first frame of the stretch that a frame is in. */
export function stretchOf(frame: number): number {
  return STRETCH * Math.floor(frame / STRETCH);
}
