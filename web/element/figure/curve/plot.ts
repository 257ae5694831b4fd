/** Where values lie in a plot over seconds. Pure. */

/** Size in pixels, and the extent of the axes. */
export interface Plot {
  width: number;
  height: number;
  secs: number;
  /** Upper end of the vertical axis, which begins at 0. */
  top: number;
}

/** Room around the curves, pixels. */
const MARGIN = { left: 32, right: 20, top: 20, bottom: 56 };

/** Pixel of a time. */
export function xOf({ width, secs }: Plot, time: number): number {
  return MARGIN.left + (time / secs) * Math.max(1, width - MARGIN.left - MARGIN.right);
}

/** Pixel of a value. */
export function yOf({ height, top }: Plot, value: number): number {
  return MARGIN.top + (1 - value / top) * Math.max(1, height - MARGIN.top - MARGIN.bottom);
}

/** The curve of values at a rate; it has gaps where a value is not finite. */
export function curvePath(plot: Plot, values: ArrayLike<number>, rateHz: number): string {
  let path = "";
  let pen = "M";
  for (let f = 0; f < values.length; f++) {
    const value = values[f]!;
    if (!Number.isFinite(value)) {
      pen = "M";
      continue;
    }
    path += `${pen}${xOf(plot, f / rateHz).toFixed(1)} ${yOf(plot, value).toFixed(1)}`;
    pen = "L";
  }
  return path;
}

/** A round upper end for some values. */
export function niceTop(values: Iterable<number>): number {
  let most = 0;
  for (const value of values) if (Number.isFinite(value)) most = Math.max(most, value);
  const step = stepOf(most || 1, 4);
  return Math.max(step, Math.ceil(most / step - 1e-9) * step);
}

/** Round values from 0 to an end, at most `count` intervals. */
export function ticksTo(end: number, count: number): number[] {
  const step = stepOf(end, count);
  return Array.from({ length: Math.floor(end / step + 1e-9) + 1 }, (_, i) => Number((i * step).toFixed(6)));
}

function stepOf(end: number, count: number): number {
  const least = end / count;
  const power = 10 ** Math.floor(Math.log10(least));
  return power * [1, 2, 5, 10].find((factor) => factor * power >= least * (1 - 1e-9))!;
}
