/** The keys that a model begins with: taken from its training motions, so that they show what it has learned. */
import { MOST_KEYS, type TimedValue } from "./keys";

/** Shortest and longest turn that is looked for, frames: a running stride, and somebody who is slow. */
const TURN = { least: 14, most: 80 };
/** A turn ends this near to where it began, and goes this far at least, standard deviations. */
const NEAR = 0.35;
const LEAST_WAY = 2.5;
/** Keys of a turn. */
const KEYS = 8;
/** Without a turn keys are so many frames apart, and last so long, seconds (specification, §8). */
const APART = 10;
const LONGEST_SECS = 2.4;

/** Frames of a training motion that lead back to where they begin. */
export interface Turn {
  first: number;
  frames: number;
}

/**
 * The best turn of a motion: where it ends, its variables are where they began and go the same way on.
 *
 * @param values - Values of every frame, one after the other.
 * @param deviation - What counts as far for each variable.
 */
export function turnOf(values: ArrayLike<number>, deviation: ArrayLike<number>): Turn | undefined {
  const axes = deviation.length;
  const frames = Math.floor(values.length / axes);
  const at = (frame: number, axis: number) => values[frame * axes + axis]! / deviation[axis]!;
  /** Distance between the places of two frames, or between how the variables change there. */
  const apart = (a: number, b: number, change: boolean): number => {
    let sum = 0;
    for (let axis = 0; axis < axes; axis++) {
      const by = change
        ? at(b + 1, axis) - at(b - 1, axis) - at(a + 1, axis) + at(a - 1, axis)
        : at(b, axis) - at(a, axis);
      sum += by * by;
    }
    return Math.sqrt(sum);
  };
  const way = new Float64Array(frames);
  for (let f = 1; f < frames; f++) way[f] = way[f - 1]! + apart(f - 1, f, false);
  let best: (Turn & { gap: number }) | undefined;
  for (let first = 1; first + TURN.least + 1 < frames; first++)
    for (let length = TURN.least; length <= TURN.most && first + length + 1 < frames; length++) {
      const last = first + length;
      if (way[last]! - way[first]! < LEAST_WAY) continue;
      const near = apart(first, last, false);
      if (near >= NEAR) continue;
      const gap = near + apart(first, last, true);
      // A second turn ends as near as the first: the shorter one is meant.
      if (gap < NEAR && (!best || gap < best.gap - 0.002 * (length - best.frames)))
        best = { first, frames: length, gap };
    }
  return best && { first: best.first, frames: best.frames };
}

/** Keys of a turn, the last one being the first again. */
export function keysOfTurn(
  values: ArrayLike<number>,
  axes: number,
  { first, frames }: Turn,
  rateHz: number,
): TimedValue[] {
  const at = (place: number, axis: number) => {
    const [frame, share] = [Math.floor(place), place % 1];
    const [a, b] = [values[frame * axes + axis]!, values[(frame + 1) * axes + axis] ?? 0];
    return share === 0 ? a : a + share * (b - a);
  };
  const length = frames / rateHz;
  return Array.from({ length: KEYS + 1 }, (_, key) => ({
    secs: (length * key) / KEYS,
    values: Array.from({ length: axes }, (_, axis) => at(first + ((key % KEYS) * frames) / KEYS, axis)),
  }));
}

/** Keys taken from recorded values as they are. */
export function keysOfRecording(values: ArrayLike<number>, axes: number, rateHz: number): TimedValue[] {
  const frames = Math.min(Math.floor(values.length / axes), Math.floor(LONGEST_SECS * rateHz + 1e-6) + 1);
  const count = Math.min(MOST_KEYS, Math.ceil(frames / APART));
  return Array.from({ length: count }, (_, key) => ({
    secs: (key * APART) / rateHz,
    values: Array.from({ length: axes }, (_, axis) => values[key * APART * axes + axis]!),
  }));
}
