/** The chart of the styles: the last minute, stacked, the current moment at the right. */

import { formatNumber, html } from "../../../ui/dom";
import { sizeOf } from "../../../ui/drawing";
import { pixelOf, type Scale } from "../../../ui/scale";
import type { CrowdKind } from "../../state/crowd";
import { strings } from "../../strings/strings";
import { prepareCanvas } from "../../ui/canvas";
import { readColours } from "../../ui/colours";
import { onResize } from "../../ui/resize";
import { capitalised, spoken } from "../../ui/words";
import { type Census, COUNTS_HZ, REMEMBERED_SECS, spread, stacked } from "./census";
import type { StyleColours } from "./colours";

const words = strings.crowd;

/** Margins, units; a narrow chart has no room for names at the left. */
const PAD = { top: 16, bottom: 18, left: 76, right: 34 };
const LABEL_PX = 13;
/** Seconds between two ticks of the axis. */
const MARK_SECS = 10;

export class ShareChart {
  readonly element: HTMLElement;
  readonly #canvas = html("canvas", { role: "img" });
  readonly #colours: StyleColours;
  /** Kind of agents. */
  kind: CrowdKind = "walkers";
  #census: Census | undefined;
  #styles: readonly string[] = [];

  constructor(colours: StyleColours) {
    this.#colours = colours;
    this.element = html("div", { class: "crowd-chart" }, this.#canvas);
  }

  /** Follows the size of the page until `signal` aborts. */
  attach(signal: AbortSignal): void {
    onResize(this.element, () => this.draw(), signal);
  }

  /** Sets the counts, and the names of the styles. */
  show(census: Census | undefined, styles: readonly string[]): void {
    this.#census = census;
    this.#styles = styles;
    this.draw();
  }

  draw(): void {
    const { width, height } = sizeOf(this.element);
    if (width === 0 || height === 0) return;
    const context = prepareCanvas(this.#canvas, width, height, this.element.clientWidth / width);
    const font = getComputedStyle(this.element).fontFamily;
    context.font = `11px ${font}`;
    context.textBaseline = "middle";
    const area: Area = {
      // Seconds ago.
      time: { min: REMEMBERED_SECS, max: 0, from: PAD.left, to: width - PAD.right },
      share: { min: 0, max: 1, from: height - PAD.bottom, to: PAD.top },
    };
    const tokens = readColours(this.element);
    this.#drawAxis(context, area, tokens.ink3, tokens.line);
    const samples = this.#census?.samples ?? [];
    if (!this.#census || samples.length === 0) return;
    const order = this.#census.present;
    const edges = samples.map((sample) => stacked(sample, order));
    const x = (i: number) => pixelOf(area.time, (samples.length - 1 - i) / COUNTS_HZ);
    const y = (share: number) => pixelOf(area.share, share);
    // The first count is drawn one pixel wide.
    const columns = samples.length === 1 ? [0, 0] : samples.map((_, i) => i);
    const xs = samples.length === 1 ? [area.time.to - 1, area.time.to] : columns.map(x);
    for (const [layer, kind] of order.entries()) {
      const colour = this.#colourOf(kind);
      context.beginPath();
      for (const [n, i] of columns.entries()) context.lineTo(xs[n]!, y(edges[i]![layer + 1]!));
      for (let n = columns.length - 1; n >= 0; n--) context.lineTo(xs[n]!, y(edges[columns[n]!]![layer]!));
      context.closePath();
      context.globalAlpha = 0.24;
      context.fillStyle = colour;
      context.fill();
      context.globalAlpha = 1;
      if (layer === order.length - 1) continue;
      context.beginPath();
      for (const [n, i] of columns.entries()) context.lineTo(xs[n]!, y(edges[i]![layer + 1]!));
      context.strokeStyle = colour;
      context.lineWidth = 1.5;
      context.stroke();
    }
    this.#drawLabels(context, area, order, edges.at(-1)!, samples.at(-1)!, tokens.ink2, tokens.ink);
  }

  #drawAxis(context: CanvasRenderingContext2D, { time, share }: Area, ink: string, line: string): void {
    const { from: left, to: right } = time;
    const { from: bottom, to: top } = share;
    context.fillStyle = ink;
    context.textAlign = "left";
    context.fillText(words.of[this.kind].chart, left, 7);
    context.strokeStyle = line;
    context.lineWidth = 1;
    context.strokeRect(left + 0.5, top - 0.5, right - left - 1, bottom - top + 1);
    const room = (right - left) / (REMEMBERED_SECS / MARK_SECS);
    const every = room < 48 ? 2 : 1;
    for (let n = 0; n * MARK_SECS <= REMEMBERED_SECS; n += every) {
      const secs = n * MARK_SECS;
      context.textAlign = secs === 0 ? "right" : secs === REMEMBERED_SECS ? "left" : "center";
      context.fillText(secs === 0 ? words.now : words.secsAgo(secs), pixelOf(time, secs), bottom + 11);
    }
  }

  /** Draws names at the left and numbers at the right of the layers; of the thickest ones if there is no room for all. */
  #drawLabels(
    context: CanvasRenderingContext2D,
    { time, share }: Area,
    order: readonly number[],
    edges: readonly number[],
    counts: ArrayLike<number>,
    ink2: string,
    ink: string,
  ): void {
    const { from: bottom, to: top } = share;
    const most = Math.floor((bottom - top) / LABEL_PX) + 1;
    const shown = [...order.keys()]
      .filter((layer) => counts[order[layer]!]! >= 0.5)
      .sort((a, b) => counts[order[b]!]! - counts[order[a]!]!)
      .slice(0, most)
      .sort((a, b) => b - a);
    const middle = (layer: number) => pixelOf(share, (edges[layer]! + edges[layer + 1]!) / 2);
    const places = spread(shown.map(middle), LABEL_PX, top + 4, bottom - 4);
    const said: string[] = [];
    for (const [i, layer] of shown.entries()) {
      const kind = order[layer]!;
      const [name, count] = [this.#nameOf(kind), formatNumber(counts[kind]!, 0)];
      context.fillStyle = ink2;
      context.textAlign = "right";
      context.fillText(name, time.from - 10, places[i]!, PAD.left - 14);
      context.fillStyle = ink;
      context.textAlign = "left";
      context.fillText(count, time.to + 10, places[i]!);
      said.push(words.people2(name, Number(count)));
    }
    this.#canvas.setAttribute("aria-label", words.chartLabel(capitalised(words.of[this.kind].chart), said.join(", ")));
  }

  #nameOf(kind: number): string {
    const style = this.#styles[kind];
    return style === undefined ? words.of[this.kind].rest : spoken(style);
  }

  #colourOf(kind: number): string {
    const style = this.#styles[kind];
    return style === undefined ? this.#colours.average : this.#colours.of(style);
  }
}

/** The scales of the chart. */
interface Area {
  time: Scale;
  share: Scale;
}
