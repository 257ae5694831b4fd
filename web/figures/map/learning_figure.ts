/** The error of the model after each finished pass. */
import type { StyleSamples } from "../../client/learn/protocol";
import { setAttributes, setText, svg } from "../../ui/dom";
import { roundedExtent } from "../../ui/scale";
import { Handle } from "../handle";
import type { FigureKind, FigureParts } from "../kind";
import { PlotFigure } from "../plot_figure";
import sheet from "./map.css?inline";
import { errorsOf, measureMap, passOf, samplesOf } from "./map_measure";
import { MAP_FIELDS, type MapState } from "./map_state";

export const LEARNING: FigureKind<MapState> = {
  fields: MAP_FIELDS,
  measure: measureMap,
  sheet,
  create: (parts) => new LearningFigure(parts),
};

interface Shown {
  samples: StyleSamples;
  errors: Float32Array;
}

class LearningFigure extends PlotFigure<MapState, Shown> {
  readonly #curve = svg("path", { class: "learned", "data-term": "E" });
  readonly #dots = svg("g", { class: "dots", "data-term": "E" });
  readonly #name = svg("text", { "text-anchor": "end" });
  readonly #handle: Handle;
  protected override readonly drawsAhead = true;

  constructor(parts: FigureParts<MapState>) {
    const { map } = parts.words;
    super(parts, map.learning);
    const { picture, element } = this.frame;
    this.#handle = new Handle(
      map.pass,
      "E",
      picture,
      {
        value: () => (this.axes ? this.#pass : undefined),
        valueOf: (x) => this.axes!.valueAtX(x),
        stepped: (pass, direction) => pass + direction,
        ends: () => [0, this.shown?.errors.length ?? 1],
        onInput: (pass) => this.change({ updates: Math.round(pass) * this.#updatesOfPass, printed: false }, false),
        onSettle: () => this.settle(),
      },
      parts.signal,
    );
    picture.append(this.#name, this.#curve, this.#dots, this.#handle.element);
    this.lay({ title: map.learning, picture: element });
  }

  protected async load(): Promise<Shown> {
    if (this.shown) return this.shown;
    const { engine } = this.parts;
    const [samples, errors] = await Promise.all([samplesOf(engine), errorsOf(engine)]);
    return { samples, errors };
  }

  protected describe({ errors }: Shown): string {
    const error = errors[this.#pass - 1];
    const { map } = this.words;
    return error === undefined ? map.unlearned : map.fallen(String(this.#pass), this.number(error, 3));
  }

  protected get columns() {
    return this.words.map.passes;
  }

  protected rows({ errors }: Shown): string[][] {
    return Array.from(errors.subarray(0, this.#pass), (error, i) => [String(i + 1), this.number(error, 3)]);
  }

  protected override quantities({ errors }: Shown) {
    const error = errors[this.#pass - 1];
    return { E: error === undefined ? "–" : `${this.number(error, 3)}°` };
  }

  get #updatesOfPass(): number {
    return (this.shown?.samples.values.length ?? 2) / 2;
  }

  get #pass(): number {
    return passOf(this.state?.updates ?? 0, this.#updatesOfPass);
  }

  protected draw({ errors }: Shown): void {
    const { map } = this.words;
    const labels = { x: map.pass, y: "", columns: 10, digits: 0, rows: 4 };
    const axes = this.plot({ min: 0, max: errors.length }, roundedExtent(errors, 0.4), labels);
    // At the left it would be under the flag before the first pass.
    setAttributes(this.#name, { x: axes.right - 6, y: axes.top + 16 });
    setText(this.#name, this.words.map.error);
    const pass = this.#pass;
    const points = Array.from(errors.subarray(0, pass), (error, i) => [axes.x(i + 1), axes.y(error)] as const);
    setAttributes(this.#curve, { d: points.length > 0 ? `M${points.map(([x, y]) => `${x} ${y}`).join("L")}` : "" });
    this.#dots.replaceChildren(...points.map(([cx, cy]) => svg("circle", { cx, cy, r: 3 })));
    this.#handle.place({ x: axes.x(pass), bottom: axes.bottom, value: pass, text: this.sentence() });
    const error = errors[pass - 1];
    setText(
      this.readout,
      error === undefined ? this.words.map.unlearned : this.words.map.learned(String(pass), this.number(error, 3)),
    );
  }
}
