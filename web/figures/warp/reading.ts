/** The pair of instants of a path at the cursor: both figures of a warp use it. */
import type { Style } from "../built_in";
import { formatNumber, type Words } from "../words/words";
import type { WarpState } from "./warp_state";
import { costAt, feetAt, pathOf, type Step, type Warping } from "./warping";

/** A pair of instants. */
export interface Reading {
  /** Frame of the neutral step, and the fractional frame of the style's. */
  frame: number;
  other: number;
  /** c. */
  cost: number;
  /** As text: their times, and the planted feet. */
  said: { style: string; time: string; tau: string; neutral: string; styled: string };
}

/** A time in whole milliseconds. */
export function wholeMs(frames: number, { rateHz }: Warping, words: Words): string {
  return formatNumber((1000 * frames) / rateHz, 0, words);
}

/** The pair of instants of a state's path at its cursor. */
export function readAt(warping: Warping, state: WarpState, words: Words): Reading {
  const frame = Math.min(state.at, warping.neutral.frames - 1);
  const other = pathOf(warping, state)[frame]!;
  const style: Style = state.style;
  return {
    frame,
    other,
    cost: costAt(warping, frame, other),
    said: {
      style: words.styles[style],
      time: wholeMs(frame, warping, words),
      tau: wholeMs(other, warping, words),
      neutral: feetIn(words, warping.neutral, frame),
      styled: feetIn(words, warping.styled, other),
    },
  };
}

/** The planted feet, as text. */
function feetIn({ warp: { feet } }: Words, step: Step, frame: number): string {
  const [left, right] = feetAt(step, frame);
  if (left) return right ? feet.both : feet.left;
  return right ? feet.right : feet.none;
}
