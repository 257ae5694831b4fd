/** Initial keys of a model, taken from its training motions. */
import { MAX_KEYS, type TimedValue } from "../../state/key_style";

/** Shortest and longest cycle that is searched, frames: a running stride and a slow walk. */
const CYCLE = { min: 14, max: 80 };
/** Largest distance of a cycle's end from its beginning, and minimum length of its path, standard deviations. */
const NEAR = 0.35;
const MIN_WAY = 2.5;
/** Number of keys of a cycle. */
const KEYS = 8;
/** Without a cycle: distance between keys, frames, and length of the animation, seconds (specification, §8). */
const APART = 10;
const LONGEST_SECS = 2.4;

/** A cycle: frames of a training motion that end as they begin. */
interface Cycle {
  first: number;
  frames: number;
}

/**
 * The best cycle of a motion: at its end, values and rates of change of the variables equal those at its beginning.
 *
 * @param values - Values of every frame, one after another.
 * @param deviation - Scale of distances for each variable.
 */
export function cycleOf(values: ArrayLike<number>, deviation: ArrayLike<number>): Cycle | undefined {
  const axes = deviation.length;
  const frames = Math.floor(values.length / axes);
  const at = (frame: number, axis: number) => values[frame * axes + axis]! / deviation[axis]!;
  /** Distance between the variables of two frames, or between their rates of change. */
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
  let best: (Cycle & { gap: number }) | undefined;
  for (let first = 1; first + CYCLE.min + 1 < frames; first++)
    for (let length = CYCLE.min; length <= CYCLE.max && first + length + 1 < frames; length++) {
      const last = first + length;
      if (way[last]! - way[first]! < MIN_WAY) continue;
      const near = apart(first, last, false);
      if (near >= NEAR) continue;
      const gap = near + apart(first, last, true);
      // Of two cycles with nearly equal gaps, the shorter is preferred.
      if (gap < NEAR && (!best || gap < best.gap - 0.002 * (length - best.frames)))
        best = { first, frames: length, gap };
    }
  return best && { first: best.first, frames: best.frames };
}

/** Keys of a cycle; the last one equals the first. */
export function keysOfCycle(
  values: ArrayLike<number>,
  axes: number,
  { first, frames }: Cycle,
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

/** Keys taken from recorded values unchanged. */
export function keysOfRecording(values: ArrayLike<number>, axes: number, rateHz: number): TimedValue[] {
  const frames = Math.min(Math.floor(values.length / axes), Math.floor(LONGEST_SECS * rateHz + 1e-6) + 1);
  const count = Math.min(MAX_KEYS, Math.ceil(frames / APART));
  return Array.from({ length: count }, (_, key) => ({
    secs: (key * APART) / rateHz,
    values: Array.from({ length: axes }, (_, axis) => values[key * APART * axes + axis]!),
  }));
}
