/** The state of figures about a step of a style that is registered with a neutral one. */
import { choice, type Fields, listed, number } from "../../link/fields";
import { STYLES, type Style } from "../built_in";

/** Sources of the correspondence: as the database was made, linear time, the two methods, or a path bent by hand. */
export const PATHS = ["linear", "dtw", "imw", "own", "exact"] as const;
export type PathName = (typeof PATHS)[number];

/** A corner of the own path: a share of the neutral step, and the corresponding share of the style's. */
export interface Anchor {
  x: number;
  y: number;
}

/** Which step, which path, and the instant at which it is read. */
export interface WarpState {
  style: Style;
  path: PathName;
  /** Frame of the neutral step. */
  at: number;
  /** From left to right; the path is straight between them and the ends. */
  anchors: readonly Anchor[];
}

/** Styles that are registered with the neutral one. */
export const WARPED = STYLES.slice(1);

/** Decimals of an anchor. */
const DIGITS = 3;
const START: readonly Anchor[] = [0.25, 0.5, 0.75].map((share) => ({ x: share, y: share }));

/** `x:y,…` */
function encodeAnchors(anchors: readonly Anchor[]): string {
  return anchors.map(({ x, y }) => [x, y].map((share) => Number(share.toFixed(DIGITS))).join(":")).join(",");
}

/** Decodes {@link encodeAnchors}; `undefined` if it is invalid. */
function decodeAnchors(text: string): readonly Anchor[] | undefined {
  const anchors = text.split(",").map((part) => part.split(":").map(Number));
  const isShare = (value: number) => value > 0 && value < 1;
  if (anchors.length !== START.length || !anchors.every((one) => one.length === 2 && one.every(isShare)))
    return undefined;
  return anchors.map(([x, y]) => ({ x: x!, y: y! }));
}

/** Encoding of the state in a link. */
export const WARP_FIELDS: Fields<WarpState> = {
  style: choice("style", "old", WARPED, true),
  path: choice("path", "linear", PATHS, true),
  at: number("i", 20, { min: 0, max: 200, digits: 0 }, true),
  anchors: listed("anchors", START, encodeAnchors, decodeAnchors),
};
