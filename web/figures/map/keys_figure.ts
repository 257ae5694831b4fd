/** A cycle of the style variables through keys, and the distance of its poses from the recorded ones. */
import type { Keyed, StyleSamples } from "../../client/learn/protocol";
import { button } from "../../ui/controls/buttons";
import { html, setAttributes, setText, svg } from "../../ui/dom";
import { type Axes, curvePath, extentOf, ticksOf, xOf, yOf } from "../axes";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { Latest } from "../latest";
import { meanOf } from "../pairing";
import { PlaneHandles } from "../plane_handles";
import { PlotFrame } from "../plot_frame";
import { figure } from "../words/words";
import sheet from "./map.css?inline";
import { keyedOf, measureMap, samplesOf, worstStretch } from "./map_measure";
import { MAP_FIELDS, type MapState, MOST_KEYS } from "./map_state";

/** An error of this size, degrees, has a third of the picture's height. */
const FULL = 10;
/** Frames between two rows of the table. */
const TABLE_STEP = 4;

export const KEYS: FigureKind<MapState> = {
  fields: MAP_FIELDS,
  sheet,
  create: (parts) => new KeysFigure(parts),
};

class KeysFigure implements FigureInstance<MapState> {
  readonly #parts: FigureParts<MapState>;
  readonly #frame: PlotFrame;
  readonly #errors = svg("path", { class: "errors", "data-term": "E" });
  readonly #recorded = svg("path", { class: "recorded" });
  readonly #followed = svg("path", { class: "followed" });
  readonly #handles: PlaneHandles;
  readonly #add: HTMLButtonElement;
  readonly #remove: HTMLButtonElement;
  readonly #readout = html("p", { class: "readout" });
  readonly #keying = new Latest<MapState>((state) => this.#key(state));
  #state: MapState | undefined;
  #shown: { state: MapState; samples: StyleSamples; keyed: Keyed } | undefined;
  #axes: Axes | undefined;

