/**
 * Paints the timeline's rows on canvases: a still layer until the next analysis, and over it a layer that moves with
 * the playhead. All rows share one x axis: the input's time.
 */

import type { FrameRange } from "../../../../client/protocol";
import { formatNumber } from "../../../../ui/dom";
import { clampedValueAt, pixelOf, ruler, type Scale } from "../../../../ui/scale";
import { strings } from "../../../strings/strings";
import type { Colours } from "../../../ui/colours";
import type { ReadStretch } from "./curves";
import type { ExampleCurves } from "./examples";

/**
 * Rows at the top, whose positions do not depend on the height; {@link Axis} has those below them. All lengths are CSS
 * pixels at the normal text size, and scale with the text.
 */
export const ROWS = {
  ruler: 21,
  /** Middle of the lane of style keys, which is on the ruler's line. */
  keys: 28,
  contacts: [36, 45],
  contactHeight: 6,
  reads: { top: 55, height: 5 },
} as const;
/** Top of the curve, and the distance of its bottom and of the rows below it from the lower edge. */
const CURVE_TOP = 65;
const FROM_BELOW = { curve: 36, timing: { top: 31, bottom: 19 } };

/** Space left and right of the axis, so that the flag and the first label are not cut off. */
const INSET = 6;
/** Minimum distance of labels on a ruler. */
const MIN_TICK = 80;

/** Contents of the still layer. Curves are in degrees, one value per frame. */
export interface TimelineData {
  frames: number;
  rateHz: number;
  inputCurve: Float32Array;
  styledCurve: Float32Array;
  /** The examples behind the styled curve; `undefined` if they cannot be shown. */
  examples: ExampleCurves | undefined;
  /** Value range of the curves. */
  span: { low: number; high: number } | undefined;
  /** Contact ranges, left and right, in frames. */
  planted: [[number, number][], [number, number][]];
  /** The recognised classes of the input. */
  reads: readonly ReadStretch[];
  /** Lines between the input's and the output's time. */
  timing: readonly { frame: number; timeOut: number }[];
  durationOutSecs: number;
}

/** Contents of the moving layer, in input frames. */
interface Overlay {
  /** The playhead. */
  frame: number;
  /** Position of the pointer over the rows. */
  hover: number | undefined;
  range: FrameRange | undefined;
  /** Unit of the curves. */
  unit: string;
}

/** Maps frames to pixels and back, and has the rows whose positions depend on the height. */
export class Axis {
  readonly curve: { readonly top: number; readonly bottom: number };
  readonly timing: { readonly top: number; readonly bottom: number };
  readonly #frames: Scale;

  constructor(
    frames: number,
    readonly width: number,
    readonly height: number,
  ) {
    this.#frames = this.along(0, Math.max(0, frames - 1));
    this.curve = { top: CURVE_TOP, bottom: height - FROM_BELOW.curve };
    this.timing = { top: height - FROM_BELOW.timing.top, bottom: height - FROM_BELOW.timing.bottom };
  }

  /** Another scale along the rows. */
  along(min: number, max: number): Scale {
    return { min, max, from: INSET, to: Math.max(INSET, this.width - INSET) };
  }

