/** Positions of values in a plot of one quantity over another, in units (`ui/drawing.ts`). Pure functions. */

/** Size in units, and the extent of the axes. */
export interface Axes {
  width: number;
  height: number;
  x: Extent;
  y: Extent;
  /** Whether the horizontal axis is logarithmic. */
  logX?: boolean;
  /** Space around the marks, units; by default {@link MARGIN}. */
  margin?: Margin;
}

/** Space around marks, units. */
export type Margin = Readonly<Record<"left" | "right" | "top" | "bottom", number>>;

export type Extent = readonly [min: number, max: number];

/** Space for ticks and the names of the axes. */
export const MARGIN: Margin = { left: 44, right: 16, top: 16, bottom: 44 };

/** Position of a horizontal value. */
export function xOf({ width, x: [min, max], logX, margin = MARGIN }: Axes, value: number): number {
  const share = logX ? Math.log(value / min) / Math.log(max / min) : (value - min) / (max - min);
  return margin.left + share * Math.max(1, width - margin.left - margin.right);
}

/** The horizontal value at a position. */
export function valueOfX({ width, x: [min, max], logX, margin = MARGIN }: Axes, place: number): number {
  const share = (place - margin.left) / Math.max(1, width - margin.left - margin.right);
  return logX ? min * (max / min) ** share : min + share * (max - min);
}

/** Position of a vertical value. */
export function yOf({ height, y: [min, max], margin = MARGIN }: Axes, value: number): number {
  return margin.top + (1 - (value - min) / (max - min)) * Math.max(1, height - margin.top - margin.bottom);
}

/** The vertical value at a position. */
export function valueOfY({ height, y: [min, max], margin = MARGIN }: Axes, place: number): number {
  return max - ((place - margin.top) / Math.max(1, height - margin.top - margin.bottom)) * (max - min);
}

/** The curve of values at a constant rate, with gaps where a value is not finite. */
export function curvePath(axes: Axes, values: ArrayLike<number>, rateHz: number): string {
  let path = "";
  let pen = "M";
  for (let frame = 0; frame < values.length; frame++) {
    const value = values[frame]!;
    if (!Number.isFinite(value)) {
      pen = "M";
      continue;
    }
    path += `${pen}${xOf(axes, frame / rateHz).toFixed(1)} ${yOf(axes, value).toFixed(1)}`;
    pen = "L";
  }
  return path;
}

/** Rounded limits around the finite values, at least `least` apart. */
export function extentOf(values: Iterable<number>, least: number): Extent {
  let [min, max] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  for (const value of values) {
    if (!Number.isFinite(value)) continue;
    min = Math.min(min, value);
    max = Math.max(max, value);
  }
  if (!(min <= max)) return [0, least];
  const missing = Math.max(0, least - (max - min)) / 2;
  const step = stepOf(max - min + 2 * missing, 4);
  return [Math.floor((min - missing) / step) * step, Math.ceil((max + missing) / step) * step];
}

/** Round values within an extent, about `count` of them. */
export function ticksOf([min, max]: Extent, count: number): number[] {
  const step = stepOf(max - min, count);
  const first = Math.ceil(min / step - 1e-9);
  const last = Math.floor(max / step + 1e-9);
  return Array.from({ length: last - first + 1 }, (_, i) => Number(((first + i) * step).toFixed(9)));
}

/** Number of decimals that distinguishes ticks. */
export function digitsOf(ticks: readonly number[]): number {
  if (ticks.length < 2) return 0;
  return Math.max(0, -Math.floor(Math.log10(ticks[1]! - ticks[0]!) + 1e-9));
}

/** Powers of ten within an extent. */
export function decadesOf([min, max]: Extent): number[] {
  const first = Math.ceil(Math.log10(min) - 1e-9);
  const last = Math.floor(Math.log10(max) + 1e-9);
  return Array.from({ length: last - first + 1 }, (_, i) => Number(`1e${first + i}`));
}

function stepOf(span: number, count: number): number {
  const least = span / count;
  const power = 10 ** Math.floor(Math.log10(least));
  return power * [1, 2, 5, 10].find((factor) => factor * power >= least * (1 - 1e-9))!;
}
