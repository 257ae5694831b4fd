/** The recorded pose of the last update's sample, and the network's current prediction of it. */
import type { SamplePoses } from "../../client/learn/protocol";
import { html, setText } from "../../ui/dom";
import { FigureStage } from "../figure_stage";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { Latest } from "../latest";
import { figure } from "../words/words";
import { measureMap, samplesOf } from "./map_measure";
import { MAP_FIELDS, type MapState } from "./map_state";

export const UPDATE: FigureKind<MapState> = {
  fields: MAP_FIELDS,
  create: (parts) => new UpdateFigure(parts),
};

class UpdateFigure implements FigureInstance<MapState> {
  readonly #parts: FigureParts<MapState>;
  readonly stage: FigureStage;
  readonly #readout = html("p", { class: "readout" });
  readonly #posing = new Latest<MapState>((state) => this.#pose(state));
  #state: MapState | undefined;
  /** `undefined` before the first update. */
  #poses: SamplePoses | undefined;
  #isReady = false;

  constructor(parts: FigureParts<MapState>) {
    this.#parts = parts;
    const { words, container } = parts;
    this.stage = new FigureStage(words, { labels: this.#labels(), description: words.map.update });
    container.append(
      html("header", { class: "head" }, html("h3", {}, words.map.update)),
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
    const { map } = this.#parts.words;
    if (!this.#isReady) return "";
    return this.#poses ? map.predictedOff(this.#degrees) : map.noUpdate;
  }

  table(): Table {
    const { variables, predicted } = this.#parts.words.map;
    return { head: [variables[0], "°"], rows: this.#poses ? [[predicted, this.#degrees]] : [] };
  }

  values(): Readonly<Record<string, string>> {
    return { Z: this.#poses ? `${this.#degrees}°` : "–" };
  }

  light(term: string | undefined): void {
    const { viewer } = this.stage;
    if (!viewer) return;
    // Its name highlights either body.
    viewer.labels = this.#labels(term);
    this.stage.invalidate();
  }

  #labels(term?: string): { styled: string; input: string } {
    if (!this.#poses) return { styled: "", input: "" };
    const { sampled, predicted } = this.#parts.words.map;
    return { styled: term === "Z" ? "" : sampled, input: term === "x" ? "" : predicted };
  }

  get #degrees(): string {
    const { apart } = this.#poses!;
    return Number.isFinite(apart) ? figure(apart, 2, this.#parts.words) : "∞";
  }

  async #pose({ updates, printed }: MapState): Promise<void> {
    const { engine, signal } = this.#parts;
    const [{ proportions }, poses] = await Promise.all([samplesOf(engine), engine.somnPoses(updates, printed)]);
    if (signal.aborted) return;
    this.#poses = poses;
    const { viewer } = this.stage;
    if (viewer) {
      if (!this.#isReady) viewer.setProportions(proportions);
      if (poses) viewer.setStyled(poses.sample);
      viewer.setInput(poses?.predicted ?? null);
      viewer.labels = this.#labels();
      viewer.description = this.sentence();
      if (!this.#isReady) viewer.resetTrail();
    }
    this.#isReady = true;
    setText(this.#readout, this.sentence());
    this.stage.invalidate();
    this.#parts.changed();
  }
}
