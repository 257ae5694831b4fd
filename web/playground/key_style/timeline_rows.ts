/** What rows of style variables over time share: their places, the ruler, the line of a variable. */
import { formatNumber, svg } from "../dom";
import { strings } from "../strings/strings";
import { pixelOf, type Scale, ticks } from "./scale";

/** Room for the names of the rows, and to the right, pixels. */
export const GUTTER = 152;
export const NARROW_GUTTER = 92;
export const MARGIN = 20;
const RULER = 38;
const TOP = 54;
const ROOM = 12;
/** Seconds on the ruler are so far apart at least, pixels. */
const LEAST_TICK = 72;

/** Where everything is. */
export interface Layout {
  width: number;
  height: number;
  gutter: number;
  time: Scale;
  /** Top and height of every row. */
  rows: { top: number; height: number }[];
}

export function layOut(width: number, height: number, rows: number, secs: number): Layout {
  const gutter = width < 700 ? NARROW_GUTTER : GUTTER;
  const room = Math.max(24, (height - TOP - ROOM * rows) / Math.max(1, rows));
  return {
    width,
    height,
    gutter,
    time: { least: 0, most: Math.max(secs, 0.01), from: gutter, to: width - MARGIN },
    rows: Array.from({ length: rows }, (_, i) => ({ top: TOP + i * (room + ROOM), height: room })),
  };
}

/** The scale of a row: values keep clear of its edges. */
export function rowScale(
  { top, height }: { top: number; height: number },
  range: { least: number; most: number },
): Scale {
  return { ...range, from: top + height - 6, to: top + 6 };
}

/** The ruler, with the target that seeks. */
export function ruler({ time, width }: Layout): SVGElement[] {
  const count = Math.max(2, Math.floor((time.to - time.from) / LEAST_TICK));
  const { at, digits } = ticks(time, count);
  const minor = ticks(time, 5 * count).at;
  const text = (x: number, words: string, anchor: string) =>
    svg("text", { x: x.toFixed(1), y: RULER - 12, "text-anchor": anchor }, words);
  return [
    svg("rect", { class: "keys-seek", x: time.from, y: 0, width: width - time.from, height: RULER + 6 }),
    svg("line", { class: "keys-line", x1: time.from, x2: time.to, y1: RULER, y2: RULER }),
    ...minor.map((secs) => {
      const x = pixelOf(time, secs);
      return svg("line", { class: "keys-line", x1: x, x2: x, y1: RULER - (at.includes(secs) ? 7 : 4), y2: RULER });
    }),
    ...at.map((secs) =>
      secs === 0
        ? text(time.from, strings.keyStyle.zero, "start")
        : text(pixelOf(time, secs), formatNumber(secs, digits), "middle"),
    ),
  ];
}

/** A variable over time as the path of a line. */
export function lineOf(values: ArrayLike<number>, axis: number, axes: number, time: Scale, row: Scale): string {
  const points = Math.floor(values.length / axes);
  const at: string[] = [];
  for (let i = 0; i < points; i++) {
    const x = time.from + (i / Math.max(1, points - 1)) * (time.to - time.from);
    at.push(`${x.toFixed(1)} ${pixelOf(row, values[i * axes + axis]!).toFixed(1)}`);
  }
  return at.length > 1 ? `M${at.join("L")}` : "";
}
