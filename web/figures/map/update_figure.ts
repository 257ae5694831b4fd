/** The recorded pose of the last update's sample, and the network's current prediction of it. */
import type { SamplePoses } from "../../client/learn/protocol";
import type { Viewer } from "../../viewer";
import type { FigureKind, FigureParts } from "../kind";
import { SceneFigure } from "../scene_figure";
import { measureMap, samplesOf } from "./map_measure";
import { MAP_FIELDS, type MapState } from "./map_state";

export const UPDATE: FigureKind<MapState> = {
  fields: MAP_FIELDS,
  measure: measureMap,
  create: (parts) => new UpdateFigure(parts),
};

interface Shown {
  proportions: Float32Array;
  /** `undefined` before the first update. */
  poses: SamplePoses | undefined;
}

class UpdateFigure extends SceneFigure<MapState, Shown> {
  constructor(parts: FigureParts<MapState>) {
    const { update } = parts.words.map;
    super(parts, { labels: { styled: "", input: "" }, description: update });
    this.lay({ title: update, picture: this.stage.element });
  }

  override light(term: string | undefined): void {
    const { viewer } = this.stage;
    if (!viewer) return;
    // Its name highlights either body.
    viewer.labels = this.#labels(term);
    this.stage.invalidate();
  }

  protected async load({ updates, printed }: MapState): Promise<Shown> {
    const { engine } = this.parts;
    const [{ proportions }, poses] = await Promise.all([samplesOf(engine), engine.somnPoses(updates, printed)]);
    return { proportions, poses };
  }

  protected pose(viewer: Viewer, { proportions, poses }: Shown, _: MapState, before?: Shown): void {
    if (!before) viewer.setProportions(proportions);
    if (poses) viewer.setStyled(poses.sample);
    viewer.setInput(poses?.predicted ?? null);
    viewer.labels = this.#labels();
    if (!before) viewer.resetTrail();
  }

  protected describe({ poses }: Shown): string {
    const { map } = this.words;
    return poses ? map.predictedOff(this.#degrees(poses)) : map.noUpdate;
  }

  protected get columns() {
    return [this.words.map.variables[0], "°"];
  }

  protected rows({ poses }: Shown): string[][] {
    return poses ? [[this.words.map.predicted, this.#degrees(poses)]] : [];
  }

  override values(): Readonly<Record<string, string>> {
    const poses = this.shown?.poses;
    return { Z: poses ? `${this.#degrees(poses)}°` : "–" };
  }

  #labels(term?: string): { styled: string; input: string } {
    if (!this.shown?.poses) return { styled: "", input: "" };
    const { sampled, predicted } = this.words.map;
    return { styled: term === "Z" ? "" : sampled, input: term === "x" ? "" : predicted };
  }

  #degrees({ apart }: SamplePoses): string {
    return Number.isFinite(apart) ? this.number(apart, 2) : "∞";
  }
}
