/** Scales of charts: from values to pixels and back, with round ticks and a ruler. Pure. */

import { formatNumber } from "./dom";

/** A range of values. */
export interface Extent {
  min: number;
  max: number;
}

/** Maps the values `min`–`max` to the pixels `from`–`to`, in either direction. */
export interface Scale extends Extent {
  from: number;
  to: number;
  /** Whether equal distances are equal ratios. */
  log?: boolean;
}

/** Pixel of a value. A scale without extent maps every value to `from`. */
export function pixelOf({ min, max, from, to, log }: Scale, value: number): number {
  if (max === min) return from;
  const share = log ? Math.log(value / min) / Math.log(max / min) : (value - min) / (max - min);
  return from + share * (to - from);
}

/** Value at a pixel; also beyond the ends of the scale. */
export function valueAt({ min, max, from, to, log }: Scale, pixel: number): number {
  if (to === from) return min;
  const share = (pixel - from) / (to - from);
  return log ? min * (max / min) ** share : min + share * (max - min);
}

/** Value at a pixel, clamped to the scale. */
export function clampedValueAt(scale: Scale, pixel: number): number {
  return Math.min(scale.max, Math.max(scale.min, valueAt(scale, pixel)));
}

/** The finite values' own range; `undefined` without any. */
function rangeOf(values: Iterable<number>): Extent | undefined {
  let [min, max] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  for (const value of values) {
    if (!Number.isFinite(value)) continue;
    min = Math.min(min, value);
    max = Math.max(max, value);
  }
  return min <= max ? { min, max } : undefined;
}

/** The range of the finite values, extended by a share of it on either side; never empty. */
export function paddedExtent(values: Iterable<number>, margin: number): Extent {
  const range = rangeOf(values);
  if (!range) return { min: 0, max: 1 };
  const more = margin * (range.max - range.min) || 0.5;
  return { min: range.min - more, max: range.max + more };
}

/** Round limits around the finite values, at least `least` apart. */
export function roundedExtent(values: Iterable<number>, least: number): Extent {
  const range = rangeOf(values);
  if (!range) return { min: 0, max: least };
  const { min, max } = range;
  const missing = Math.max(0, least - (max - min)) / 2;
  const step = tickStep(max - min + 2 * missing, 4);
  if (step === undefined) return range;
  return { min: Math.floor((min - missing) / step) * step, max: Math.ceil((max + missing) / step) * step };
}

/** Round values in ascending order, and their number of decimals. */
export interface Ticks {
  values: number[];
  digits: number;
}

/** Multiples of 1, 2 or 5 times a power of ten within a scale: the finest of these with at most `count` intervals. */
export function ticks(extent: Extent, count: number): Ticks {
  const step = tickStep(extent.max - extent.min, Math.max(1, count));
  return step === undefined ? { values: [], digits: 0 } : multiples(extent, step);
}

/** Powers of ten within a range. */
export function decades({ min, max }: Extent): number[] {
  const [first, last] = [Math.ceil(Math.log10(min) - 1e-9), Math.floor(Math.log10(max) + 1e-9)];
  return Array.from({ length: last - first + 1 }, (_, i) => Number(`1e${first + i}`));
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

function multiples({ min, max }: Extent, step: number): Ticks {
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const [first, last] = [Math.ceil(min / step - 1e-9), Math.floor(max / step + 1e-9)];
  const values = Array.from({ length: last - first + 1 }, (_, i) => Number(((first + i) * step).toFixed(digits)));
  return { values, digits };
}
