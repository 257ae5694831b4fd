/** The pose that the model predicts from the style variables. */
import type { StyleSamples } from "../../client/learn/protocol";
import type { Viewer } from "../../viewer";
import type { FigureKind, FigureParts } from "../kind";
import { SceneFigure } from "../scene_figure";
import { measureMap, samplesOf } from "./map_measure";
import { MAP_FIELDS, type MapState, sharingOf } from "./map_state";

/** Components with smaller weights are not listed. */
const LEAST = 0.005;

export const POSED: FigureKind<MapState> = {
  fields: MAP_FIELDS,
  measure: measureMap,
  create: (parts) => new PosedFigure(parts),
};

interface Shown {
  samples: StyleSamples;
  pose: Float32Array;
  weights: Float32Array;
}

class PosedFigure extends SceneFigure<MapState, Shown> {
  constructor(parts: FigureParts<MapState>) {
    const { pose, posed } = parts.words.map;
    super(parts, { labels: { styled: pose, input: "" }, description: posed });
    this.lay({ title: posed, picture: this.stage.element });
  }

  protected async load(state: MapState): Promise<Shown> {
    const { engine } = this.parts;
    const [samples, { pose, weights }] = await Promise.all([
      samplesOf(engine),
      engine.stylePose([state.separation, state.height], sharingOf(state)),
    ]);
    return { samples, pose, weights };
  }

  protected pose(viewer: Viewer, { samples, pose }: Shown, _: MapState, before?: Shown): void {
    if (!before) viewer.setProportions(samples.proportions);
    viewer.setStyled(pose);
    if (!before) viewer.resetTrail();
  }

  protected describe(_: Shown, { separation, height }: MapState): string {
    return this.words.map.asked(this.number(separation, 0), this.number(height, 0));
  }

  protected get columns() {
    const [component, , share] = this.words.map.components;
    return [component, share];
  }

  protected rows({ weights }: Shown): string[][] {
    return Array.from(weights)
      .map((weight, i) => [String(i + 1), weight] as const)
      .filter(([, weight]) => weight > LEAST)
      .map(([name, weight]) => [name, this.number(weight, 2)]);
  }

  protected override quantities({ weights }: Shown) {
    const most = weights.reduce((a, b) => Math.max(a, b), 0);
    return { w: this.number(most, 2) };
  }
}
