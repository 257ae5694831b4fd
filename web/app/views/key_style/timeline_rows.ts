/** Shared by the timelines of keys and of recordings: the positions of their rows, the ruler, and the line of a variable. */
import "./timeline.css";
import { svg } from "../../../ui/dom";
import { type Extent, pixelOf, type Scale } from "../../../ui/scale";
import { strings } from "../../strings/strings";
import { timeRuler } from "../synthesis/time_ruler";

/** Width left of the rows, for their names, and right of them, units. */
const GUTTER = 152;
const NARROW_GUTTER = 92;
const MARGIN = 20;
/** A timeline narrower than this has the narrow gutter, units. */
const NARROW_PX = 700;
/** Vertical positions of the ruler and of the first row, and the distance of two rows, units. */
export const RULER_Y = 38;
const FIRST_ROW_Y = 54;
const ROW_GAP = 12;
const MIN_ROW_HEIGHT = 24;
const MIN_HEIGHT = 120;
/** Distance of values from the edges of their row, units. */
const ROW_PADDING = 6;
/** Minimum distance of two labels of the ruler, units. */
const LABEL_PX = 72;

/** A style variable as labelled in its row. */
export interface RowName {
  title: string;
  unit: string;
  /** Number of decimals of its values. */
  digits: number;
}

export interface Layout {
  width: number;
  height: number;
  /** Seconds. */
  time: Scale;
  rows: readonly RowPlace[];
  /** Lower end of the playhead's line. */
  bottom: number;
}

/** Vertical position of a row, units. */
interface RowPlace {
  top: number;
  height: number;
}

/** Lays out `rowCount` rows over a time in seconds. */
export function layOut(width: number, height: number, rowCount: number, secs: number): Layout {
  const used = Math.max(MIN_HEIGHT, height);
  const gutter = width < NARROW_PX ? NARROW_GUTTER : GUTTER;
  const rowHeight = Math.max(MIN_ROW_HEIGHT, (used - FIRST_ROW_Y - ROW_GAP * rowCount) / Math.max(1, rowCount));
  const rows = Array.from({ length: rowCount }, (_, i) => ({
    top: FIRST_ROW_Y + i * (rowHeight + ROW_GAP),
    height: rowHeight,
  }));
  return {
    width,
    height: used,
    time: { min: 0, max: Math.max(secs, 0.01), from: gutter, to: width - MARGIN },
    rows,
    bottom: (rows.at(-1)?.top ?? FIRST_ROW_Y) + rowHeight + 6,
  };
}

/** The scale of the values of a row. */
export function rowScale({ top, height }: RowPlace, { min, max }: Extent): Scale {
  return { min, max, from: top + height - ROW_PADDING, to: top + ROW_PADDING };
}

/** The ruler, which seeks when pressed. */
export function rulerOf({ time }: Layout): SVGGElement {
  return timeRuler({ time, y: RULER_Y, labelPx: LABEL_PX, zero: strings.synthesis.zero });
}

/** The background of a row with the name of its variable; `read` is shown below the name. */
export function rowGround({ time }: Layout, place: RowPlace, title: string, ...read: (Node | string)[]): SVGElement[] {
  const middle = place.top + place.height / 2;
  const ground = { x: time.from, y: place.top, width: time.to - time.from, height: place.height, rx: 3 };
  return [
    svg("rect", { class: "keys-row", ...ground }),
    svg("text", { class: "keys-title", x: MARGIN, y: middle - 3 }, title),
    svg("text", { class: "keys-read", x: MARGIN, y: middle + 14 }, ...read),
  ];
}

/**
 * A variable over time as path data.
 *
 * @param values - Values of all variables at equally spaced times, time after time.
 * @param axis - Index of the variable among `axes`.
 */
export function lineOf(values: ArrayLike<number>, axis: number, axes: number, time: Scale, row: Scale): string {
  const count = Math.floor(values.length / axes);
  const points: string[] = [];
  for (let i = 0; i < count; i++) {
    const x = time.from + (i / Math.max(1, count - 1)) * (time.to - time.from);
    points.push(`${x.toFixed(1)} ${pixelOf(row, values[i * axes + axis]!).toFixed(1)}`);
  }
  return points.length > 1 ? `M${points.join("L")}` : "";
}