  constructor(parts: FigureParts<MapState>) {
    this.#parts = parts;
    const { words, container, signal, change } = parts;
    this.#frame = new PlotFrame(words.map.keys, () => this.#drawNow(), signal);
    const { picture } = this.#frame;
    this.#handles = new PlaneHandles(
      picture,
      Array.from({ length: MOST_KEYS }, (_, i) => words.map.key(i + 1)),
      () => 1 / (this.#shown?.samples.rateHz ?? 1),
      {
        axes: () => this.#axes,
        onInput: (which, [secs]) => this.#move(which, secs),
        onSettle: () => change({}, true),
      },
      signal,
    );
    this.#add = button(words.map.add, () => this.#addKey(), { label: true });
    this.#remove = button(words.map.remove, () => change({ keys: this.#state!.keys.slice(0, -1) }, true), {
      label: true,
    });
    picture.append(this.#errors, this.#recorded, this.#followed, ...this.#handles.elements);
    this.#frame.listenToMarks(parts.point);
    container.append(
      html("header", { class: "head" }, html("h3", {}, words.map.keys)),
      this.#frame.element,
      html("footer", { class: "foot" }, this.#readout),
      html("div", { class: "knobs steps" }, this.#add, this.#remove),
    );
  }

  show(state: MapState): Promise<void> {
    this.#state = state;
    this.#add.disabled = state.keys.length >= MOST_KEYS;
    this.#remove.disabled = state.keys.length <= 1;
    return this.#keying.take(state);
  }

  async measure(): Promise<Measure> {
    return this.#state ? measureMap(this.#parts.engine, this.#state) : {};
  }

  sentence(): string {
    if (!this.#shown) return "";
    const { words } = this.#parts;
    const { state, samples, keyed } = this.#shown;
    const worst = worstStretch(keyed.errors, state.keys);
    const secs = (frame: number) => figure(frame / samples.rateHz, 2, words);
    const degrees = (value: number) => figure(value, 2, words);
    const { from, to, error } = worst;
    const count = String(state.keys.length);
    return words.map.interpolated(count, degrees(meanOf(keyed.errors)), secs(from), secs(to), degrees(error));
  }

  table(): Table {
    const { words } = this.#parts;
    const shown = this.#shown;
    const count = shown ? Math.ceil(shown.keyed.errors.length / TABLE_STEP) : 0;
    const rows = Array.from({ length: count }, (_, i) => {
      const frame = i * TABLE_STEP;
      return [
        figure(frame / shown!.samples.rateHz, 2, words),
        figure(shown!.keyed.values[2 * frame]!, 1, words),
        figure(shown!.keyed.errors[frame]!, 2, words),
      ];
    });
    return { head: words.map.frames, rows };
  }

  values(): Readonly<Record<string, string>> {
    if (!this.#shown) return {};
    const { words } = this.#parts;
    return { E: `${figure(meanOf(this.#shown.keyed.errors), 2, words)}°` };
  }

  light(term: string | undefined): void {
    this.#frame.light(term);
  }

  /** Moves a key to a frame, but not past its neighbours. */
  #move(which: number, secs: number): void {
    const [state, shown] = [this.#state, this.#shown];
    if (!state || !shown || which >= state.keys.length) return;
    const { rateHz, cycle } = shown.samples;
    const [least, most] = [(state.keys[which - 1] ?? -1) + 1, (state.keys[which + 1] ?? cycle.frames) - 1];
    const frame = Math.min(most, Math.max(least, Math.round(secs * rateHz)));
    this.#parts.change({ keys: state.keys.map((key, i) => (i === which ? frame : key)) }, false);
  }

  /** Adds a key in the middle of the longest gap. */
  #addKey(): void {
    const [state, shown] = [this.#state, this.#shown];
    if (!state || !shown || state.keys.length >= MOST_KEYS) return;
    const { frames } = shown.samples.cycle;
    const ends = [...state.keys.slice(1), frames];
    const stretches = state.keys.map((from, i) => [from, ends[i]!] as const);
    const [from, to] = stretches.reduce((a, b) => (b[1] - b[0] > a[1] - a[0] ? b : a));
    const middle = (from + to) >> 1;
    if (middle > from) this.#parts.change({ keys: [...state.keys, middle].sort((a, b) => a - b) }, true);
  }

  async #key(state: MapState): Promise<void> {
    const { engine, signal } = this.#parts;
    const [samples, keyed] = await Promise.all([samplesOf(engine), keyedOf(engine, state.keys)]);
    if (signal.aborted) return;
    this.#shown = { state, samples, keyed };
    this.#parts.changed();
    this.#frame.request();
  }

  #drawNow(): void {
    if (!this.#shown) return;
    const { words } = this.#parts;
    const { state, samples, keyed } = this.#shown;
    const { rateHz, cycle, values } = samples;
    const separation = (from: Float32Array, first: number) =>
      Array.from({ length: cycle.frames }, (_, i) => from[2 * (first + i)]!);
    const [recorded, followed] = [separation(values, cycle.first), separation(keyed.values, 0)];
    const axes: Axes = {
      width: this.#frame.width,
      height: this.#frame.height,
      x: [0, (cycle.frames - 1) / rateHz],
      y: extentOf([...recorded, ...followed], 10),
    };
    this.#axes = axes;
    const columns = ticksOf(axes.x, 6).map((value) => [value, figure(value, 1, words)] as const);
    const labels = { x: words.map.time, y: words.map.separation, columns, rows: ticksOf(axes.y, 4) };
    this.#frame.drawGrid(axes, labels, words);
    setAttributes(this.#recorded, { d: curvePath(axes, recorded, rateHz) });
    setAttributes(this.#followed, { d: curvePath(axes, followed, rateHz) });
    const [bottom, top] = [yOf(axes, axes.y[0]), yOf(axes, axes.y[1])];
    const heights = Array.from(keyed.errors, (error, i) => {
      const height = ((bottom - top) / 3) * Math.min(1, error / FULL);
      return `${xOf(axes, i / rateHz).toFixed(1)} ${(bottom - height).toFixed(1)}`;
    });
    const right = xOf(axes, axes.x[1]);
    setAttributes(this.#errors, { d: `M${xOf(axes, 0)} ${bottom}L${heights.join("L")}L${right} ${bottom}Z` });
    const places = state.keys.map((frame) => [frame / rateHz, recorded[frame] ?? recorded.at(-1)!] as const);
    this.#handles.elements.forEach((element, i) => {
      element.classList.toggle("unused", i >= places.length);
    });
    this.#handles.place(axes, places, ([secs]) => `${figure(secs, 2, words)} s`);
    setText(this.#readout, words.map.keyed(String(state.keys.length), figure(meanOf(keyed.errors), 2, words)));
  }
}