  x(frame: number): number {
    return pixelOf(this.#frames, frame);
  }

  /** Y position of a value in the curve's row. */
  y(value: number, { low, high }: { low: number; high: number }): number {
    const { top, bottom } = this.curve;
    return pixelOf({ min: low, max: high, from: bottom - 1, to: top + 1 }, value);
  }

  frame(x: number): number {
    return clampedValueAt(this.#frames, x);
  }
}

/** Ruler, contacts, curves and timing ticks. */
export function paintStill(c: CanvasRenderingContext2D, axis: Axis, data: TimelineData, colours: Colours): void {
  paintRuler(c, axis, Math.max(0, data.frames - 1) / data.rateHz, colours);
  paintContacts(c, axis, data.planted, colours);
  c.fillStyle = colours.line;
  c.fillRect(0, axis.curve.bottom + 1, axis.width, 1);
  if (data.span) {
    if (data.examples) paintBand(c, axis, data.examples, data.span, colours.weight);
    paintCurve(c, axis, data.inputCurve, data.span, colours.input, 1.25);
    paintCurve(c, axis, data.styledCurve, data.span, colours.signal, 1.75);
  }
  paintReads(c, axis, data.reads, colours);
  paintTiming(c, axis, data, colours);
}

/** The recognised classes: a bar for each, with its weight as the opacity. */
function paintReads(c: CanvasRenderingContext2D, axis: Axis, reads: readonly ReadStretch[], colours: Colours): void {
  const { top, height } = ROWS.reads;
  c.fillStyle = colours.track;
  c.fillRect(INSET, top, axis.width - 2 * INSET, height);
  c.fillStyle = colours.weight;
  for (const { from, to, weight } of reads) {
    const x = axis.x(from);
    c.globalAlpha = Math.min(1, Math.max(0.12, weight));
    c.fillRect(x, top, Math.max(1, axis.x(to) - x - 1), height);
  }
  c.globalAlpha = 1;
}

/** The output's time under the input's, connected by lines, which are slanted where the style changes the timing. */
function paintTiming(c: CanvasRenderingContext2D, axis: Axis, data: TimelineData, colours: Colours): void {
  const { top, bottom } = axis.timing;
  const duration = data.durationOutSecs;
  if (data.timing.length < 2 || duration <= 0) return;
  const out = axis.along(0, duration);
  c.strokeStyle = colours.ink3;
  c.lineWidth = 1;
  c.globalAlpha = 0.7;
  c.beginPath();
  const every = Math.ceil((5 * data.timing.length) / axis.width);
  data.timing.forEach(({ frame, timeOut }, i) => {
    if (i % every !== 0) return;
    c.moveTo(axis.x(frame), top);
    c.lineTo(pixelOf(out, timeOut), bottom);
  });
  c.stroke();
  c.globalAlpha = 1;
  c.fillStyle = colours.line2;
  c.fillRect(INSET, bottom, axis.width - 2 * INSET, 1);
  c.fillStyle = colours.ink3;
  c.font = `10.5px ${getComputedStyle(c.canvas).fontFamily}`;
  for (const { value: secs, pixel: x, label } of ruler(out, MIN_TICK)) {
    if (label === undefined) continue;
    c.fillRect(Math.round(x), bottom, 1, 4);
    if (axis.width - x >= 14) paintSecs(c, secs, label, x, bottom + 13);
  }
}

function paintRuler(c: CanvasRenderingContext2D, axis: Axis, durationSecs: number, colours: Colours): void {
  c.fillStyle = colours.line2;
  c.fillRect(0, ROWS.ruler - 0.5, axis.width, 1);
  c.font = `11px ${getComputedStyle(c.canvas).fontFamily}`;
  c.textBaseline = "alphabetic";
  for (const { value: secs, pixel, label } of ruler(axis.along(0, durationSecs), MIN_TICK)) {
    const x = Math.round(pixel);
    const length = label === undefined ? 3 : 7;
    c.fillStyle = label === undefined ? colours.line2 : colours.ink3;
    c.fillRect(x, ROWS.ruler - length, 1, length);
    if (label !== undefined && axis.width - x > 10) paintSecs(c, secs, label, x, 11);
  }
}

/** A time below or above its tick; the first has the unit and begins at its tick. */
function paintSecs(c: CanvasRenderingContext2D, secs: number, label: string, x: number, y: number): void {
  c.textAlign = secs === 0 ? "left" : "center";
  if (secs === 0) c.fillText(strings.play.timeline.zero, x - 0.5, y);
  else c.fillText(label, x, y);
}

function paintContacts(
  c: CanvasRenderingContext2D,
  axis: Axis,
  planted: TimelineData["planted"],
  colours: Colours,
): void {
  planted.forEach((stretches, foot) => {
    const y = ROWS.contacts[foot as 0 | 1];
    c.fillStyle = colours.track;
    bar(c, INSET, axis.width - 2 * INSET, y);
    c.fillStyle = colours.contact;
    for (const [from, to] of stretches) bar(c, axis.x(from), axis.x(to) - axis.x(from), y);
  });
}

/** A contact block with a gap of 1 px at its end. */
function bar(c: CanvasRenderingContext2D, x: number, width: number, y: number): void {
  c.beginPath();
  c.roundRect(x, y, Math.max(1, width - 1), ROWS.contactHeight, 1.5);
  c.fill();
}

function paintCurve(
  c: CanvasRenderingContext2D,
  axis: Axis,
  curve: Float32Array,
  span: { low: number; high: number },
  colour: string,
  width: number,
): void {
  // Long clips have many frames per pixel: the minimum and maximum of each pixel give the same line.
  const perPixel = Math.max(1, Math.floor(curve.length / axis.width));
  c.beginPath();
  for (let i = 0; i < curve.length; i += perPixel) {
    let [low, high] = [curve[i]!, curve[i]!];
    for (let j = i; j < Math.min(curve.length, i + perPixel); j++) {
      low = Math.min(low, curve[j]!);
      high = Math.max(high, curve[j]!);
    }
    const x = axis.x(i);
    c.lineTo(x, axis.y(low, span));
    if (high !== low) c.lineTo(x, axis.y(high, span));
  }
  c.strokeStyle = colour;
  c.lineWidth = width;
  c.lineJoin = "round";
  c.stroke();
}

/** The confidence band of the examples. */
function paintBand(
  c: CanvasRenderingContext2D,
  axis: Axis,
  { low, high }: ExampleCurves,
  span: { low: number; high: number },
  colour: string,
): void {
  const every = Math.max(1, Math.floor(low.length / axis.width));
  c.beginPath();
  for (let i = 0; i < high.length; i += every) c.lineTo(axis.x(i), axis.y(high[i]!, span));
  for (let i = Math.floor((low.length - 1) / every) * every; i >= 0; i -= every)
    c.lineTo(axis.x(i), axis.y(low[i]!, span));
  c.fillStyle = colour;
  c.globalAlpha = 0.26;
  c.fill();
  c.globalAlpha = 1;
}

/** The range, the playhead with its flag, the contact under it, and the values of the curves at the pointer. */
export function paintMoving(
  c: CanvasRenderingContext2D,
  axis: Axis,
  data: TimelineData,
  { frame, hover, range, unit }: Overlay,
  colours: Colours,
): void {
  if (range) paintRange(c, axis, range, colours);
  const x = axis.x(frame);
  data.planted.forEach((stretches, foot) => {
    const under = stretches.find(([from, to]) => frame >= from && frame < to);
    if (!under) return;
    c.fillStyle = colours.signal;
    bar(c, axis.x(under[0]), axis.x(under[1]) - axis.x(under[0]), ROWS.contacts[foot as 0 | 1]);
  });
  c.fillStyle = colours.ink;
  c.fillRect(x - 0.75, 8, 1.5, axis.timing.bottom - 8);
  c.beginPath();
  c.roundRect(x - 6, 8, 12, 7, [2, 2, 0, 0]);
  c.moveTo(x - 6, 15);
  c.lineTo(x + 6, 15);
  c.lineTo(x, 20);
  c.fill();
  paintPoints(c, axis, data, frame, colours);
  if (hover === undefined) return;
  c.fillStyle = colours.ink3;
  c.fillRect(axis.x(hover) - 0.5, ROWS.ruler, 1, axis.timing.bottom - ROWS.ruler);
  paintPoints(c, axis, data, hover, colours);
  paintReadOut(c, axis, data, hover, unit, colours);
}

/** Veils the rows outside the range, between the two rulers. */
function paintRange(c: CanvasRenderingContext2D, axis: Axis, range: FrameRange, colours: Colours): void {
  const [from, to] = [axis.x(range.first), axis.x(range.last)];
  const height = axis.timing.bottom - ROWS.ruler;
  c.globalAlpha = 0.7;
  c.fillStyle = colours.panel;
  c.fillRect(0, ROWS.ruler, from, height);
  c.fillRect(to, ROWS.ruler, axis.width - to, height);
  c.globalAlpha = 1;
  c.fillStyle = colours.ink;
  c.fillRect(from, ROWS.ruler - 1, to - from, 2);
  for (const edge of [from, to]) c.fillRect(edge - 0.5, ROWS.ruler, 1, height);
}

/** The examples of a frame as points: the larger the weight, the larger and more opaque. */
function paintExamples(
  c: CanvasRenderingContext2D,
  axis: Axis,
  { starts, values, weights }: ExampleCurves,
  frame: number,
  span: { low: number; high: number },
  colour: string,
): void {
  c.fillStyle = colour;
  for (let i = starts[frame] ?? 0; i < (starts[frame + 1] ?? 0); i++) {
    const y = axis.y(values[i]!, span);
    if (y < axis.curve.top - 3 || y > axis.curve.bottom + 3) continue;
    c.globalAlpha = 0.2 + 0.7 * weights[i]!;
    c.beginPath();
    c.arc(axis.x(frame), y, 1 + 1.2 * weights[i]!, 0, 2 * Math.PI);
    c.fill();
  }
  c.globalAlpha = 1;
}

/** The points of both curves at a frame. */
function paintPoints(
  c: CanvasRenderingContext2D,
  axis: Axis,
  data: TimelineData,
  frame: number,
  colours: Colours,
): void {
  const { span, examples } = data;
  if (!span) return;
  if (examples) paintExamples(c, axis, examples, Math.round(frame), span, colours.weight);
  for (const [curve, colour] of [
    [data.inputCurve, colours.input],
    [data.styledCurve, colours.signal],
  ] as const) {
    const value = curve[Math.round(frame)];
    if (value === undefined) continue;
    c.beginPath();
    c.arc(axis.x(frame), axis.y(value, span), 3, 0, 2 * Math.PI);
    c.fillStyle = colour;
    c.fill();
    c.lineWidth = 1.5;
    c.strokeStyle = colours.panel;
    c.stroke();
  }
}

/** The values of both curves as text next to the pointer. */
function paintReadOut(
  c: CanvasRenderingContext2D,
  axis: Axis,
  data: TimelineData,
  frame: number,
  unit: string,
  colours: Colours,
): void {
  const at = Math.round(frame);
  const values = [
    { text: `${formatNumber(at / data.rateHz, 2)} s`, colour: colours.ink },
    { text: describe(data.inputCurve[at], unit), colour: colours.input },
    { text: describe(data.styledCurve[at], unit), colour: colours.signal },
    { text: describeBand(data.examples, at, unit), colour: colours.ink2 },
  ].filter(({ text }) => text !== "");
  c.font = `11px ${getComputedStyle(c.canvas).fontFamily}`;
  c.textAlign = "left";
  c.textBaseline = "alphabetic";
  const widths = values.map(({ text }) => c.measureText(text).width);
  const width = widths.reduce((sum, w) => sum + w + 10, 8);
  const x = Math.min(axis.x(frame) + 10, axis.width - width - 2);
  c.beginPath();
  c.roundRect(x, axis.curve.top - 8, width, 18, 4);
  c.fillStyle = colours.raised;
  c.fill();
  c.lineWidth = 1;
  c.strokeStyle = colours.line2;
  c.stroke();
  let left = x + 9;
  for (const [i, { text, colour }] of values.entries()) {
    c.fillStyle = colour;
    c.fillText(text, left, axis.curve.top + 5);
    left += widths[i]! + 10;
  }
}

function describe(value: number | undefined, unit: string): string {
  return value === undefined ? "" : `${formatNumber(value, 1)}${unit === "°" ? "" : " "}${unit}`;
}

/** The band of a frame's examples as text; empty without examples. */
export function describeBand(examples: ExampleCurves | undefined, at: number, unit: string): string {
  const [low, high] = [examples?.low[at], examples?.high[at]];
  if (low === undefined || high === undefined) return "";
  return strings.play.timeline.examples(formatNumber((low + high) / 2, 1), describe((high - low) / 2, unit));
}
