/** Distance of every window of a class from the query, over time, with the K nearest marked. */
import { Segment, Toggle } from "../../ui/controls/buttons";
import type { Knob } from "../../ui/controls/knob";
import { html, keepCount, setAttributes, setText, svg } from "../../ui/dom";
import { type Axes, extentOf, ticksOf, xOf, yOf } from "../axes";
import { RATE_HZ } from "../built_in";
import { createKnobs, GuessField } from "../controls";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { Latest } from "../latest";
import { PlotFrame } from "../plot_frame";
import { figure } from "../words/words";
import sheet from "./near.css?inline";
import { distanceOf, type Found, foundOf, measureNear } from "./near_measure";
import { NEAR_FIELDS, NEAR_RANGES, type NearState, NO_GUESS, WINDOWS, type WindowName } from "./near_state";

/** Minimum range of the axis, mm. */
const LEAST_EXTENT = 10;
/** Rows of the table. */
const TABLE_ROWS = 12;
const MM = 1000;

export const PROFILE: FigureKind<NearState> = {
  fields: NEAR_FIELDS,
  sheet,
  create: (parts) => new ProfileFigure(parts),
};

class ProfileFigure implements FigureInstance<NearState> {
  readonly #parts: FigureParts<NearState>;
  readonly #frame: PlotFrame;
  readonly #k: Knob;
  readonly #window: Segment<WindowName>;
  readonly #reversed: Toggle;
  readonly #guess: GuessField;
  readonly #readout = html("p", { class: "readout" });
  readonly #curve = svg("path", { class: "curve", "data-term": "D" });
  readonly #dots = svg("g", { class: "dots nearest", "data-term": "K" });
  readonly #reach = svg("path", { class: "reach", "data-term": "K" });
  readonly #finding = new Latest<NearState>((state) => this.#find(state));
  #state: NearState | undefined;
  #found: { state: NearState; found: Found } | undefined;

  constructor(parts: FigureParts<NearState>) {
    this.#parts = parts;
    const { words, container, signal, change } = parts;
    this.#frame = new PlotFrame(words.near.title, () => this.#drawNow(), signal);
    this.#k = createKnobs(["k"], words, words.near.knobs, NEAR_RANGES, NEAR_FIELDS, change).k;
    this.#window = new Segment(
      words.near.window,
      WINDOWS.map((value) => ({ value, label: value })),
      (window) => change({ window }, true),
    );
    this.#reversed = new Toggle(words.near.reversed, (reversed) => change({ reversed }, true));
    this.#guess = new GuessField(
      words.near.guess,
      { min: 0, max: 5000 },
      NO_GUESS,
      (guess) => change({ guess }, true),
      signal,
    );
    this.#frame.picture.append(this.#curve, this.#reach, this.#dots);
    this.#frame.listenToMarks(parts.point);
    const window = html("div", { class: "windows" }, html("span", {}, words.near.window), this.#window.element);
    container.append(
      html("header", { class: "head" }, html("h3", {}, words.near.title), this.#readout),
      this.#frame.element,
      html(
        "div",
        { class: "knobs" },
        this.#k.element,
        html("div", { class: "others" }, window, this.#reversed.element),
        this.#guess.element,
      ),
    );
  }

  show(state: NearState): Promise<void> {
    this.#state = state;
    this.#k.value = state.k;
    this.#window.value = state.window;
    this.#reversed.on = state.reversed;
    this.#guess.text = state.guess === NO_GUESS ? "" : figure(state.guess, 2, this.#parts.words);
    return this.#finding.take(state);
  }

  async measure(): Promise<Measure> {
    return this.#state ? measureNear(this.#parts.engine, this.#state) : {};
  }

  sentence(): string {
    if (!this.#found) return "";
    const { state } = this.#found;
    return this.#parts.words.near.said(
      state.window,
      state.reversed,
      this.#mm(0),
      String(state.k),
      this.#mm(state.k - 1),
    );
  }

  table(): Table {
    const { words } = this.#parts;
    const [row, distance] = words.near.columns;
    if (!this.#found) return { head: [row, distance], rows: [] };
    const { order, firstRow } = this.#found.found;
    const rows = Array.from(order.subarray(0, TABLE_ROWS), (at, place) => [String(firstRow + at), this.#mm(place)]);
    return { head: [row, distance], rows };
  }

  values(): Readonly<Record<string, string>> {
    if (!this.#found) return {};
    const { k, window } = this.#found.state;
    return { D: `${this.#mm(0)} mm`, K: `${this.#mm(k - 1)} mm`, s: window };
  }

  light(term: string | undefined): void {
    this.#frame.light(term);
    this.#k.element.classList.toggle("lit", term === "K");
    this.#window.element.classList.toggle("lit", term === "s");
  }

  async #find(state: NearState): Promise<void> {
    const found = await foundOf(this.#parts.engine, state);
    if (this.#parts.signal.aborted) return;
    this.#found = { state, found };
    this.#parts.changed();
    this.#frame.request();
  }

  /** √D of the nearest window at a given rank, as text. */
  #mm(place: number): string {
    return figure(MM * distanceOf(this.#found!.found, place), 1, this.#parts.words);
  }

  #drawNow(): void {
    if (!this.#found) return;
    const { words } = this.#parts;
    const { found, state } = this.#found;
    const { distances, order } = found;
    const farthest = MM * distanceOf(found, order.length - 1);
    const secs = distances.length / RATE_HZ;
    const axes: Axes = {
      width: this.#frame.width,
      height: this.#frame.height,
      x: [0, secs],
      y: [0, extentOf([0, farthest], LEAST_EXTENT)[1]],
    };
    const columns = ticksOf(axes.x, 6).map((value) => [value, figure(value, 0, words)] as const);
    const labels = { x: words.near.rows, y: words.near.distance, columns, rows: ticksOf(axes.y, 5) };
    this.#frame.drawGrid(axes, labels, words);
    setAttributes(this.#curve, { d: envelope(axes, distances) });
    const reach = yOf(axes, MM * distanceOf(found, Math.min(state.k, order.length) - 1));
    setAttributes(this.#reach, { d: `M${xOf(axes, 0)} ${reach}H${xOf(axes, secs)}` });
    this.#drawDots(axes, found, state.k);
    setText(this.#readout, words.near.read(this.#mm(0), String(state.k), this.#mm(state.k - 1)));
  }

  #drawDots(axes: Axes, { order, distances }: Found, k: number): void {
    const nearest = order.subarray(0, k);
    keepCount(this.#dots, nearest.length, () => svg("circle", { r: 2.5 }));
    nearest.forEach((at, i) => {
      setAttributes(this.#dots.children[i]!, {
        cx: xOf(axes, at / RATE_HZ).toFixed(1),
        cy: yOf(axes, MM * distances[at]!).toFixed(1),
      });
    });
  }
}

/** The lower envelope of the distances per unit of the picture: a class has more windows than units. */
function envelope(axes: Axes, distances: Float32Array): string {
  let path = "";
  let pen = "M";
  for (let at = 0; at < distances.length; ) {
    const pixel = Math.floor(xOf(axes, at / RATE_HZ));
    let least = Number.POSITIVE_INFINITY;
    for (; at < distances.length && Math.floor(xOf(axes, at / RATE_HZ)) === pixel; at++)
      if (distances[at]! < least) least = distances[at]!;
    if (!Number.isFinite(least)) pen = "M";
    else {
      path += `${pen}${pixel} ${yOf(axes, MM * least).toFixed(1)}`;
      pen = "L";
    }
  }
  return path;
}
