/** The trim of a motion: the range of its frames that is played. Pure functions over frames. */
import type { FrameRange } from "../../../../client/protocol";

/** An end of the trim. */
export type Edge = keyof FrameRange;

/** The trim within a motion of `frames` frames; the whole motion without a trim. */
export function trimOf(range: FrameRange | undefined, frames: number): FrameRange {
  const last = Math.max(1, frames - 1);
  if (!range) return { first: 0, last };
  const first = Math.min(Math.max(0, range.first), last - 1);
  return { first, last: Math.min(Math.max(first + 1, range.last), last) };
}

/**
 * The trim after one of its ends moved to a frame. It stays within the motion and at least two frames long; `undefined`
 * if it is the whole motion.
 */
export function withEdge(
  range: FrameRange | undefined,
  edge: Edge,
  frame: number,
  frames: number,
): FrameRange | undefined {
  const { first, last } = trimOf(range, frames);
  const at = Math.round(frame);
  const moved =
    edge === "first"
      ? { first: Math.min(Math.max(0, at), last - 1), last }
      : { first, last: Math.min(Math.max(first + 1, at), Math.max(1, frames - 1)) };
  return isWhole(moved, frames) ? undefined : moved;
}

/** The trim between two frames, in either order; `undefined` if it is the whole motion. */
export function trimBetween(a: number, b: number, frames: number): FrameRange | undefined {
  const [first, last] = [Math.round(Math.min(a, b)), Math.round(Math.max(a, b))];
  const trim = trimOf({ first, last: Math.max(last, first + 1) }, frames);
  return isWhole(trim, frames) ? undefined : trim;
}

/** Length of the trim, seconds. */
export function trimSecs(
  range: FrameRange | undefined,
  { frames, rateHz }: { frames: number; rateHz: number },
): number {
  const { first, last } = trimOf(range, frames);
  return (last - first) / rateHz;
}

function isWhole({ first, last }: FrameRange, frames: number): boolean {
  return first === 0 && last >= frames - 1;
}
