/** The weights of actions over the time of an input, stacked to 1, with a playhead. */
import type { Knob } from "../../ui/controls/knob";
import { html, setAttributes, setText, svg } from "../../ui/dom";
import { type Axes, ticksOf, valueOfX, xOf, yOf } from "../axes";
import { createKnobs } from "../controls";
import { Handle } from "../handle";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { Latest } from "../latest";
import { PlotFrame } from "../plot_frame";
import { figure } from "../words/words";
import sheet from "./mix.css?inline";
import { measureMix, type Reading, readingOf } from "./mix_measure";
import { DELTA, MIX_FIELDS, type MixState } from "./mix_state";

/** Step of an arrow key, frames; with Shift one frame. */
const STEP = 10;
/** Frames between two rows of the table. */
const TABLE_STEP = 30;
/** Minimum weight for the label of an action. */
const NAMED = 0.6;

export const READING: FigureKind<MixState> = {
  fields: MIX_FIELDS,
  sheet,
  create: (parts) => new ReadingFigure(parts),
};

class ReadingFigure implements FigureInstance<MixState> {
  readonly #parts: FigureParts<MixState>;
  readonly #frame: PlotFrame;
  readonly #areas = svg("g", { class: "areas", "data-term": "lambda" });
  readonly #names = svg("g", { class: "names" });
  readonly #handle: Handle;
  readonly #knob: Knob;
  readonly #readout = html("p", { class: "readout" });
  readonly #key = html("p", { class: "key" });
  readonly #reading = new Latest<MixState>((state) => this.#read(state));
  #state: MixState | undefined;
  #shown: { delta: number; motion: string; reading: Reading } | undefined;
  #axes: Axes | undefined;
  /** The data of the drawn areas: moving the playhead does not draw them again. */
  #areasOf: { reading: Reading; width: number; height: number } | undefined;

