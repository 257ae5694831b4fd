/** Draws the background of the pad: the density of the training data, its poses, the area without support by data, the axes. */

import { formatNumber, svg } from "../../../ui/dom";
import { pixelOf, type Scale, ticks } from "../../../ui/scale";
import { strings } from "../../strings/strings";
import { contour, density, type Grid, type Loop } from "./contours";

/** Contents of the drawing, in units of the plot and values of both axes. */
interface PadPicture {
  x: Scale;
  y: Scale;
  titles: readonly [x: string, y: string];
  /** Recorded values, x and y alternating. */
  points: Float32Array;
  /** Support of the training data at each point: below 0 poses are extrapolated. */
  support: Grid;
  /** Whether the vertical axis is the recording's own time. */
  overTime: boolean;
}

/** Grid size of the density. */
const CELLS = { columns: 84, rows: 60 };
/** Contour levels as shares of the maximum density. */
const LEVELS = [0.05, 0.14, 0.28, 0.45, 0.64, 0.84];
/** Minimum distance of ticks, units. */
const TICK_PX = { x: 70, y: 46 };
/** Maximum number of dots: more would only cover each other. */
const MAX_DOTS = 2500;

/** The picture's elements, from back to front. */
export function drawPad({ x, y, titles, points, support, overTime }: PadPicture): SVGElement[] {
  const [width, height] = [x.to - x.from, y.from - y.to];
  const toPlot = (loops: readonly Loop[]) =>
    loops
      .map((loop) => {
        const at: string[] = [];
        for (let i = 0; i < loop.length; i += 2)
          at.push(`${(x.from + loop[i]! * width).toFixed(1)} ${(y.to + loop[i + 1]! * height).toFixed(1)}`);
        return `M${at.join("L")}Z`;
      })
      .join("");
  const frame = { x: x.from, y: y.to, width, height, rx: 3 };
  const frameLine = `M${x.from} ${y.to}h${width}v${height}h${-width}Z`;
  const edge = toPlot(contour(support, 0));
  const shares = new Float32Array(points.length);
  for (let i = 0; i < points.length; i += 2) {
    shares[i] = (pixelOf(x, points[i]!) - x.from) / width;
    shares[i + 1] = (pixelOf(y, points[i + 1]!) - y.to) / height;
  }
  const grid = overTime ? undefined : density(shares, CELLS.columns, CELLS.rows);
  const every = Math.ceil(points.length / 2 / MAX_DOTS);
  const dots: string[] = [];
  for (let i = 0; i < points.length; i += 2 * every)
    dots.push(`M${pixelOf(x, points[i]!).toFixed(1)} ${pixelOf(y, points[i + 1]!).toFixed(1)}h0`);
  return [
    svg(
      "defs",
      {},
      svg("clipPath", { id: "pad-clip" }, svg("rect", frame)),
      svg(
        "pattern",
        { id: "pad-hatch", width: 7, height: 7, patternUnits: "userSpaceOnUse", patternTransform: "rotate(45)" },
        svg("line", { class: "pad-hatch", x1: 0, y1: 0, x2: 0, y2: 7 }),
      ),
    ),
    svg("rect", { class: "pad-ground", ...frame }),
    svg(
      "g",
      { "clip-path": "url(#pad-clip)", "aria-hidden": "true" },
      ...(grid ? LEVELS.map((level) => svg("path", { class: "pad-level", d: toPlot(contour(grid, level)) })) : []),
      svg("path", { class: "pad-dots", d: dots.join("") }),
      svg("path", { class: "pad-unknown", d: frameLine + edge, fill: "url(#pad-hatch)", "fill-rule": "evenodd" }),
      svg("path", { class: "pad-edge", d: edge }),
    ),
    svg("rect", { class: "pad-frame", ...frame }),
    ...axes(x, y, titles, overTime),
  ];
}

function axes(x: Scale, y: Scale, [xTitle, yTitle]: readonly [string, string], overTime: boolean): SVGElement[] {
  const across = ticks(x, Math.floor((x.to - x.from) / TICK_PX.x));
  const up = overTime ? { values: [], digits: 0 } : ticks(y, Math.floor((y.from - y.to) / TICK_PX.y));
  const words = (at: Record<string, string | number>, content: string) =>
    svg("text", { "aria-hidden": "true", ...at }, content);
  return [
    ...across.values.flatMap((value) => {
      const at = pixelOf(x, value);
      return [
        svg("line", { class: "pad-tick", x1: at, x2: at, y1: y.from, y2: y.from + 5 }),
        words({ x: at, y: y.from + 19, "text-anchor": "middle" }, formatNumber(value, across.digits)),
      ];
    }),
    ...up.values.flatMap((value) => {
      const at = pixelOf(y, value);
      return [
        svg("line", { class: "pad-tick", x1: x.from - 5, x2: x.from, y1: at, y2: at }),
        words({ x: x.from - 10, y: at + 4, "text-anchor": "end" }, formatNumber(value, up.digits)),
      ];
    }),
    words({ class: "pad-axis", x: x.to, y: y.from + 42, "text-anchor": "end" }, xTitle),
    words({ class: "pad-axis", x: x.from, y: y.to - 12 }, overTime ? strings.keyStyle.recordingTime : yTitle),
  ];
}
