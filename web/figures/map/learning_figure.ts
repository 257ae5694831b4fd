/** The error of the model after each finished pass. */
import type { StyleSamples } from "../../client/learn/protocol";
import { html, setAttributes, setText, svg } from "../../ui/dom";
import { type Axes, extentOf, ticksOf, valueOfX, xOf, yOf } from "../axes";
import { Handle } from "../handle";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { Latest } from "../latest";
import { PlotFrame } from "../plot_frame";
import { figure } from "../words/words";
import sheet from "./map.css?inline";
import { errorsOf, measureMap, passOf, samplesOf } from "./map_measure";
import { MAP_FIELDS, type MapState } from "./map_state";

export const LEARNING: FigureKind<MapState> = {
  fields: MAP_FIELDS,
  sheet,
  create: (parts) => new LearningFigure(parts),
};

class LearningFigure implements FigureInstance<MapState> {
  readonly #parts: FigureParts<MapState>;
  readonly #frame: PlotFrame;
  readonly #curve = svg("path", { class: "learned", "data-term": "E" });
  readonly #dots = svg("g", { class: "dots", "data-term": "E" });
  readonly #name = svg("text", { "text-anchor": "end" });
  readonly #handle: Handle;
  readonly #readout = html("p", { class: "readout" });
  readonly #asking = new Latest<MapState>(() => this.#ask());
  #state: MapState | undefined;
  #shown: { samples: StyleSamples; errors: Float32Array } | undefined;
  #axes: Axes | undefined;

  constructor(parts: FigureParts<MapState>) {
    this.#parts = parts;
    const { words, container, signal, change } = parts;
    this.#frame = new PlotFrame(words.map.learning, () => this.#drawNow(), signal);
    const { picture } = this.#frame;
    this.#handle = new Handle(
      words.map.pass,
      "E",
      picture,
      {
        value: () => (this.#axes ? this.#pass : undefined),
        valueOf: (x) => valueOfX(this.#axes!, x),
        stepped: (pass, direction) => pass + direction,
        ends: () => [0, this.#shown?.errors.length ?? 1],
        onInput: (pass) => change({ updates: Math.round(pass) * this.#updatesOfPass, printed: false }, false),
        onSettle: () => change({}, true),
      },
      signal,
    );
    picture.append(this.#name, this.#curve, this.#dots, this.#handle.element);
    this.#frame.listenToMarks(parts.point);
    container.append(
      html("header", { class: "head" }, html("h3", {}, words.map.learning)),
      this.#frame.element,
      html("footer", { class: "foot" }, this.#readout),
    );
  }

  show(state: MapState): Promise<void> {
    this.#state = state;
    if (this.#shown) this.#draw();
    return this.#asking.take(state);
  }

  async measure(): Promise<Measure> {
    return this.#state ? measureMap(this.#parts.engine, this.#state) : {};
  }

  sentence(): string {
    const { words } = this.#parts;
    const error = this.#shown?.errors[this.#pass - 1];
    if (!this.#shown) return "";
    if (error === undefined) return words.map.unlearned;
    return words.map.fallen(String(this.#pass), figure(error, 3, words));
  }

  table(): Table {
    const { words } = this.#parts;
    const errors = this.#shown?.errors.subarray(0, this.#pass) ?? [];
    const rows = Array.from(errors, (error, i) => [String(i + 1), figure(error, 3, words)]);
    return { head: words.map.passes, rows };
  }

  values(): Readonly<Record<string, string>> {
    const error = this.#shown?.errors[this.#pass - 1];
    return { E: error === undefined ? "–" : `${figure(error, 3, this.#parts.words)}°` };
  }

  light(term: string | undefined): void {
    this.#frame.light(term);
  }

  get #updatesOfPass(): number {
    return (this.#shown?.samples.values.length ?? 2) / 2;
  }

  get #pass(): number {
    return passOf(this.#state?.updates ?? 0, this.#updatesOfPass);
  }

  async #ask(): Promise<void> {
    if (this.#shown) return;
    const { engine, signal } = this.#parts;
    const [samples, errors] = await Promise.all([samplesOf(engine), errorsOf(engine)]);
    if (signal.aborted) return;
    this.#shown = { samples, errors };
    this.#draw();
  }

  #draw(): void {
    this.#parts.changed();
    this.#frame.request();
  }

  #drawNow(): void {
    if (!this.#shown) return;
    const { words } = this.#parts;
    const { errors } = this.#shown;
    const axes: Axes = {
      width: this.#frame.width,
      height: this.#frame.height,
      x: [0, errors.length],
      y: extentOf(errors, 0.4),
    };
    this.#axes = axes;
    const columns = ticksOf(axes.x, 10).map((value) => [value, figure(value, 0, words)] as const);
    const labels = { x: words.map.pass, y: "", columns, rows: ticksOf(axes.y, 4) };
    this.#frame.drawGrid(axes, labels, words);
    // At the left it would be under the flag before the first pass.
    setAttributes(this.#name, { x: xOf(axes, axes.x[1]) - 6, y: yOf(axes, axes.y[1]) + 16 });
    setText(this.#name, words.map.error);
    const pass = this.#pass;
    const points = Array.from(errors.subarray(0, pass), (error, i) => [xOf(axes, i + 1), yOf(axes, error)] as const);
    setAttributes(this.#curve, { d: points.length > 0 ? `M${points.map(([x, y]) => `${x} ${y}`).join("L")}` : "" });
    this.#dots.replaceChildren(...points.map(([cx, cy]) => svg("circle", { cx, cy, r: 3 })));
    this.#handle.place({ x: xOf(axes, pass), bottom: yOf(axes, axes.y[0]), value: pass, text: this.sentence() });
    const error = errors[pass - 1];
    setText(
      this.#readout,
      error === undefined ? words.map.unlearned : words.map.learned(String(pass), figure(error, 3, words)),
    );
  }
}
