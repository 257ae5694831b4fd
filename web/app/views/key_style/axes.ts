/** Style variables: the measures that have names, and what a person calls them. */
import type { Axis } from "../../state/key_style";
import { strings } from "../../strings/strings";

/** Measures by the names that the engine has for them (`rust/strut-core/src/somn/measurement`). */
export const NAMED_AXES = [
  "hips_height",
  "reach_left",
  "reach_right",
  "hand_height_left",
  "hand_height_right",
  "foot_separation",
  "foot_height_difference",
  "torso_lean",
  "hands_apart",
  "knee_bend_left",
  "knee_bend_right",
  "speed",
] as const;
export type NamedAxis = (typeof NAMED_AXES)[number];

export function isNamed(axis: Axis): axis is NamedAxis {
  return NAMED_AXES.some((name) => name === axis);
}

/** What a person calls a variable: its name, or the expression itself. */
export function titleOf(axis: Axis): string {
  return isNamed(axis) ? strings.keyStyle.axes[axis].title : axis;
}

/** The shorter name beside a line in the picture. */
export function shortTitleOf(axis: Axis): string {
  return isNamed(axis) ? strings.keyStyle.axes[axis].short : axis;
}

/** Variables that make sense of an action. */
export function usualAxes(action: string): Axis[] {
  return /punch|box|hook|jab/.test(action)
    ? ["reach_left", "hips_height"]
    : ["foot_separation", "foot_height_difference"];
}
