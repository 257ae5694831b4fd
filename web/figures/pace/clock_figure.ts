/** Output time of a blend over input time. */
import { html, setAttributes, setText, svg } from "../../ui/dom";
import { type Axes, curvePath, ticksOf, valueOfX, xOf, yOf } from "../axes";
import { Handle } from "../handle";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { Latest } from "../latest";
import { PlotFrame } from "../plot_frame";
import { figure } from "../words/words";
import sheet from "./pace.css?inline";
import { lengthOf, measurePace, type Paced, pacedOf, ratioOf } from "./pace_measure";
import { PACE_FIELDS, type PaceState } from "./pace_state";

/** Step of an arrow key, frames; with Shift one frame. */
const STEP = 10;
/** Frames between two rows of the table. */
const TABLE_STEP = 60;
/** Minimum range of the output axis, relative to the input's length, so that it does not change with the weights. */
const REACH = 1.6;

export const CLOCK: FigureKind<PaceState> = {
  fields: PACE_FIELDS,
  sheet,
  create: (parts) => new ClockFigure(parts),
};

class ClockFigure implements FigureInstance<PaceState> {
  readonly #parts: FigureParts<PaceState>;
  readonly #frame: PlotFrame;
  readonly #even = svg("path", { class: "even" });
  readonly #curve = svg("path", { class: "clock", "data-term": "w" });
  readonly #guide = svg("path", { class: "guide" });
  readonly #point = svg("circle", { class: "query", r: 5, "data-term": "w" });
  readonly #handle: Handle;
  readonly #readout = html("p", { class: "readout" });
  readonly #pacing = new Latest<PaceState>((state) => this.#pace(state));
  #state: PaceState | undefined;
  #paced: Paced | undefined;
  #axes: Axes | undefined;

  constructor(parts: FigureParts<PaceState>) {
    this.#parts = parts;
    const { words, container, signal, change } = parts;
    this.#frame = new PlotFrame(words.pace.clock, () => this.#drawNow(), signal);
    const { picture } = this.#frame;
    this.#handle = new Handle(
      words.playhead,
      "i",
      picture,
      {
        value: () => this.#paced && this.#state?.at,
        valueOf: (x) => valueOfX(this.#axes!, x) * this.#paced!.input.rateHz,
        stepped: (at, direction, fine) => at + direction * (fine ? 1 : STEP),
        ends: () => [2, (this.#paced?.styled.timeOut.length ?? 3) - 1],
        onInput: (at) => change({ at: Math.round(at) }, false),
        onSettle: () => change({}, true),
      },
      signal,
    );
    picture.append(this.#even, this.#curve, this.#guide, this.#handle.element, this.#point);
    // Hidden until it has a position.
    setAttributes(this.#handle.element, { visibility: "hidden" });
    this.#frame.listenToMarks(parts.point);
    container.append(
      html("header", { class: "head" }, html("h3", {}, words.pace.clock)),
      this.#frame.element,
      html("footer", { class: "foot" }, this.#readout),
    );
  }

  show(state: PaceState): Promise<void> {
    this.#state = state;
    if (this.#paced) this.#draw();
    return this.#pacing.take(state);
  }

  async measure(): Promise<Measure> {
    return this.#state ? measurePace(this.#parts.engine, this.#state) : {};
  }

  sentence(): string {
    const now = this.#now();
    if (!now) return "";
    const { words } = this.#parts;
    const { at, paced } = now;
    const secs = (value: number) => figure(value, 2, words);
    const { input, styled } = paced;
    return words.pace.clocked(
      secs(at / input.rateHz),
      secs(styled.timeOut[at]!),
      secs(lengthOf(paced)),
      figure(ratioOf(paced), 3, words),
    );
  }

  table(): Table {
    const { words } = this.#parts;
    const paced = this.#paced;
    const count = paced ? Math.ceil(paced.styled.timeOut.length / TABLE_STEP) : 0;
    const rows = Array.from({ length: count }, (_, i) => {
      const at = i * TABLE_STEP;
      return [at / paced!.input.rateHz, paced!.styled.timeOut[at]!].map((value) => figure(value, 2, words));
    });
    return { head: words.pace.times, rows };
  }

  values(): Readonly<Record<string, string>> {
    const now = this.#now();
    if (!now) return {};
    const { timeOut } = now.paced.styled;
    return { w: `${figure(1000 * (timeOut[now.at]! - timeOut[now.at - 1]!), 1, this.#parts.words)} ms` };
  }

  light(term: string | undefined): void {
    this.#frame.light(term);
  }

  #now() {
    const [state, paced] = [this.#state, this.#paced];
    return state && paced ? { paced, at: Math.min(state.at, paced.styled.timeOut.length - 1) } : undefined;
  }

  async #pace(state: PaceState): Promise<void> {
    const paced = await pacedOf(this.#parts.engine, state);
    if (this.#parts.signal.aborted) return;
    this.#paced = paced;
    this.#draw();
  }

  #draw(): void {
    this.#parts.changed();
    this.#frame.request();
  }

  #drawNow(): void {
    const now = this.#now();
    if (!now) return;
    const { words } = this.#parts;
    const { paced, at } = now;
    const { input, styled, secs } = paced;
    const axes: Axes = {
      width: this.#frame.width,
      height: this.#frame.height,
      x: [0, secs],
      y: [0, Math.max(REACH * secs, lengthOf(paced))],
    };
    this.#axes = axes;
    const columns = ticksOf(axes.x, 6).map((value) => [value, figure(value, 0, words)] as const);
    const labels = { x: words.pace.input, y: words.pace.output, columns, rows: ticksOf(axes.y, 5) };
    this.#frame.drawGrid(axes, labels, words);
    setAttributes(this.#even, { d: `M${xOf(axes, 0)} ${yOf(axes, 0)}L${xOf(axes, secs)} ${yOf(axes, secs)}` });
    setAttributes(this.#curve, { d: curvePath(axes, styled.timeOut, input.rateHz) });
    const [x, y] = [xOf(axes, at / input.rateHz), yOf(axes, styled.timeOut[at]!)];
    setAttributes(this.#point, { cx: x, cy: y });
    setAttributes(this.#guide, { d: `M${x} ${y}H${xOf(axes, 0)}` });
    setAttributes(this.#handle.element, { visibility: "visible" });
    this.#handle.place({ x, bottom: yOf(axes, 0), value: at, text: `${figure(at / input.rateHz, 2, words)} s` });
    const two = (value: number) => figure(value, 2, words);
    setText(this.#readout, words.pace.read(two(lengthOf(paced)), two(secs), figure(ratioOf(paced), 3, words)));
  }
}
