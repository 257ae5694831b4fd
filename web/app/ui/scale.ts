/** A linear scale from values to pixels, with round ticks and a ruler. Pure. */

import { formatNumber } from "../../ui/dom";

/** Maps the values `min`–`max` to the pixels `from`–`to`, in either direction. */
export interface Scale {
  min: number;
  max: number;
  from: number;
  to: number;
}

/** Pixel of a value. A scale without extent maps every value to `from`. */
export function pixelOf({ min, max, from, to }: Scale, value: number): number {
  return max === min ? from : from + ((value - min) / (max - min)) * (to - from);
}

/** Value at a pixel; also beyond the ends of the scale. */
export function valueAt({ min, max, from, to }: Scale, pixel: number): number {
  return to === from ? min : min + ((pixel - from) / (to - from)) * (max - min);
}

/** Value at a pixel, clamped to the scale. */
export function clampedValueAt(scale: Scale, pixel: number): number {
  return Math.min(scale.max, Math.max(scale.min, valueAt(scale, pixel)));
}

/** The range of the finite values, extended by a share of it on either side; never empty. */
export function extentOf(values: Iterable<number>, margin: number): { min: number; max: number } {
  let [min, max] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  for (const value of values) {
    if (!Number.isFinite(value)) continue;
    min = Math.min(min, value);
    max = Math.max(max, value);
  }
  if (min > max) return { min: 0, max: 1 };
  const more = margin * (max - min) || 0.5;
  return { min: min - more, max: max + more };
}

/** Round values in ascending order, and their number of decimals. */
export interface Ticks {
  values: number[];
  digits: number;
}

/** Multiples of 1, 2 or 5 times a power of ten within a scale: the finest of these with at most `count` intervals. */
export function ticks(scale: Pick<Scale, "min" | "max">, count: number): Ticks {
  const step = tickStep(scale.max - scale.min, Math.max(1, count));
  return step === undefined ? { values: [], digits: 0 } : multiples(scale, step);
}

/** A mark of a ruler. */
export interface RulerMark {
  value: number;
  pixel: number;
  /** Only long marks have a label. */
  label: string | undefined;
}

/** Marks along a scale: labelled ones at least `minPx` apart, and four short ones between two of these. */
export function ruler(scale: Scale, minPx: number): RulerMark[] {
  const step = tickStep(scale.max - scale.min, Math.abs(scale.to - scale.from) / minPx);
  if (step === undefined) return [];
  const long = multiples(scale, step);
  const labels = new Map(
    long.values.map((value) => [Math.round((5 * value) / step), formatNumber(value, long.digits)]),
  );
  return multiples(scale, step / 5).values.map((value) => ({
    value,
    pixel: pixelOf(scale, value),
    label: labels.get(Math.round((5 * value) / step)),
  }));
}

/** The smallest step of 1, 2 or 5 times a power of ten that divides a length into at most `count` intervals. */
function tickStep(length: number, count: number): number | undefined {
  const minStep = length / count;
  if (!(minStep > 0) || !Number.isFinite(minStep)) return undefined;
  const power = 10 ** Math.floor(Math.log10(minStep));
  return power * [1, 2, 5, 10].find((factor) => factor * power >= minStep * (1 - 1e-9))!;
}

function multiples({ min, max }: Pick<Scale, "min" | "max">, step: number): Ticks {
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const [first, last] = [Math.ceil(min / step - 1e-9), Math.floor(max / step + 1e-9)];
  const values = Array.from({ length: last - first + 1 }, (_, i) => Number(((first + i) * step).toFixed(digits)));
  return { values, digits };
}
