/** Duration of each neighbour's frame over the neighbour's distance, and the kernel-weighted mean. */
import type { Timing } from "../../client/learn/protocol";
import { html, keepCount, setAttributes, setText, svg } from "../../ui/dom";
import { type Axes, digitsOf, extentOf, ticksOf, xOf, yOf } from "../axes";
import { Choice } from "../controls";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { Latest } from "../latest";
import { PlotFrame } from "../plot_frame";
import { figure } from "../words/words";
import sheet from "./pace.css?inline";
import { kernelAt, measurePace } from "./pace_measure";
import { BLENDED, type Blended, lookOf, PACE_FIELDS, type PaceState } from "./pace_state";

/** Radius of a neighbour with g 0 and with g 1, units. */
const RADIUS = { least: 1.5, most: 6 };
/** Number of segments of the kernel's curve. */
const PIECES = 48;
/** Rows of the table. */
const TABLE_ROWS = 12;
const MS = 1000;

export const VOTES: FigureKind<PaceState> = {
  fields: PACE_FIELDS,
  sheet,
  create: (parts) => new VotesFigure(parts),
};

class VotesFigure implements FigureInstance<PaceState> {
  readonly #parts: FigureParts<PaceState>;
  readonly #frame: PlotFrame;
  readonly #style: Choice<Blended>;
  readonly #kernel = svg("path", { class: "kernel", "data-term": "g" });
  readonly #width = svg("path", { class: "guide", "data-term": "h" });
  readonly #labels = {
    h: svg("text", { class: "label votes", "data-term": "h" }, "h"),
    g: svg("text", { class: "label votes", "data-term": "g" }, "g"),
  };
  readonly #dots = svg("g", { class: "dots", "data-term": "g" });
  readonly #mean = svg("path", { class: "fit", "data-term": "w" });
  readonly #readout = html("p", { class: "readout" });
  readonly #timing = new Latest<PaceState>((state) => this.#time(state));
  #state: PaceState | undefined;
  #timed: { style: Blended; timing: Timing } | undefined;
  /** The style whose neighbours are shown. */
  #chosen: Blended = BLENDED[0];

  constructor(parts: FigureParts<PaceState>) {
    this.#parts = parts;
    const { words, container, signal } = parts;
    this.#frame = new PlotFrame(words.pace.votes, () => this.#drawNow(), signal);
    this.#style = new Choice(
      words.style,
      BLENDED.map((style) => [style, words.styles[style]] as const),
      (style) => {
        this.#chosen = style;
        if (this.#state) void this.#timing.take(this.#state);
      },
    );
    this.#style.value = this.#chosen;
    const { h, g } = this.#labels;
    this.#frame.picture.append(this.#kernel, this.#width, this.#dots, this.#mean, h, g);
    this.#frame.listenToMarks(parts.point);
    container.append(
      html("header", { class: "head" }, html("h3", {}, words.pace.votes), this.#style.element),
      this.#frame.element,
      html("footer", { class: "foot" }, this.#readout),
    );
  }

  show(state: PaceState): Promise<void> {
    this.#state = state;
    return this.#timing.take(state);
  }

  async measure(): Promise<Measure> {
    return this.#state ? measurePace(this.#parts.engine, this.#state) : {};
  }

  sentence(): string {
    if (!this.#timed) return "";
    const { words } = this.#parts;
    const { style, timing } = this.#timed;
    const [ms, bandwidth] = this.#read(timing);
    return words.pace.voted(words.styles[style], String(timing.durations.length), ms, bandwidth);
  }

  table(): Table {
    const { words } = this.#parts;
    const timing = this.#timed?.timing;
    const rows = Array.from({ length: Math.min(TABLE_ROWS, timing?.durations.length ?? 0) }, (_, i) => [
      figure(timing!.distances[i]!, 2, words),
      figure(MS * timing!.durations[i]!, 1, words),
      figure(kernelAt(timing!.distances[i]!, timing!.bandwidth), 2, words),
    ]);
    return { head: words.pace.voices, rows };
  }

  values(): Readonly<Record<string, string>> {
    if (!this.#timed) return {};
    const { distances, bandwidth } = this.#timed.timing;
    const { words } = this.#parts;
    const sum = distances.reduce((total, d) => total + kernelAt(d, bandwidth), 0);
    return { g: `Σ ${figure(sum, 1, words)}`, h: `${figure(bandwidth, 1, words)} σ` };
  }

  light(term: string | undefined): void {
    this.#frame.light(term);
  }

  #read({ duration, bandwidth }: Timing): [ms: string, bandwidth: string] {
    const { words } = this.#parts;
    return [figure(MS * (duration ?? Number.NaN), 1, words), figure(bandwidth, 2, words)];
  }

  async #time(state: PaceState): Promise<void> {
    const style = this.#chosen;
    const { engine, signal } = this.#parts;
    // A style without weight has no output: its neighbours are requested with a nonzero weight.
    const styles = { ...lookOf(state).styles, [style]: state[style] || 1 };
    const timing = await engine.timing({ ...lookOf(state), styles }, style);
    if (signal.aborted) return;
    this.#timed = { style, timing };
    this.#parts.changed();
    this.#frame.request();
  }

  #drawNow(): void {
    if (!this.#timed) return;
    const { words } = this.#parts;
    const { timing } = this.#timed;
    const durations = Array.from(timing.durations, (secs) => MS * secs);
    const farthest = timing.distances.reduce((a, b) => Math.max(a, b), timing.bandwidth);
    const axes: Axes = {
      width: this.#frame.width,
      height: this.#frame.height,
      x: [0, extentOf([0, farthest], 1)[1]],
      y: extentOf(durations, 2),
    };
    const ticks = ticksOf(axes.x, 6);
    const columns = ticks.map((value) => [value, figure(value, digitsOf(ticks), words)] as const);
    const labels = { x: words.pace.distance, y: words.pace.duration, columns, rows: ticksOf(axes.y, 4) };
    this.#frame.drawGrid(axes, labels, words);
    keepCount(this.#dots, durations.length, () => svg("circle", {}));
    durations.forEach((ms, i) => {
      setAttributes(this.#dots.children[i]!, {
        cx: xOf(axes, timing.distances[i]!).toFixed(1),
        cy: yOf(axes, ms).toFixed(1),
        r: (RADIUS.least + (RADIUS.most - RADIUS.least) * kernelAt(timing.distances[i]!, timing.bandwidth)).toFixed(1),
      });
    });
    this.#drawKernel(axes, timing);
    const mean = yOf(axes, MS * (timing.duration ?? Number.NaN));
    setAttributes(this.#mean, { d: Number.isFinite(mean) ? `M${xOf(axes, 0)} ${mean}H${xOf(axes, axes.x[1])}` : "" });
    setText(this.#readout, words.pace.mean(...this.#read(timing)));
  }

  /** g over d, from the lower to the upper edge of the picture. */
  #drawKernel(axes: Axes, { bandwidth }: Timing): void {
    const [bottom, top] = axes.y;
    const points = Array.from({ length: PIECES + 1 }, (_, i) => {
      const d = (axes.x[1] * i) / PIECES;
      return `${xOf(axes, d).toFixed(1)} ${yOf(axes, bottom + kernelAt(d, bandwidth) * (top - bottom)).toFixed(1)}`;
    });
    setAttributes(this.#kernel, { d: `M${points.join("L")}` });
    const [x, foot] = [xOf(axes, bandwidth), yOf(axes, bottom)];
    setAttributes(this.#width, { d: `M${x} ${foot}V${yOf(axes, top)}` });
    setAttributes(this.#labels.h, { x: x + 5, y: foot - 6 });
    const near = axes.x[1] / PIECES;
    const below = yOf(axes, bottom + kernelAt(near, bandwidth) * (top - bottom)) + 16;
    setAttributes(this.#labels.g, { x: xOf(axes, near), y: below });
  }
}
