/** A neutral step and a style's step, and the paths of corresponding instants. Pure except for {@link warpingOf}. */
import type { Stretch } from "../../client/learn/protocol";
import type { Style } from "../built_in";
import { memoized } from "../memoized";
import { meanOf } from "../pairing";
import type { Anchor, PathName, WarpState } from "./warp_state";

/** The clip, and its step: from one left heel strike to the next. */
const ACTION = "walk";
const CLIP = "walk-pace";
const CYCLE = 2;

/** Maximum number of frames of one step that correspond to a single frame of the other. */
export const MAX_PACE = 3;

/** A step. */
export interface Step {
  frames: number;
  /** The row of its first frame in the database. */
  row: number;
  /** Foot contacts, left and right interleaved. */
  contacts: Uint8Array;
}

/** Registration data of two steps. */
export interface Warping {
  rateHz: number;
  neutral: Step;
  styled: Step;
  /** c of every pair of a frame of the neutral step and a frame of the style's, row after row. */
  costs: Float32Array;
  /** τ: for every frame of the neutral step, the frame of the style's. */
  paths: Readonly<Record<Exclude<PathName, "own">, Float32Array>>;
  /** α and β of the strongest feature in every frame. */
  scale: Float32Array;
  offset: Float32Array;
}

/** The steps of a style, registered by all methods; computed once. */
export const warpingOf = memoized(async (engine, style: Style): Promise<Warping> => {
  const [clips, { rateHz }] = await Promise.all([engine.clips(ACTION), engine.database()]);
  const stepOf = (of: string): [Stretch, Step] => {
    const { cycles, first, contacts } = clips.find(({ name }) => name === `${CLIP}_${of}`)!;
    const cycle = cycles[CYCLE]!;
    const planted = contacts.slice(2 * cycle.first, 2 * (cycle.last + 1));
    return [cycle, { frames: cycle.last - cycle.first + 1, row: first + cycle.first, contacts: planted }];
  };
  const [[a, neutral], [b, styled]] = [stepOf("neutral"), stepOf(style)];
  const [linear, dtw, imw] = await Promise.all(
    (["linear", "dtw", "imw"] as const).map((by) => engine.register(ACTION, a, b, by)),
  );
  const paths = { linear: linear!.warp, dtw: dtw!.warp, imw: imw!.warp, exact: dtw!.recorded };
  return { rateHz, neutral, styled, costs: dtw!.costs, paths, scale: imw!.scale, offset: imw!.offset };
});

/** A point of a path, in frames of both steps. */
type Place = readonly [x: number, y: number];

/** The point nearest to a given one through which two others can be connected with a pace of at most {@link MAX_PACE}. */
function joining([x, y]: Place, [x0, y0]: Place, [x1, y1]: Place, room = 1): Place {
  const clamp = (value: number, low: number, high: number) => Math.min(high, Math.max(low, value));
  const at = clamp(x, x0 + 1, x1 - room);
  const low = Math.max(y0 + (at - x0) / MAX_PACE, y1 - MAX_PACE * (x1 - at));
  const high = Math.min(y0 + MAX_PACE * (at - x0), y1 - (x1 - at) / MAX_PACE);
  return [at, clamp(y, low, high)];
}

/** The ends of both steps. */
function endsOf({ neutral, styled }: Warping): Place {
  return [neutral.frames - 1, styled.frames - 1];
}

/** The corners of the own path, in frames; anchors beyond the largest pace are moved to the nearest valid point. */
export function cornersOf(warping: Warping, anchors: readonly Anchor[]): Place[] {
  const end = endsOf(warping);
  const corners: Place[] = [[0, 0]];
  anchors.forEach(({ x, y }, i) => {
    corners.push(joining([x * end[0], y * end[1]], corners[i]!, end, anchors.length - i));
  });
  return [...corners, end];
}

/** The anchors with one of them moved to a point between its neighbours, or as near to it as the pace allows. */
export function moved(warping: Warping, anchors: readonly Anchor[], which: number, to: Anchor): Anchor[] {
  const [n, m] = endsOf(warping);
  const corners = cornersOf(warping, anchors);
  const before = corners[which]!;
  const after = corners[which + 2]!;
  const place = joining([to.x * n, to.y * m], before, after);
  return corners.slice(1, -1).map((corner, i) => {
    const [x, y] = i === which ? place : corner;
    return { x: x / n, y: y / m };
  });
}

/** τ of the own path: straight between its corners. */
export function ownPath(warping: Warping, anchors: readonly Anchor[]): Float32Array {
  const corners = cornersOf(warping, anchors);
  let k = 1;
  return Float32Array.from({ length: warping.neutral.frames }, (_, i) => {
    while (i > corners[k]![0]) k += 1;
    const [[x0, y0], [x1, y1]] = [corners[k - 1]!, corners[k]!];
    return y0 + ((y1 - y0) * (i - x0)) / (x1 - x0);
  });
}

/** τ of a state's path. */
export function pathOf(warping: Warping, { path, anchors }: Pick<WarpState, "path" | "anchors">): Float32Array {
  return path === "own" ? ownPath(warping, anchors) : warping.paths[path];
}

/** c at a frame of the neutral step and a fractional frame of the style's. */
export function costAt({ costs, styled }: Warping, frame: number, other: number): number {
  const j = Math.min(styled.frames - 2, Math.max(0, Math.floor(other)));
  const [from, to] = [costs[frame * styled.frames + j]!, costs[frame * styled.frames + j + 1]!];
  return from + (to - from) * Math.min(1, Math.max(0, other - j));
}

/**
 * The cost of each frame of a path: c, multiplied by the number of frames of the style's step that are passed, at least
 * one.
 */
export function costsAlong(warping: Warping, path: ArrayLike<number>): number[] {
  return Array.from(path, (other, i) => {
    const passed = i > 0 ? other - path[i - 1]! : 1;
    return Math.max(1, passed) * costAt(warping, i, other);
  });
}

/** Ratio of a path's cost to that of the cheapest path, from dynamic time warping. */
export function costRatio(warping: Warping, path: ArrayLike<number>): number {
  return meanOf(costsAlong(warping, path)) / meanOf(costsAlong(warping, warping.paths.dtw));
}

/** Mean distance of a path from the exact one, milliseconds. */
export function msOff({ rateHz, paths }: Warping, path: ArrayLike<number>): number {
  return (1000 / rateHz) * meanOf(paths.exact.map((exact, i) => Math.abs(path[i]! - exact)));
}

/** Planted feet at a frame of a step. */
export function feetAt({ contacts, frames }: Step, frame: number): [left: boolean, right: boolean] {
  const at = Math.min(frames - 1, Math.max(0, Math.round(frame)));
  return [contacts[2 * at] === 1, contacts[2 * at + 1] === 1];
}

/** Whether the same feet are planted in both steps where a path pairs them. */
export function feetAgree({ neutral, styled }: Warping, path: ArrayLike<number>, frame: number): boolean {
  const [a, b] = [feetAt(neutral, frame), feetAt(styled, path[frame]!)];
  return a[0] === b[0] && a[1] === b[1];
}
