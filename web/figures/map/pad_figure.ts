/** The plane of style variables, in which the character is dragged. */
import type { Dragged, StyleSamples } from "../../client/learn/protocol";
import type { Knob } from "../../ui/controls/knob";
import { html, setAttributes, setText } from "../../ui/dom";
import type { Axes } from "../axes";
import { createKnobs } from "../controls";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { Latest } from "../latest";
import { PlaneHandles } from "../plane_handles";
import { PlotFrame } from "../plot_frame";
import { figure } from "../words/words";
import sheet from "./map.css?inline";
import { draggedOf, measureMap, samplesOf } from "./map_measure";
import { MAP_FIELDS, type MapState, sharingOf, TEMPERATURE } from "./map_state";
import { SamplePlane, ShareBars } from "./plane";

/** Step of an arrow key, centimetres; with Shift the fine one. */
const STEP = { coarse: 2, fine: 0.5 };

export const PAD: FigureKind<MapState> = {
  fields: MAP_FIELDS,
  sheet,
  create: (parts) => new PadFigure(parts),
};

class PadFigure implements FigureInstance<MapState> {
  readonly #parts: FigureParts<MapState>;
  readonly #frame: PlotFrame;
  readonly #temperature: Knob;
  readonly #plane = new SamplePlane();
  readonly #bars = new ShareBars("w");
  readonly #handles: PlaneHandles;
  readonly #readout = html("p", { class: "readout" });
  readonly #dragging = new Latest<MapState>((state) => this.#drag(state));
  #state: MapState | undefined;
  #shown: { samples: StyleSamples; dragged: Dragged; weights: Float32Array } | undefined;
  #axes: Axes | undefined;

  constructor(parts: FigureParts<MapState>) {
    this.#parts = parts;
    const { words, container, signal, change } = parts;
    this.#frame = new PlotFrame(words.map.pad, () => this.#drawNow(), signal);
    const settle = () => change({}, true);
    const texts = { temperature: words.map.temperature };
    const ranges = { temperature: TEMPERATURE };
    this.#temperature = createKnobs(["temperature"], words, texts, ranges, MAP_FIELDS, change).temperature;
    const round = (value: number) => Number(value.toFixed(1));
    this.#handles = new PlaneHandles(
      this.#frame.picture,
      [words.map.handle],
      (fine) => (fine ? STEP.fine : STEP.coarse),
      {
        axes: () => this.#axes,
        onInput: (_, [x, y]) => change({ separation: round(x), height: round(y) }, false),
        onSettle: settle,
      },
      signal,
    );
    for (const handle of this.#handles.elements) setAttributes(handle, { "data-term": "u" });
    this.#frame.picture.append(this.#plane.dots, this.#bars.element, ...this.#handles.elements);
    this.#frame.listenToMarks(parts.point);
    container.append(
      html("header", { class: "head" }, html("h3", {}, words.map.pad)),
      this.#frame.element,
      html("footer", { class: "foot needed" }, this.#readout),
      html("div", { class: "knobs" }, this.#temperature.element),
    );
  }

  show(state: MapState): Promise<void> {
    this.#state = state;
    this.#temperature.value = state.temperature;
    if (this.#shown) this.#frame.request();
    return this.#dragging.take(state);
  }

  async measure(): Promise<Measure> {
    return this.#state ? measureMap(this.#parts.engine, this.#state) : {};
  }

  sentence(): string {
    const state = this.#state;
    if (!state || !this.#shown) return "";
    const { words } = this.#parts;
    return words.map.asked(figure(state.separation, 0, words), figure(state.height, 0, words));
  }

  table(): Table {
    const { words } = this.#parts;
    const { variables, separation, height } = words.map;
    const state = this.#state;
    const rows = state
      ? [
          [separation, figure(state.separation, 1, words)],
          [height, figure(state.height, 1, words)],
        ]
      : [];
    return { head: variables, rows };
  }

  values(): Readonly<Record<string, string>> {
    const state = this.#state;
    if (!state) return {};
    const { words } = this.#parts;
    const most = this.#shown?.weights.reduce((a, b) => Math.max(a, b), 0);
    return {
      u: `${figure(state.separation, 0, words)}, ${figure(state.height, 0, words)} cm`,
      T: figure(state.temperature, 1, words),
      ...(most !== undefined && { w: figure(most, 2, words) }),
    };
  }

  light(term: string | undefined): void {
    this.#frame.light(term);
    this.#temperature.element.classList.toggle("lit", term === "T");
  }

  async #drag(state: MapState): Promise<void> {
    const { engine, signal } = this.#parts;
    const [samples, dragged, { weights }] = await Promise.all([
      samplesOf(engine),
      draggedOf(engine, state.temperature),
      engine.stylePose([state.separation, state.height], sharingOf(state)),
    ]);
    if (signal.aborted) return;
    this.#shown = { samples, dragged, weights };
    this.#parts.changed();
    this.#frame.request();
  }

  #drawNow(): void {
    const [state, shown] = [this.#state, this.#shown];
    if (!state || !shown) return;
    const { words } = this.#parts;
    this.#axes = this.#plane.draw(this.#frame, shown.samples.values, words);
    this.#handles.place(this.#axes, [[state.separation, state.height]], () => this.sentence());
    this.#bars.draw(this.#axes, shown.weights);
    const { change, error } = shown.dragged;
    setText(this.#readout, words.map.dragged(figure(change, 1, words), figure(error, 2, words)));
  }
}
