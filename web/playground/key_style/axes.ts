/** Style variables: the measures that have names, and what a person calls them. */
import { strings } from "../strings/strings";

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

/** A style variable that has a name, or an expression. */
export type Axis = string;

/** Style variables of one model. */
export const MOST_AXES = 3;
/** Longest expression. */
export const MOST_CHARACTERS = 80;

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

/** Axes in links stand behind each other with `~`, which no expression has. */
const SEPARATOR = "~";

export function encodeAxes(axes: readonly Axis[]): string {
  return axes.join(SEPARATOR);
}

/** What {@link encodeAxes} wrote; `undefined` where there are too many, or the same twice. */
export function decodeAxes(text: string): Axis[] | undefined {
  const axes = text === "" ? [] : text.split(SEPARATOR);
  const valid = axes.every((axis) => axis !== "" && axis.length <= MOST_CHARACTERS);
  return valid && axes.length <= MOST_AXES && new Set(axes).size === axes.length ? axes : undefined;
}
