/**
 * Paints the timeline's rows on canvases: what stays until the next analysis, and over it what moves with the
 * playhead. All rows share one x: the input's time.
 */
import type { Colours } from "../colours";
import { tickSpacing } from "./curves";

/** Rows from the top, in CSS pixels of a timeline 135 high. */
export const ROWS = {
  ruler: 21,
  contacts: [34, 45],
  contactHeight: 6,
  curve: { top: 60, bottom: 99 },
  timing: { top: 115, bottom: 124 },
  height: 135,
} as const;

/** Space left and right of the axis, so that the flag and the first label are not cut off. */
export const INSET = 6;

/** All that the still layer shows. Curves are in degrees, one value a frame. */
export interface TimelineData {
  frames: number;
  rateHz: number;
  inputCurve: Float32Array;
  styledCurve: Float32Array;
  /** Value range of the curves. */
  span: { low: number; high: number } | undefined;
  /** Planted stretches, left and right, in frames. */
  planted: [[number, number][], [number, number][]];
  /** Frames at which a tenth of a second of output has passed. */
  ticks: number[];
}

/** Maps frames to pixels and back. */
export class Axis {
  constructor(
    readonly frames: number,
    readonly width: number,
  ) {}

  x(frame: number): number {
    return INSET + (frame / Math.max(1, this.frames - 1)) * (this.width - 2 * INSET);
  }

  frame(x: number): number {
    const share = (x - INSET) / Math.max(1, this.width - 2 * INSET);
    return Math.min(1, Math.max(0, share)) * Math.max(0, this.frames - 1);
  }
}

/** Sizes a canvas for sharp pixels and returns its context in CSS pixels, cleared. */
export function prepare(canvas: HTMLCanvasElement, width: number, height: number): CanvasRenderingContext2D {
  const context = canvas.getContext("2d")!;
  const ratio = devicePixelRatio || 1;
  const [w, h] = [Math.round(width * ratio), Math.round(height * ratio)];
  if (canvas.width !== w || canvas.height !== h) {
    canvas.width = w;
    canvas.height = h;
  }
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  return context;
}

/** Ruler, contacts, curves and timing ticks. */
export function paintStill(c: CanvasRenderingContext2D, axis: Axis, data: TimelineData, colours: Colours): void {
  paintRuler(c, axis, data.rateHz, colours);
  paintContacts(c, axis, data.planted, colours);
  c.fillStyle = colours.line;
  c.fillRect(0, ROWS.curve.bottom + 1, axis.width, 1);
  if (data.span) {
    paintCurve(c, axis, data.inputCurve, data.span, colours.input, 1.25);
    paintCurve(c, axis, data.styledCurve, data.span, colours.signal, 1.75);
  }
  c.fillStyle = colours.ink3;
  const { top, bottom } = ROWS.timing;
  const spacing = data.ticks.length > 1 ? (axis.width - 2 * INSET) / data.ticks.length : axis.width;
  const every = Math.ceil(5 / spacing);
  data.ticks.forEach((frame, i) => {
    if (i % every === 0) c.fillRect(Math.round(axis.x(frame)), top, 1, bottom - top);
  });
}

function paintRuler(c: CanvasRenderingContext2D, axis: Axis, rateHz: number, colours: Colours): void {
  const duration = Math.max(0, axis.frames - 1) / rateHz;
  const step = tickSpacing(duration, axis.width, 80);
  const minor = step / 5;
  c.fillStyle = colours.line2;
  c.fillRect(0, ROWS.ruler - 0.5, axis.width, 1);
  c.font = `11px ${getComputedStyle(c.canvas).fontFamily}`;
  c.textBaseline = "alphabetic";
  const digits = Math.max(0, -Math.floor(Math.log10(step)));
  for (let i = 0; i * minor <= duration + 1e-6; i++) {
    const labelled = i % 5 === 0;
    const x = Math.round(axis.x(i * minor * rateHz));
    c.fillStyle = labelled ? colours.ink3 : colours.line2;
    c.fillRect(x, ROWS.ruler - (labelled ? 7 : 3), 1, labelled ? 7 : 3);
    if (!labelled) continue;
    c.textAlign = i === 0 ? "left" : "center";
    const seconds = (i * minor).toFixed(digits);
    if (axis.width - x > 10) c.fillText(i === 0 ? "0 s" : seconds, i === 0 ? x - 0.5 : x, 11);
  }
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

/** A contact block; 1 px stays free at its end so that neighbours do not melt into one. */
function bar(c: CanvasRenderingContext2D, x: number, width: number, y: number): void {
  c.beginPath();
  c.roundRect(x, y, Math.max(1, width - 1), ROWS.contactHeight, 1.5);
  c.fill();
}

const yOf = (value: number, { low, high }: { low: number; high: number }): number =>
  ROWS.curve.bottom - 1 - ((value - low) / (high - low)) * (ROWS.curve.bottom - ROWS.curve.top - 2);

function paintCurve(
  c: CanvasRenderingContext2D,
  axis: Axis,
  curve: Float32Array,
  span: { low: number; high: number },
  colour: string,
  width: number,
): void {
  // Long clips have many frames a pixel: least and greatest of each pixel draw the same line.
  const perPixel = Math.max(1, Math.floor(curve.length / axis.width));
  c.beginPath();
  for (let i = 0; i < curve.length; i += perPixel) {
    let [low, high] = [curve[i]!, curve[i]!];
    for (let j = i; j < Math.min(curve.length, i + perPixel); j++) {
      low = Math.min(low, curve[j]!);
      high = Math.max(high, curve[j]!);
    }
    const x = axis.x(i);
    c.lineTo(x, yOf(low, span));
    if (high !== low) c.lineTo(x, yOf(high, span));
  }
  c.strokeStyle = colour;
  c.lineWidth = width;
  c.lineJoin = "round";
  c.stroke();
}

/** The playhead with its flag, the contact that is under it, and its points on the curves. */
export function paintMoving(
  c: CanvasRenderingContext2D,
  axis: Axis,
  data: TimelineData,
  frame: number,
  colours: Colours,
): void {
  const x = axis.x(frame);
  data.planted.forEach((stretches, foot) => {
    const under = stretches.find(([from, to]) => frame >= from && frame < to);
    if (!under) return;
    c.fillStyle = colours.signal;
    bar(c, axis.x(under[0]), axis.x(under[1]) - axis.x(under[0]), ROWS.contacts[foot as 0 | 1]);
  });
  c.fillStyle = colours.ink;
  c.fillRect(x - 0.75, 8, 1.5, ROWS.height - 14);
  c.beginPath();
  c.roundRect(x - 6, 8, 12, 7, [2, 2, 0, 0]);
  c.moveTo(x - 6, 15);
  c.lineTo(x + 6, 15);
  c.lineTo(x, 20);
  c.fill();
  const { span } = data;
  if (!span) return;
  for (const [curve, colour] of [
    [data.inputCurve, colours.input],
    [data.styledCurve, colours.signal],
  ] as const) {
    const value = curve[Math.round(frame)];
    if (value === undefined) continue;
    c.beginPath();
    c.arc(x, yOf(value, span), 3, 0, 2 * Math.PI);
    c.fillStyle = colour;
    c.fill();
    c.lineWidth = 1.5;
    c.strokeStyle = colours.panel;
    c.stroke();
  }
}
