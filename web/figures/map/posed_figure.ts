/** The pose that the model predicts from the style variables. */
import { html, setText } from "../../ui/dom";
import { FigureStage } from "../figure_stage";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { Latest } from "../latest";
import { figure } from "../words/words";
import { measureMap, samplesOf } from "./map_measure";
import { MAP_FIELDS, type MapState, sharingOf } from "./map_state";

/** Components with smaller weights are not listed. */
const LEAST = 0.005;

export const POSED: FigureKind<MapState> = {
  fields: MAP_FIELDS,
  create: (parts) => new PosedFigure(parts),
};

class PosedFigure implements FigureInstance<MapState> {
  readonly #parts: FigureParts<MapState>;
  readonly stage: FigureStage;
  readonly #readout = html("p", { class: "readout" });
  readonly #posing = new Latest<MapState>((state) => this.#pose(state));
  #state: MapState | undefined;
  #weights: Float32Array | undefined;

  constructor(parts: FigureParts<MapState>) {
    this.#parts = parts;
    const { words, container } = parts;
    this.stage = new FigureStage(words, {
      labels: { styled: words.map.pose, input: "" },
      description: words.map.posed,
    });
    container.append(
      html("header", { class: "head" }, html("h3", {}, words.map.posed)),
      this.stage.element,
      html("footer", { class: "foot" }, this.#readout),
    );
  }

  show(state: MapState): Promise<void> {
    this.#state = state;
    return this.#posing.take(state);
  }

  async measure(): Promise<Measure> {
    return this.#state ? measureMap(this.#parts.engine, this.#state) : {};
  }

  sentence(): string {
    const state = this.#state;
    if (!state || !this.#weights) return "";
    const { words } = this.#parts;
    return words.map.asked(figure(state.separation, 0, words), figure(state.height, 0, words));
  }

  table(): Table {
    const { words } = this.#parts;
    const [component, , share] = words.map.components;
    const rows = Array.from(this.#weights ?? [])
      .map((weight, i) => [String(i + 1), weight] as const)
      .filter(([, weight]) => weight > LEAST)
      .map(([name, weight]) => [name, figure(weight, 2, words)]);
    return { head: [component, share], rows };
  }

  values(): Readonly<Record<string, string>> {
    const weights = this.#weights;
    if (!weights) return {};
    return {
      w: figure(
        weights.reduce((a, b) => Math.max(a, b), 0),
        2,
        this.#parts.words,
      ),
    };
  }

  light(): void {}

  async #pose(state: MapState): Promise<void> {
    const { engine, signal } = this.#parts;
    const [samples, { pose, weights }] = await Promise.all([
      samplesOf(engine),
      engine.stylePose([state.separation, state.height], sharingOf(state)),
    ]);
    if (signal.aborted) return;
    const isFirst = !this.#weights;
    this.#weights = weights;
    const { viewer } = this.stage;
    if (viewer) {
      if (isFirst) viewer.setProportions(samples.proportions);
      viewer.setStyled(pose);
      viewer.description = this.sentence();
      if (isFirst) viewer.resetTrail();
    }
    setText(this.#readout, this.sentence());
    this.stage.invalidate();
    this.#parts.changed();
  }
}