  constructor(parts: FigureParts<MixState>) {
    this.#parts = parts;
    const { words, container, signal, change } = parts;
    this.#frame = new PlotFrame(words.mix.reading, () => this.#drawNow(), signal);
    const { picture } = this.#frame;
    this.#handle = new Handle(
      words.playhead,
      "t",
      picture,
      {
        value: () => this.#axes && this.#state?.at,
        valueOf: (x) => valueOfX(this.#axes!, x) * this.#shown!.reading.rateHz,
        stepped: (at, direction, fine) => at + direction * (fine ? 1 : STEP),
        ends: () => [2, (this.#shown?.reading.frames ?? 3) - 1],
        onInput: (at) => change({ at: Math.round(at) }, false),
        onSettle: () => change({}, true),
      },
      signal,
    );
    const texts = { delta: words.mix.delta };
    this.#knob = createKnobs(["delta"], words, texts, { delta: DELTA }, MIX_FIELDS, change).delta;
    picture.append(this.#areas, this.#names, this.#handle.element);
    // Hidden until it has a position.
    setAttributes(this.#handle.element, { visibility: "hidden" });
    this.#frame.listenToMarks(parts.point);
    container.append(
      html("header", { class: "head" }, html("h3", {}, words.mix.reading), this.#key),
      this.#frame.element,
      html("footer", { class: "foot" }, this.#readout),
      html("div", { class: "knobs" }, this.#knob.element),
    );
  }

  show(state: MixState): Promise<void> {
    this.#state = state;
    this.#knob.value = state.delta;
    this.#draw();
    return this.#reading.take(state);
  }

  async measure(): Promise<Measure> {
    return this.#state ? measureMix(this.#parts.engine, this.#state) : {};
  }

  sentence(): string {
    const [state, read] = [this.#state, this.#shown];
    if (!state || !read) return "";
    const { words } = this.#parts;
    const { actions, weights, rateHz } = read.reading;
    const at = this.#at();
    const shares = actions.map((action, i) => [words.mix.actions[action] ?? action, weights[i]![at]!] as const);
    const most = shares.filter(([, weight]) => weight >= 0.005).sort(([, a], [, b]) => b - a);
    const said = most.map(([action, weight]) => `${action} ${figure(weight, 2, words)}`).join(", ");
    return words.mix.readAs(figure(at / rateHz, 2, words), said);
  }

  table(): Table {
    const { words } = this.#parts;
    const reading = this.#shown?.reading;
    const rows: string[][] = [];
    for (let frame = 0; reading && frame < reading.frames; frame += TABLE_STEP)
      rows.push([
        figure(frame / reading.rateHz, 1, words),
        ...reading.weights.map((weights) => figure(weights[frame]!, 2, words)),
      ]);
    return {
      head: [words.time, ...(reading?.actions ?? []).map((action) => words.mix.actions[action] ?? action)],
      rows,
    };
  }

  values(): Readonly<Record<string, string>> {
    const [state, read] = [this.#state, this.#shown];
    if (!state || !read) return {};
    const { words } = this.#parts;
    return { t: `${figure(this.#at() / read.reading.rateHz, 2, words)} s`, delta: figure(state.delta, 2, words) };
  }

  light(term: string | undefined): void {
    this.#frame.light(term);
    this.#knob.element.classList.toggle("lit", term === "delta");
  }

  #at(): number {
    return Math.min(this.#state!.at, this.#shown!.reading.frames - 1);
  }

  async #read(state: MixState): Promise<void> {
    const { motion, delta } = state;
    if (this.#shown?.motion === motion && this.#shown.delta === delta) return;
    const reading = await readingOf(this.#parts.engine, motion, delta);
    if (this.#parts.signal.aborted) return;
    this.#shown = { motion, delta, reading };
    const { actions } = this.#parts.words.mix;
    this.#key.replaceChildren(
      ...reading.actions.map((action) =>
        html("span", {}, html("i", { "data-action": action }), actions[action] ?? action),
      ),
    );
    this.#draw();
  }

  #draw(): void {
    this.#parts.changed();
    this.#frame.request();
  }

  #drawNow(): void {
    const read = this.#shown;
    if (!read || !this.#state) return;
    const { words } = this.#parts;
    const { reading } = read;
    const secs = (reading.frames - 1) / reading.rateHz;
    const axes: Axes = { width: this.#frame.width, height: this.#frame.height, x: [0, secs], y: [0, 1] };
    this.#axes = axes;
    const columns = ticksOf(axes.x, 7).map((value) => [value, figure(value, 0, words)] as const);
    this.#frame.drawGrid(axes, { x: words.time, y: words.mix.weight, columns, rows: [0, 0.5, 1] }, words);
    const { width, height } = axes;
    const drawn = this.#areasOf;
    if (drawn?.reading !== reading || drawn.width !== width || drawn.height !== height) {
      this.#drawAreas(axes, reading);
      this.#areasOf = { reading, width, height };
    }
    const at = this.#at();
    const place = { x: xOf(axes, at / reading.rateHz), bottom: yOf(axes, 0), value: at, text: this.sentence() };
    setAttributes(this.#handle.element, { visibility: "visible" });
    this.#handle.place(place);
    setText(this.#readout, this.sentence());
  }

  #drawAreas(axes: Axes, { actions, weights, frames, rateHz }: Reading): void {
    const { words } = this.#parts;
    const below = new Float32Array(frames);
    const areas: SVGPathElement[] = [];
    const names: SVGTextElement[] = [];
    for (const [i, action] of actions.entries()) {
      const lower = Array.from(
        below,
        (y, frame) => `${xOf(axes, frame / rateHz).toFixed(1)} ${yOf(axes, y).toFixed(1)}`,
      );
      weights[i]!.forEach((weight, frame) => {
        below[frame]! += weight;
      });
      const upper = Array.from(
        below,
        (y, frame) => `${xOf(axes, frame / rateHz).toFixed(1)} ${yOf(axes, y).toFixed(1)}`,
      );
      areas.push(
        svg("path", { class: "area", "data-action": action, d: `M${upper.join("L")}L${lower.reverse().join("L")}Z` }),
      );
      for (const [from, to] of stretches(weights[i]!)) {
        const middle = Math.round((from + to) / 2);
        const name = words.mix.actions[action] ?? action;
        const y = yOf(axes, below[middle]! - weights[i]![middle]! / 2) + 4;
        const width = xOf(axes, to / rateHz) - xOf(axes, from / rateHz);
        if (width > 7 * name.length)
          names.push(svg("text", { class: "label", x: xOf(axes, middle / rateHz), y, "text-anchor": "middle" }, name));
      }
    }
    this.#areas.replaceChildren(...areas);
    this.#names.replaceChildren(...names);
    setAttributes(this.#areas, { "aria-hidden": "true" });
  }
}

/** Ranges with large weights: first and last frames. */
function stretches(weights: Float32Array): [from: number, to: number][] {
  const found: [number, number][] = [];
  let from = -1;
  for (let frame = 0; frame <= weights.length; frame++) {
    const large = frame < weights.length && weights[frame]! >= NAMED;
    if (large && from < 0) from = frame;
    if (!large && from >= 0) {
      found.push([from, frame - 1]);
      from = -1;
    }
  }
  return found;
}
