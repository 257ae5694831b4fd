/** The state of figures about key-styling: learning, dragging, and keys of a cycle. */
import type { PoseSharing } from "../../client/learn/protocol";
import { type Fields, flag, listed, number } from "../../link/fields";
import type { DialRange } from "../../ui/controls/dial";

/** Progress of learning, and the settings for the trained model. */
export interface MapState {
  /** Updates of the network. */
  updates: number;
  /** Whether the signs printed in the paper are used. */
  printed: boolean;
  /** T: softness of the blending of components in a pose. */
  temperature: number;
  /** The requested style variables, cm: distance of the feet along the direction of walking, and in height. */
  separation: number;
  height: number;
  /** Frames of the cycle that are keys, in order. */
  keys: readonly number[];
}

/** T. */
export const TEMPERATURE: DialRange = { min: 0.5, max: 20, digits: 1, scale: "log" };
/** Blur of the components' regions, in deviations of the variables. */
export const BLUR = 0.3;
/** Maximum number of keys of a cycle. */
export const MOST_KEYS = 4;
/** Upper limit of a cycle's frames. */
const MOST_FRAMES = 50;

/** Encoding of the state in a link. */
export const MAP_FIELDS: Fields<MapState> = {
  // In the second pass: every mark has something to show.
  updates: number("updates", 1000, { min: 0, max: 100_000, digits: 0 }, true),
  printed: flag("printed", false, true),
  temperature: number("T", 1, TEMPERATURE, true),
  separation: number("sep", 30, { min: -200, max: 200, digits: 1 }, true),
  height: number("rise", 0, { min: -100, max: 100, digits: 1 }, true),
  keys: listed("marks", [0, 16], (keys) => keys.join(","), decodeKeys),
};

/** Frames in order; `undefined` if the text is invalid. */
function decodeKeys(text: string): readonly number[] | undefined {
  const keys = text.split(",", MOST_KEYS + 1).map(Number);
  const ordered = keys.every((frame, i) => i === 0 || frame > keys[i - 1]!);
  const known = keys.every((frame) => Number.isInteger(frame) && frame >= 0 && frame < MOST_FRAMES);
  return text !== "" && ordered && known && keys.length <= MOST_KEYS ? keys : undefined;
}

/** The blending of components for a state. */
export function sharingOf({ temperature }: Pick<MapState, "temperature">): PoseSharing {
  return { temperature, blur: BLUR };
}
