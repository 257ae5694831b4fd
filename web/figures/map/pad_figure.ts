/** The plane of style variables, in which the character is dragged. */
import type { Dragged, StyleSamples } from "../../client/learn/protocol";
import { setAttributes, setText } from "../../ui/dom";
import type { FigureKind, FigureParts } from "../kind";
import { PlaneHandles } from "../plane_handles";
import { PlotFigure } from "../plot_figure";
import sheet from "./map.css?inline";
import { draggedOf, measureMap, samplesOf } from "./map_measure";
import { MAP_FIELDS, type MapState, sharingOf, TEMPERATURE } from "./map_state";
import { SamplePlane, ShareBars } from "./plane";

/** Step of an arrow key, centimetres; with Shift the fine one. */
const STEP = { coarse: 2, fine: 0.5 };

export const PAD: FigureKind<MapState> = {
  fields: MAP_FIELDS,
  measure: measureMap,
  sheet,
  create: (parts) => new PadFigure(parts),
};

interface Shown {
  samples: StyleSamples;
  dragged: Dragged;
  weights: Float32Array;
}

class PadFigure extends PlotFigure<MapState, Shown> {
  readonly #plane = new SamplePlane();
  readonly #bars = new ShareBars("w");
  readonly #handles: PlaneHandles;
  protected override readonly drawsAhead = true;

  constructor(parts: FigureParts<MapState>) {
    const { map } = parts.words;
    super(parts, map.pad);
    const { picture, element } = this.frame;
    const round = (value: number) => Number(value.toFixed(1));
    this.#handles = new PlaneHandles(
      picture,
      [map.handle],
      (fine) => (fine ? STEP.fine : STEP.coarse),
      {
        axes: () => this.axes,
        onInput: (_, [x, y]) => this.change({ separation: round(x), height: round(y) }, false),
        onSettle: () => this.settle(),
      },
      parts.signal,
    );
    for (const handle of this.#handles.elements) setAttributes(handle, { "data-term": "u" });
    picture.append(this.#plane.dots, this.#bars.element, ...this.#handles.elements);
    const [texts, ranges] = [{ temperature: map.temperature }, { temperature: TEMPERATURE }];
    this.lay({
      title: map.pad,
      picture: element,
      footClass: "foot needed",
      controls: this.knobs(["temperature"], texts, ranges, { temperature: "T" }),
    });
  }

  protected async load(state: MapState): Promise<Shown> {
    const { engine } = this.parts;
    const [samples, dragged, { weights }] = await Promise.all([
      samplesOf(engine),
      draggedOf(engine, state.temperature),
      engine.stylePose([state.separation, state.height], sharingOf(state)),
    ]);
    return { samples, dragged, weights };
  }

  protected describe(_: Shown, { separation, height }: MapState): string {
    return this.words.map.asked(this.number(separation, 0), this.number(height, 0));
  }

  protected get columns() {
    return this.words.map.variables;
  }

  protected rows(_: Shown, state: MapState): string[][] {
    const { separation, height } = this.words.map;
    return [
      [separation, this.number(state.separation, 1)],
      [height, this.number(state.height, 1)],
    ];
  }

  protected override quantities({ weights }: Shown, { separation, height, temperature }: MapState) {
    const most = weights.reduce((a, b) => Math.max(a, b), 0);
    return {
      u: `${this.number(separation, 0)}, ${this.number(height, 0)} cm`,
      T: this.number(temperature, 1),
      w: this.number(most, 2),
    };
  }

  protected draw({ samples, dragged, weights }: Shown, state: MapState): void {
    this.axes = this.#plane.draw(this.frame, samples.values, this.words);
    this.#handles.place(this.axes, [[state.separation, state.height]], () => this.sentence());
    this.#bars.draw(this.axes, weights);
    setText(this.readout, this.words.map.dragged(this.number(dragged.change, 1), this.number(dragged.error, 2)));
  }
}
