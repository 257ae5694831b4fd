/** The weights of actions over the time of an input, stacked to 1, with a playhead. */
import { html, setAttributes, setText, svg } from "../../ui/dom";
import type { Axes } from "../axes";
import type { FigureKind, FigureParts } from "../kind";
import { PlotFigure } from "../plot_figure";
import { runsOf } from "../runs";
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
  measure: measureMix,
  sheet,
  create: (parts) => new ReadingFigure(parts),
};

interface Shown {
  delta: number;
  motion: string;
  reading: Reading;
}

class ReadingFigure extends PlotFigure<MixState, Shown> {
  readonly #areas = svg("g", { class: "areas", "data-term": "lambda" });
  readonly #names = svg("g", { class: "names" });
  readonly #handle = this.playhead("at", {
    term: "t",
    step: STEP,
    rate: () => this.shown!.reading.rateHz,
    ends: () => [2, (this.shown?.reading.frames ?? 3) - 1],
  });
  readonly #key = html("p", { class: "key" });
  /** The data of the drawn areas: moving the playhead does not draw them again. */
  #areasOf: { reading: Reading; width: number; height: number } | undefined;
  protected override readonly drawsAhead = true;

  constructor(parts: FigureParts<MixState>) {
    const { mix } = parts.words;
    super(parts, mix.reading);
    const { picture, element } = this.frame;
    picture.append(this.#areas, this.#names, this.#handle.element);
    // Hidden until it has a position.
    setAttributes(this.#handle.element, { visibility: "hidden" });
    this.lay({
      title: mix.reading,
      picture: element,
      head: [this.#key],
      controls: this.knobs(["delta"], { delta: mix.delta }, { delta: DELTA }, { delta: "delta" }),
    });
  }

  protected async load({ motion, delta }: MixState): Promise<Shown> {
    if (this.shown?.motion === motion && this.shown.delta === delta) return this.shown;
    return { motion, delta, reading: await readingOf(this.parts.engine, motion, delta) };
  }

  protected describe({ reading }: Shown, state: MixState): string {
    const { actions, weights, rateHz, frames } = reading;
    const at = Math.min(state.at, frames - 1);
    const shares = actions.map((action, i) => [this.#nameOf(action), weights[i]![at]!] as const);
    const most = shares.filter(([, weight]) => weight >= 0.005).sort(([, a], [, b]) => b - a);
    const said = most.map(([action, weight]) => `${action} ${this.number(weight, 2)}`).join(", ");
    return this.words.mix.readAs(this.number(at / rateHz, 2), said);
  }

  protected get columns() {
    const actions = this.shown?.reading.actions ?? [];
    return [this.words.time, ...actions.map((action) => this.#nameOf(action))];
  }

  protected rows({ reading: { frames, rateHz, weights } }: Shown): string[][] {
    return Array.from({ length: Math.ceil(frames / TABLE_STEP) }, (_, i) => {
      const frame = i * TABLE_STEP;
      return [this.number(frame / rateHz, 1), ...weights.map((of) => this.number(of[frame]!, 2))];
    });
  }

  protected override quantities({ reading }: Shown, { at, delta }: MixState) {
    const frame = Math.min(at, reading.frames - 1);
    return { t: `${this.number(frame / reading.rateHz, 2)} s`, delta: this.number(delta, 2) };
  }

  #nameOf(action: string): string {
    return this.words.mix.actions[action] ?? action;
  }

  protected draw({ reading }: Shown, state: MixState): void {
    const { frames, rateHz, actions } = reading;
    const labels = { x: this.words.time, y: this.words.mix.weight, columns: 7, digits: 0, rows: 2 };
    const axes = this.plot({ min: 0, max: (frames - 1) / rateHz }, { min: 0, max: 1 }, labels);
    const { width, height } = axes;
    const drawn = this.#areasOf;
    if (drawn?.reading !== reading || drawn.width !== width || drawn.height !== height) {
      const entry = (action: string) => html("span", {}, html("i", { "data-action": action }), this.#nameOf(action));
      this.#key.replaceChildren(...actions.map(entry));
      this.#drawAreas(axes, reading);
      this.#areasOf = { reading, width, height };
    }
    const at = Math.min(state.at, frames - 1);
    const place = { x: axes.x(at / rateHz), bottom: axes.y(0), value: at, text: this.sentence() };
    setAttributes(this.#handle.element, { visibility: "visible" });
    this.#handle.place(place);
    setText(this.readout, this.sentence());
  }

  #drawAreas(axes: Axes, { actions, weights, frames, rateHz }: Reading): void {
    const below = new Float32Array(frames);
    const areas: SVGPathElement[] = [];
    const names: SVGTextElement[] = [];
    for (const [i, action] of actions.entries()) {
      const lower = Array.from(below, (y, frame) => axes.at(frame / rateHz, y));
      weights[i]!.forEach((weight, frame) => {
        below[frame]! += weight;
      });
      const upper = Array.from(below, (y, frame) => axes.at(frame / rateHz, y));
      areas.push(
        svg("path", { class: "area", "data-action": action, d: `M${upper.join("L")}L${lower.reverse().join("L")}Z` }),
      );
      for (const [from, to] of runsOf(0, frames, (frame) => weights[i]![frame]! >= NAMED)) {
        const middle = Math.round((from + to) / 2);
        const name = this.#nameOf(action);
        const y = axes.y(below[middle]! - weights[i]![middle]! / 2) + 4;
        const width = axes.x(to / rateHz) - axes.x(from / rateHz);
        if (width > 7 * name.length)
          names.push(svg("text", { class: "label", x: axes.x(middle / rateHz), y, "text-anchor": "middle" }, name));
      }
    }
    this.#areas.replaceChildren(...areas);
    this.#names.replaceChildren(...names);
    setAttributes(this.#areas, { "aria-hidden": "true" });
  }
}
