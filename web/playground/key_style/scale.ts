/** A straight scale from values to pixels, and round numbers along it. */

export interface Scale {
  least: number;
  most: number;
  /** Pixels of the least and of the most value. */
  from: number;
  to: number;
}

export function pixelOf({ least, most, from, to }: Scale, value: number): number {
  return from + ((value - least) / (most - least)) * (to - from);
}

export function valueAt({ least, most, from, to }: Scale, pixel: number): number {
  return least + ((pixel - from) / (to - from)) * (most - least);
}

/** The range of some values with a share of it more on either side; never empty. */
export function rangeOf(values: Iterable<number>, margin: number): { least: number; most: number } {
  let [least, most] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  for (const value of values) {
    if (!Number.isFinite(value)) continue;
    least = Math.min(least, value);
    most = Math.max(most, value);
  }
  if (least > most) return { least: 0, most: 1 };
  const more = margin * (most - least) || 0.5;
  return { least: least - more, most: most + more };
}

/** Round numbers within a scale, at most `count` of them, with the decimals that they need. */
export function ticks(
  { least, most }: { least: number; most: number },
  count: number,
): { at: number[]; digits: number } {
  const rough = (most - least) / Math.max(1, count);
  if (!(rough > 0) || !Number.isFinite(rough)) return { at: [], digits: 0 };
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find((factor) => factor * power >= rough * (1 - 1e-9))!;
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const at: number[] = [];
  for (let i = Math.ceil(least / step - 1e-9); i * step <= most + 1e-9 * step; i++)
    at.push(Number((i * step).toFixed(digits)));
  return { at, digits };
}
