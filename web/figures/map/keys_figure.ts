/** A cycle of the style variables through keys, and the distance of its poses from the recorded ones. */
import type { Keyed, StyleSamples } from "../../client/learn/protocol";
import { button } from "../../ui/controls/buttons";
import { setAttributes, setText, svg } from "../../ui/dom";
import { roundedExtent } from "../../ui/scale";
import type { FigureKind, FigureParts } from "../kind";
import { meanOf } from "../pairing";
import { PlaneHandles } from "../plane_handles";
import { PlotFigure } from "../plot_figure";
import sheet from "./map.css?inline";
import { keyedOf, measureMap, samplesOf, worstStretch } from "./map_measure";
import { MAP_FIELDS, type MapState, MOST_KEYS } from "./map_state";

/** An error of this size, degrees, has a third of the picture's height. */
const FULL = 10;
/** Frames between two rows of the table. */
const TABLE_STEP = 4;

export const KEYS: FigureKind<MapState> = {
  fields: MAP_FIELDS,
  measure: measureMap,
  sheet,
  create: (parts) => new KeysFigure(parts),
};

interface Shown {
  state: MapState;
  samples: StyleSamples;
  keyed: Keyed;
}

class KeysFigure extends PlotFigure<MapState, Shown> {
  readonly #errors = svg("path", { class: "errors", "data-term": "E" });
  readonly #recorded = svg("path", { class: "recorded" });
  readonly #followed = svg("path", { class: "followed" });
  readonly #handles: PlaneHandles;
  readonly #add: HTMLButtonElement;
  readonly #remove: HTMLButtonElement;

  constructor(parts: FigureParts<MapState>) {
    const { map } = parts.words;
    super(parts, map.keys);
    const { picture, element } = this.frame;
    this.#handles = new PlaneHandles(
      picture,
      Array.from({ length: MOST_KEYS }, (_, i) => map.key(i + 1)),
      () => 1 / (this.shown?.samples.rateHz ?? 1),
      {
        axes: () => this.axes,
        onInput: (which, [secs]) => this.#move(which, secs),
        onSettle: () => this.settle(),
      },
      parts.signal,
    );
    this.#add = button(map.add, () => this.#addKey(), { label: true });
    this.#remove = button(map.remove, () => this.change({ keys: this.state!.keys.slice(0, -1) }), { label: true });
    picture.append(this.#errors, this.#recorded, this.#followed, ...this.#handles.elements);
    this.lay({
      title: map.keys,
      picture: element,
      controls: [this.#add, this.#remove],
      controlsClass: "knobs steps",
    });
  }

  override show(state: MapState): Promise<void> {
    this.#add.disabled = state.keys.length >= MOST_KEYS;
    this.#remove.disabled = state.keys.length <= 1;
    return super.show(state);
  }

  protected async load(state: MapState): Promise<Shown> {
    const { engine } = this.parts;
    const [samples, keyed] = await Promise.all([samplesOf(engine), keyedOf(engine, state.keys)]);
    return { state, samples, keyed };
  }

  protected describe({ state, samples, keyed }: Shown): string {
    const { from, to, error } = worstStretch(keyed.errors, state.keys);
    const secs = (frame: number) => this.number(frame / samples.rateHz, 2);
    const mean = this.number(meanOf(keyed.errors), 2);
    return this.words.map.interpolated(String(state.keys.length), mean, secs(from), secs(to), this.number(error, 2));
  }

  protected get columns() {
    return this.words.map.frames;
  }

  protected rows({ samples, keyed }: Shown): string[][] {
    return Array.from({ length: Math.ceil(keyed.errors.length / TABLE_STEP) }, (_, i) => {
      const frame = i * TABLE_STEP;
      return [
        this.number(frame / samples.rateHz, 2),
        this.number(keyed.values[2 * frame]!, 1),
        this.number(keyed.errors[frame]!, 2),
      ];
    });
  }

  protected override quantities({ keyed }: Shown) {
    return { E: `${this.number(meanOf(keyed.errors), 2)}°` };
  }

  /** Moves a key to a frame, but not past its neighbours. */
  #move(which: number, secs: number): void {
    const [state, shown] = [this.state, this.shown];
    if (!state || !shown || which >= state.keys.length) return;
    const { rateHz, cycle } = shown.samples;
    const [least, most] = [(state.keys[which - 1] ?? -1) + 1, (state.keys[which + 1] ?? cycle.frames) - 1];
    const frame = Math.min(most, Math.max(least, Math.round(secs * rateHz)));
    this.change({ keys: state.keys.map((key, i) => (i === which ? frame : key)) }, false);
  }

  /** Adds a key in the middle of the longest gap. */
  #addKey(): void {
    const [state, shown] = [this.state, this.shown];
    if (!state || !shown || state.keys.length >= MOST_KEYS) return;
    const { frames } = shown.samples.cycle;
    const ends = [...state.keys.slice(1), frames];
    const stretches = state.keys.map((from, i) => [from, ends[i]!] as const);
    const [from, to] = stretches.reduce((a, b) => (b[1] - b[0] > a[1] - a[0] ? b : a));
    const middle = (from + to) >> 1;
    if (middle > from) this.change({ keys: [...state.keys, middle].sort((a, b) => a - b) });
  }

  protected draw({ state, samples, keyed }: Shown): void {
    const { rateHz, cycle, values } = samples;
    const separation = (from: Float32Array, first: number) =>
      Array.from({ length: cycle.frames }, (_, i) => from[2 * (first + i)]!);
    const [recorded, followed] = [separation(values, cycle.first), separation(keyed.values, 0)];
    const { map } = this.words;
    const axes = this.plot(
      { min: 0, max: (cycle.frames - 1) / rateHz },
      roundedExtent([...recorded, ...followed], 10),
      { x: map.time, y: map.separation, columns: 6, digits: 1, rows: 4 },
    );
    setAttributes(this.#recorded, { d: axes.curve(recorded, rateHz) });
    setAttributes(this.#followed, { d: axes.curve(followed, rateHz) });
    const { bottom, top, right } = axes;
    const heights = Array.from(keyed.errors, (error, i) => {
      const height = ((bottom - top) / 3) * Math.min(1, error / FULL);
      return `${axes.x(i / rateHz).toFixed(1)} ${(bottom - height).toFixed(1)}`;
    });
    setAttributes(this.#errors, { d: `M${axes.x(0)} ${bottom}L${heights.join("L")}L${right} ${bottom}Z` });
    const places = state.keys.map((frame) => [frame / rateHz, recorded[frame] ?? recorded.at(-1)!] as const);
    this.#handles.elements.forEach((element, i) => {
      element.classList.toggle("unused", i >= places.length);
    });
    this.#handles.place(axes, places, ([secs]) => `${this.number(secs, 2)} s`);
    setText(this.readout, this.words.map.keyed(String(state.keys.length), this.number(meanOf(keyed.errors), 2)));
  }
}
