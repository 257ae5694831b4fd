/** Converts distances to shades: each column from its minimum distance, the brightest, to 3.2 times it. Pure functions. */

import type { AtlasPart } from "../../../../client/atlas/client_atlas";

/**
 * Smallest lower bound of the shades by part of the body, metres: windows of one take of a walk are at most this far
 * apart. Without it, an input that is in the database would leave all other windows black. For parts it is that of the
 * whole body, scaled by the ratio of the distances within which one window in a hundred is from a frame of the built-in
 * walk: 4.8 cm for the whole body, 2.9 for the legs, 2.6 for the arms, 0.9 for the torso and 0.6 for the head.
 */
export const NEAREST: Readonly<Record<AtlasPart, number>> = {
  whole: 0.04,
  legs: 0.024,
  arms: 0.022,
  torso: 0.0074,
  head: 0.005,
};

/** Upper bound of the shades, in multiples of the minimum distance of a column. */
const FARTHEST = 3.2;
/** Number of shades. */
export const SHADES = 256;

/** A picture that is filled as distances arrive, one or more columns at a time. */
export class Shades {
  /** Shade of each pixel, line by line; 0 is farthest or unknown. */
  readonly levels: Uint8Array;
  private readonly leasts: Float32Array;

  /**
   * @param nearest smallest lower bound of the shades, metres
   * @param leasts minimum distance of each column over all windows, if known: shades then do not change with the view
   */
  constructor(
    readonly columns: number,
    readonly height: number,
    private readonly nearest: number,
    leasts?: Float32Array,
  ) {
    this.levels = new Uint8Array(columns * height);
    this.leasts = leasts ?? new Float32Array(columns).fill(Number.POSITIVE_INFINITY);
  }

  /** Minimum distance of each column so far, metres. */
  get least(): Float32Array {
    return this.leasts;
  }

  /**
   * Sets a column's squared distances, which also fill the columns after it.
   * @param isWhole whether they are of all windows
   */
  take(column: number, width: number, squares: Float32Array, isWhole: boolean): void {
    let least = Number.POSITIVE_INFINITY;
    for (const square of squares) least = Math.min(least, square);
    least = Math.sqrt(least);
    if (isWhole) this.leasts[column] = least;
    else if (Number.isFinite(this.leasts[column]!)) least = this.leasts[column]!;
    const end = Math.min(this.columns, column + width);
    for (let line = 0; line < this.height; line++)
      this.levels.fill(
        shadeOf(Math.sqrt(squares[line]!), Math.max(least, this.nearest)),
        line * this.columns + column,
        line * this.columns + end,
      );
  }

  /** The line of the brightest pixel of a column. */
  brightest(column: number): number {
    let best = 0;
    for (let line = 1; line < this.height; line++)
      if (this.levels[line * this.columns + column]! > this.levels[best * this.columns + column]!) best = line;
    return best;
  }
}

/** Shade of a distance: the brightest at the minimum distance, 0 from 3.2 times that on. */
export function shadeOf(distance: number, least: number): number {
  const share = (distance / least - 1) / (FARTHEST - 1);
  return Math.round((SHADES - 1) * (1 - Math.min(1, Math.max(0, share))));
}

/** A colour, 0 to 255 each. */
export type Rgb = readonly [r: number, g: number, b: number];

/** The colours of shades, red, green and blue one after another: evenly spaced from the first of `stops` to the last. */
export function ramp(stops: readonly Rgb[]): Uint8Array {
  const colours = new Uint8Array(3 * SHADES);
  for (let shade = 0; shade < SHADES; shade++) {
    const at = (shade / (SHADES - 1)) * (stops.length - 1);
    const from = Math.min(stops.length - 2, Math.floor(at));
    const [a, b] = [stops[from]!, stops[from + 1]!];
    for (let i = 0; i < 3; i++) colours[3 * shade + i] = a[i]! + (at - from) * (b[i]! - a[i]!);
  }
  return colours;
}

/** Windows that a picture shows: the first, and the one after the last. */
export interface Span {
  first: number;
  last: number;
}

/**
 * A span with `factor` times the length, which keeps the point at a share of the picture's height; at least `least`
 * long, and within `count` windows.
 */
export function zoomed({ first, last }: Span, factor: number, at: number, least: number, count: number): Span {
  const length = Math.min(count, Math.max(Math.min(least, count), Math.round((last - first) * factor)));
  const begin = Math.round(first + at * (last - first) - at * length);
  return shifted({ first: begin, last: begin + length }, 0, count);
}

/** A span moved by some windows, within `count`. */
export function shifted({ first, last }: Span, by: number, count: number): Span {
  const length = last - first;
  const begin = Math.min(Math.max(0, first + by), count - length);
  return { first: begin, last: begin + length };
}

/** Neighbouring classes that share a label: the windows at which they begin and end. */
export interface Band extends Span {
  label: string;
}

/**
 * The bands of a span: the classes of an action if they are as high as a line of text on average, otherwise the action.
 * @param firsts index of the first window of each class, and of all windows
 * @param windowsOfText number of windows with the height of a line of text
 */
export function bandsOf(
  classes: readonly { action: string; style: string }[],
  firsts: ArrayLike<number>,
  { first, last }: Span,
  windowsOfText: number,
): Band[] {
  const shown = classes.flatMap(({ action, style }, i) => {
    const [from, to] = [Math.max(first, firsts[i]!), Math.min(last, firsts[i + 1]!)];
    return from < to ? [{ action, style, first: from, last: to }] : [];
  });
  const bands: Band[] = [];
  for (let i = 0; i < shown.length; ) {
    const { action } = shown[i]!;
    const end = shown.findIndex((band, j) => j > i && band.action !== action);
    const ofAction = shown.slice(i, end < 0 ? shown.length : end);
    const span = { first: ofAction[0]!.first, last: ofAction.at(-1)!.last };
    const isRoomy = span.last - span.first >= windowsOfText * ofAction.length;
    // The first one with room for text names the action, also for those after it.
    const named = ofAction.findIndex(({ first, last }) => last - first >= windowsOfText);
    const label = (i: number) => (i === named ? `${action} ${ofAction[i]!.style}` : ofAction[i]!.style);
    if (isRoomy) bands.push(...ofAction.map(({ first, last }, i) => ({ label: label(i), first, last })));
    else bands.push({ label: action, ...span });
    i += ofAction.length;
  }
  return bands;
}
