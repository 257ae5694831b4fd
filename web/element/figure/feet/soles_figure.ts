/** A sole from above while its foot stands: held, every outline is the same. */
import type { Slider } from "../../../ui/controls/slider";
import { html, setAttributes, setText, svg } from "../../../ui/dom";
import { type Axes, ticksOf, xOf, yOf } from "../axes";
import { RATE_HZ } from "../built_in";
import { createInstant } from "../controls";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { Latest } from "../latest";
import { PlotFrame } from "../plot_frame";
import { figure } from "../words/words";
import sheet from "./feet.css?inline";
import { measureFeet, type Tracks, tracksOf } from "./feet_measure";
import { FEET_FIELDS, type FeetState } from "./feet_state";
import { pivotTravel, type Sole } from "./soles";

/** Half of what is shown across, cm; as much forwards as the picture has room for. */
const HALF = 12;
/** Frames between two rows of the table. */
const TABLE_STEP = 5;
const CM = 100;

export const SOLES: FigureKind<FeetState> = {
  fields: FEET_FIELDS,
  sheet,
  create: (parts) => new SolesFigure(parts),
};

/** Heel and ball over the ground, cm from the heel at the start of the stance: forwards and to the left. */
interface Outline {
  frame: number;
  heel: readonly [along: number, across: number];
  ball: readonly [along: number, across: number];
}

class SolesFigure implements FigureInstance<FeetState> {
  readonly #parts: FigureParts<FeetState>;
  readonly #frame: PlotFrame;
  readonly #instant: Slider;
  readonly #outlines = svg("g", { class: "outlines" });
  readonly #now = svg("path", { class: "sole now", "data-term": "q" });
  readonly #readout = html("p", { class: "readout" });
  readonly #tracking = new Latest<FeetState>((state) => this.#track(state));
  #state: FeetState | undefined;
  #shown: { state: FeetState; outlines: Outline[]; cm: number } | undefined;

  constructor(parts: FigureParts<FeetState>) {
    this.#parts = parts;
    const { words, container, signal, change } = parts;
    this.#frame = new PlotFrame(words.feet.soles, () => this.#drawNow(), signal);
    this.#instant = createInstant(words, 2, change);
    this.#frame.picture.append(this.#outlines, this.#now);
    this.#frame.listenToMarks(parts.point);
    container.append(
      html("header", { class: "head" }, html("h3", {}, words.feet.soles)),
      this.#frame.element,
      html("footer", { class: "foot" }, this.#readout),
      html("div", { class: "knobs" }, html("div", { class: "others" }, this.#instant.element)),
    );
  }

  show(state: FeetState): Promise<void> {
    this.#state = state;
    this.#instant.value = state.at;
    return this.#tracking.take(state);
  }

  async measure(): Promise<Measure> {
    return this.#state ? measureFeet(this.#parts.engine, this.#state) : {};
  }

  sentence(): string {
    if (!this.#shown) return "";
    const { words } = this.#parts;
    const { state, cm } = this.#shown;
    return words.feet.seen(words.feet.sides[state.foot], figure(cm, 1, words), state.hold);
  }

  table(): Table {
    const { words } = this.#parts;
    const rows = (this.#shown?.outlines ?? [])
      .filter((_, i) => i % TABLE_STEP === 0)
      .map(({ frame, heel }) => [
        figure(frame / RATE_HZ, 2, words),
        figure(heel[0], 1, words),
        figure(heel[1], 1, words),
      ]);
    return { head: words.feet.places, rows };
  }

  values(): Readonly<Record<string, string>> {
    return {};
  }

  light(term: string | undefined): void {
    this.#frame.light(term);
  }

  async #track(state: FeetState): Promise<void> {
    const tracks = await tracksOf(this.#parts.engine, state);
    if (this.#parts.signal.aborted) return;
    const [from, to] = stanceAt(tracks, state.at);
    const { soles } = state.hold ? tracks.held : tracks.free;
    let cm = 0;
    for (let frame = from + 1; frame <= to; frame++)
      cm += CM * Math.hypot(...pivotTravel(soles[frame]!, soles[frame - 1]!));
    this.#shown = { state, outlines: outlinesOf(soles, from, to), cm };
    this.#parts.changed();
    this.#frame.request();
  }

  #drawNow(): void {
    if (!this.#shown) return;
    const { words } = this.#parts;
    const { state, outlines, cm } = this.#shown;
    const [width, height] = [this.#frame.width, this.#frame.height];
    // A centimetre is as long in both directions.
    const perCm = Math.max(1, height - 60) / (2 * HALF);
    const axes: Axes = { width, height, x: [-HALF, (width - 60) / perCm - HALF], y: [-HALF, HALF] };
    const columns = ticksOf(axes.x, 8).map((value) => [value, figure(value, 0, words)] as const);
    this.#frame.drawGrid(axes, { x: words.feet.along, y: words.feet.across, columns, rows: ticksOf(axes.y, 4) }, words);
    const shape = ({ heel, ball }: Outline) =>
      `M${xOf(axes, heel[0]).toFixed(1)} ${yOf(axes, heel[1]).toFixed(1)}L${xOf(axes, ball[0]).toFixed(1)} ${yOf(axes, ball[1]).toFixed(1)}`;
    this.#outlines.replaceChildren(...outlines.map((one) => svg("path", { class: "sole", d: shape(one) })));
    const now = outlines.find(({ frame }) => frame === state.at);
    setAttributes(this.#now, { d: now ? shape(now) : "" });
    setText(this.#readout, words.feet.slid(figure(cm, 1, words)));
  }
}

/** First and last frames of the stance that a frame is in, or of the next one. */
function stanceAt({ stands }: Tracks, at: number): [from: number, to: number] {
  let from = Math.min(at, stands.length - 1);
  while (stands[from] === 0 && from < stands.length - 1) from++;
  while (from > 0 && stands[from - 1] === 1) from--;
  let to = from;
  while (stands[to + 1] === 1) to++;
  return [from, to];
}

/** Outlines of a stance, seen along the foot at its start. */
function outlinesOf(soles: readonly Sole[], from: number, to: number): Outline[] {
  // The foot lies flat in the middle of its stance.
  const flat = soles[(from + to) >> 1]!;
  const origin = flat.heel;
  const [dx, dz] = [flat.ball[0] - flat.heel[0], flat.ball[2] - flat.heel[2]];
  const length = Math.hypot(dx, dz) || 1;
  const place = ([x, , z]: Sole["heel"]): [number, number] => {
    const [px, pz] = [CM * (x - origin[0]), CM * (z - origin[2])];
    // Left of somebody who faces +Z is +X.
    return [(px * dx + pz * dz) / length, (px * dz - pz * dx) / length];
  };
  return Array.from({ length: to - from + 1 }, (_, i) => {
    const { heel, ball } = soles[from + i]!;
    return { frame: from + i, heel: place(heel), ball: place(ball) };
  });
}
