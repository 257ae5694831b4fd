/** Measures for the exercises about a warp. */
import type { LearnEngine } from "../../client/learn/protocol";
import type { Measure } from "../kind";
import type { Anchor, WarpState } from "./warp_state";
import {
  cornersOf,
  costRatio,
  costsAlong,
  feetAgree,
  msOff,
  ownPath,
  pathOf,
  type Warping,
  warpingOf,
} from "./warping";

/** Frames at which linear time pairs a planted foot with a lifted one, and dynamic time warping does not. */
export function mendedFrames(warping: Warping): number[] {
  const { linear, dtw } = warping.paths;
  return Array.from({ length: warping.neutral.frames }, (_, i) => i).filter(
    (i) => !feetAgree(warping, linear, i) && feetAgree(warping, dtw, i),
  );
}

/**
 * The segment of the own path, between two of its corners, with the largest excess cost over the cheapest path in the
 * same frames.
 */
function dearestPart(warping: Warping, anchors: readonly Anchor[]) {
  const corners = cornersOf(warping, anchors);
  const own = ownPath(warping, anchors);
  const { dtw } = warping.paths;
  const [dear, cheap] = [costsAlong(warping, own), costsAlong(warping, dtw)];
  const parts = corners.slice(1).map(([to], k) => {
    const from = corners[k]![0];
    const frames = dear.map((_, i) => i).filter((i) => i >= from && i <= to);
    const sum = (of: (i: number) => number) => frames.reduce((total, i) => total + of(i), 0);
    return { from, to, excess: sum((i) => dear[i]! - cheap[i]!), above: sum((i) => dtw[i]! - own[i]!) };
  });
  return parts.reduce((a, b) => (b.excess > a.excess ? b : a));
}

/** The measure of a state; times of whole milliseconds are text. */
export async function measureWarp(engine: LearnEngine, state: WarpState): Promise<Measure> {
  const warping = await warpingOf(engine, state.style);
  const { neutral, paths, rateHz } = warping;
  const at = Math.min(state.at, neutral.frames - 1);
  const own = ownPath(warping, state.anchors);
  const dearest = dearestPart(warping, state.anchors);
  const mended = mendedFrames(warping);
  const nearest = mended.reduce((found, i) => (Math.abs(i - at) < Math.abs(found - at) ? i : found), mended[0] ?? -1);
  const ms = (frames: number) => String(Math.round((1000 * frames) / rateHz));
  const off = (path: ArrayLike<number>) => String(Math.round(msOff(warping, path)));
  return {
    style: state.style,
    path: state.path,
    at,
    time: ms(at),
    tau: ms(pathOf(warping, state)[at]!),
    tauDtw: ms(paths.dtw[at]!),
    tauLinear: ms(paths.linear[at]!),
    cost: costRatio(warping, own),
    costLinear: costRatio(warping, paths.linear),
    costExact: costRatio(warping, paths.exact),
    off: off(own),
    offDtw: off(paths.dtw),
    offImw: off(paths.imw),
    offLinear: off(paths.linear),
    dearFrom: ms(dearest.from),
    dearTo: ms(dearest.to),
    bend: dearest.above > 0 ? "up" : "down",
    agreeLinear: feetAgree(warping, paths.linear, at) ? 1 : 0,
    agreeDtw: feetAgree(warping, paths.dtw, at) ? 1 : 0,
    mended: nearest,
  };
}
