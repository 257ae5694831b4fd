/** The trail of a drag: recorded at a constant rate, replayed, and converted to keys. */
import { LONGEST_TRAIL_SECS, type TimedValue, TRAIL_RATE_HZ } from "../../state/key_style";

/** Records a drag. */
export class Recorder {
  #points: TimedValue[] = [];
  #last: TimedValue | undefined;

  /** Starts a new trail. */
  begin(): void {
    this.#points = [];
    this.#last = undefined;
  }

  /** Adds the position of the pointer, `secs` on any clock. */
  add(secs: number, values: readonly number[]): void {
    this.#last = { secs, values };
    const before = this.#points.at(-1);
    if (before && secs - before.secs < 1 / TRAIL_RATE_HZ - 1e-6) return;
    this.#points.push(this.#last);
    while (secs - this.#points[0]!.secs > LONGEST_TRAIL_SECS) this.#points.shift();
  }

  /** The trail so far; its time begins at 0. */
  get trail(): TimedValue[] {
    const first = this.#points[0];
    if (!first) return [];
    const { secs: begin } = first;
    // Times in links have two decimals, and must increase.
    const last = this.#last!.secs - this.#points.at(-1)!.secs > 0.02 ? [this.#last!] : [];
    return [...this.#points, ...last].map(({ secs, values }) => ({
      secs: Math.round((secs - begin) * 100) / 100,
      values,
    }));
  }
}

/** Length of a trail, seconds. */
export function lengthOf(trail: readonly TimedValue[]): number {
  return trail.at(-1)?.secs ?? 0;
}

/** The position at a time: interpolated, and the nearest end before and after. */
export function valuesAt(trail: readonly TimedValue[], secs: number): readonly number[] {
  const after = trail.findIndex((point) => point.secs > secs);
  if (after === 0) return trail[0]!.values;
  const [from, to] = after < 0 ? [trail.at(-1)!, trail.at(-1)!] : [trail[after - 1]!, trail[after]!];
  const share = to.secs > from.secs ? (secs - from.secs) / (to.secs - from.secs) : 0;
  return from.values.map((value, axis) => value + share * (to.values[axis]! - value));
}

/** Keys that follow a trail, at least `apart` seconds apart. */
export function keysOf(trail: readonly TimedValue[], apart: number, max: number): TimedValue[] {
  const length = lengthOf(trail);
  const count = Math.max(1, Math.min(max - 1, Math.round(length / apart)));
  if (length === 0) return trail.slice(0, 1);
  return Array.from({ length: count + 1 }, (_, i) => {
    const secs = (length * i) / count;
    return { secs, values: valuesAt(trail, secs) };
  });
}
