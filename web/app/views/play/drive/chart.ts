/** Chart of the speed over the last half minute: requested and actual. */
import type { DriveControl, DriveFrame, DriveInfo } from "../../../../client/drive/protocol";
import { formatNumber, html, setAttributes } from "../../../../ui/dom";
import { pixelOf, type Scale } from "../../../../ui/scale";
import { prepareCanvas } from "../../../ui/canvas";
import { type Colours, readColours } from "../../../ui/colours";
import { driveWords } from "./strings.en";

/** Duration of the chart, seconds, and duration per point. */
const SPAN_SECS = 30;
const POINT_SECS = 0.1;
const POINTS = SPAN_SECS / POINT_SECS;
/** Distance of ticks, seconds. */
const TICK_SECS = 5;

export class DriveChart {
  readonly element = html("canvas", { class: "drive-chart", role: "img" });
  readonly #speeds: DriveInfo["speeds"];
  readonly #points: { asked: number; driven: number }[] = [];
  #secs = 0;
  #colours: Colours | undefined;
  #ticks = 0;

  constructor({ speeds }: DriveInfo) {
    this.#speeds = speeds;
  }

  /** Adds the requested and the actual speed. */
  take({ move, gait }: DriveControl, { speed, timeOut, progress }: DriveFrame): void {
    if (timeOut - this.#secs < POINT_SECS && timeOut >= this.#secs) return;
    this.#secs = timeOut;
    const [walk, run] = this.#speeds;
    const full = gait <= 1 ? gait * walk : walk + (gait - 1) * (run - walk);
    const share = progress === undefined ? Math.hypot(...move) : 1;
    this.#points.push({ asked: share * full, driven: speed });
    if (this.#points.length > POINTS) this.#points.shift();
    this.#ticks += 1;
    this.draw();
  }

  /** Applies the colours of another theme. */
  recolour(): void {
    this.#colours = undefined;
    this.draw();
  }

  draw(): void {
    const { element: canvas } = this;
    const { clientWidth: width, clientHeight: height } = canvas;
    if (width * height === 0) return;
    const pen = prepareCanvas(canvas, width, height, 1);
    this.#colours ??= readColours(document.body);
    const { line, ink3, input, signal } = this.#colours;
    const rem = Number.parseFloat(getComputedStyle(document.documentElement).fontSize);
    const [left, top, bottom] = [4.75 * rem, 1.25 * rem, height - 0.5 * rem];
    const most = Math.max(this.#speeds[1], 1.25 * this.#speeds[0]);
    // The last point is at the right.
    const points: Scale = { min: this.#points.length - POINTS, max: this.#points.length - 1, from: left, to: width };
    const speeds: Scale = { min: 0, max: 1.1 * most, from: bottom, to: top };
    const ago: Scale = { min: SPAN_SECS, max: 0, from: left, to: width };
    const xOf = (point: number) => pixelOf(points, point);
    const yOf = (speed: number) => pixelOf(speeds, Math.min(speed, speeds.max));
    pen.font = `${0.6875 * rem}px ${getComputedStyle(canvas).fontFamily}`;
    pen.textBaseline = "middle";
    pen.lineWidth = 1;
    // Ticks move with the curve.
    const shift = (this.#ticks * POINT_SECS) % TICK_SECS;
    pen.strokeStyle = line;
    pen.beginPath();
    for (let secs = shift; secs <= SPAN_SECS; secs += TICK_SECS) {
      const x = Math.round(pixelOf(ago, secs)) - 0.5;
      pen.moveTo(x, top);
      pen.lineTo(x, bottom);
    }
    for (const speed of [0, ...this.#speeds]) {
      const y = Math.round(yOf(speed)) + 0.5;
      pen.moveTo(left, y);
      pen.lineTo(width, y);
    }
    pen.stroke();
    pen.fillStyle = ink3;
    pen.textAlign = "right";
    for (const speed of new Set(this.#speeds)) pen.fillText(formatNumber(speed, 1), left - 0.5 * rem, yOf(speed));
    pen.fillText("0", left - 0.5 * rem, yOf(0));
    pen.textAlign = "left";
    pen.fillText(driveWords.speedAxis, 0, 0.5 * rem);
    this.#curve(pen, input, 1.25, (i) => [xOf(i), yOf(this.#points[i]!.asked)]);
    this.#curve(pen, signal, 1.75, (i) => [xOf(i), yOf(this.#points[i]!.driven)]);
    setAttributes(canvas, { "aria-label": driveWords.chart(formatNumber(this.#points.at(-1)?.driven ?? 0, 1)) });
  }

  #curve(
    pen: CanvasRenderingContext2D,
    colour: string,
    width: number,
    at: (point: number) => readonly [number, number],
  ): void {
    pen.strokeStyle = colour;
    pen.lineWidth = width;
    pen.lineJoin = "round";
    pen.beginPath();
    for (let i = 0; i < this.#points.length; i++) pen.lineTo(...at(i));
    pen.stroke();
  }
}
