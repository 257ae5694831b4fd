/** Style variables: the named measures and their titles. */
import type { Axis } from "../../state/key_style";
import { strings } from "../../strings/strings";

/** Measures by their names in the engine (`rust/strut-core/src/somn/measurement`). */
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
type NamedAxis = (typeof NAMED_AXES)[number];

export function isNamed(axis: Axis): axis is NamedAxis {
  return NAMED_AXES.some((name) => name === axis);
}

/** The title of a variable: its name, or the expression itself. */
export function titleOf(axis: Axis): string {
  return isNamed(axis) ? strings.keyStyle.axes[axis].title : axis;
}

/** The shorter name next to a line in the picture. */
export function shortTitleOf(axis: Axis): string {
  return isNamed(axis) ? strings.keyStyle.axes[axis].short : axis;
}

/** Suitable variables for an action. */
export function usualAxes(action: string): Axis[] {
  return /punch|box|hook|jab/.test(action)
    ? ["reach_left", "hips_height"]
    : ["foot_separation", "foot_height_difference"];
}
