/** A sole from above during a stance: if it is held, all outlines coincide. */
import type { Slider } from "../../ui/controls/slider";
import { html, setAttributes, setText, svg } from "../../ui/dom";
import { type Axes, ticksOf, xOf, yOf } from "../axes";
import { RATE_HZ } from "../built_in";
import { createInstant } from "../controls";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { Latest } from "../latest";
import { PlotFrame } from "../plot_frame";
import { figure } from "../words/words";
import sheet from "./feet.css?inline";
import { measureFeet, type Track, type Tracks, tracksOf, within } from "./feet_measure";
import { FEET_FIELDS, type FeetState } from "./feet_state";
import { pivotTravel, type Sole } from "./soles";

/** Minimum displayed range along the foot, cm: a foot's length, and space to slide; and the displayed range across. */
const ALONG = [-5, 23] as const;
const ACROSS = 6;
/** Frames between two rows of the table. */
const TABLE_STEP = 5;
const CM = 100;
/** Length of an arrow's head, units; an arrow shorter than the second value, cm, is not drawn. */
const BARB = 8;
const LEAST_ARROW = 0.2;

export const SOLES: FigureKind<FeetState> = {
  fields: FEET_FIELDS,
  sheet,
  create: (parts) => new SolesFigure(parts),
};

/** Heel and ball on the ground, cm from the heel at the start of the stance: forwards and to the left. */
interface Outline {
  frame: number;
  heel: readonly [along: number, across: number];
  ball: readonly [along: number, across: number];
}

/** A foot in a stance, and at the playhead with and without the hold. */
interface Shown {
  state: FeetState;
  outlines: Outline[];
  /** Sliding distance in this stance, cm. */
  cm: number;
  /** At the playhead: as displayed, and with the other setting of the hold; `undefined` while it is lifted. */
  now: Outline | undefined;
  other: Outline | undefined;
  /** Distance by which the hold has moved it at the playhead, cm. */
  moved: number;
}

class SolesFigure implements FigureInstance<FeetState> {
  readonly #parts: FigureParts<FeetState>;
  readonly #frame: PlotFrame;
  readonly #instant: Slider;
  readonly #outlines = svg("g", { class: "outlines" });
  readonly #other = svg("path", { class: "sole other" });
  readonly #now = svg("path", { class: "sole now", "data-term": "p" });
  readonly #correction = svg("path", { class: "correction", "data-term": "q" });
  readonly #label = svg("text", { class: "label chosen" });
  readonly #readout = html("p", { class: "readout" });
  readonly #tracking = new Latest<FeetState>((state) => this.#track(state));
  #state: FeetState | undefined;
  #shown: Shown | undefined;

  constructor(parts: FigureParts<FeetState>) {
    this.#parts = parts;
    const { words, container, signal, change } = parts;
    this.#frame = new PlotFrame(words.feet.soles, () => this.#drawNow(), signal);
    this.#instant = createInstant(words, 2, change);
    const { picture } = this.#frame;
    picture.append(this.#outlines, this.#other, this.#now, this.#correction, this.#label);
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
    return this.#shown ? { q: `${figure(this.#shown.moved, 1, this.#parts.words)} cm` } : {};
  }

  light(term: string | undefined): void {
    this.#frame.light(term);
  }

  async #track(asked: FeetState): Promise<void> {
    const tracks = await tracksOf(this.#parts.engine, asked);
    if (this.#parts.signal.aborted) return;
    const state = within(asked, tracks);
    const [from, to] = stanceAt(tracks, state.at);
    const [{ soles }, other] = state.hold ? [tracks.held, tracks.free] : [tracks.free, tracks.held];
    let cm = 0;
    for (let frame = from + 1; frame <= to; frame++)
      cm += CM * Math.hypot(...pivotTravel(soles[frame]!, soles[frame - 1]!));
    const place = placesOf(soles[(from + to) >> 1]!);
    const outlines = soles.slice(from, to + 1).map((sole, i) => place(sole, from + i));
    const now = outlines.find(({ frame }) => frame === state.at);
    this.#shown = {
      state,
      outlines,
      cm,
      now,
      other: now && place(other.soles[state.at]!, state.at),
      moved: correctionOf(tracks, state.at),
    };
    this.#parts.changed();
    this.#frame.request();
  }

  #drawNow(): void {
    if (!this.#shown) return;
    const { words } = this.#parts;
    const { outlines, cm, now, other, moved } = this.#shown;
    const [width, height] = [this.#frame.width, this.#frame.height];
    // The scale is equal in both directions.
    const [wide, high] = [Math.max(1, width - 60), Math.max(1, height - 60)];
    const perCm = Math.min(wide / (ALONG[1] - ALONG[0]), high / ACROSS);
    const half = high / perCm / 2;
    const axes: Axes = { width, height, x: [ALONG[0], ALONG[0] + wide / perCm], y: [-half, half] };
    const columns = ticksOf(axes.x, 8).map((value) => [value, figure(value, 0, words)] as const);
    this.#frame.drawGrid(axes, { x: words.feet.along, y: words.feet.across, columns, rows: ticksOf(axes.y, 4) }, words);
    const shape = ({ heel, ball }: Outline) =>
      `M${xOf(axes, heel[0]).toFixed(1)} ${yOf(axes, heel[1]).toFixed(1)}L${xOf(axes, ball[0]).toFixed(1)} ${yOf(axes, ball[1]).toFixed(1)}`;
    this.#outlines.replaceChildren(...outlines.map((one) => svg("path", { class: "sole", d: shape(one) })));
    setAttributes(this.#now, { d: now ? shape(now) : "" });
    setAttributes(this.#other, { d: other ? shape(other) : "" });
    this.#drawCorrection(axes, moved);
    setText(this.#readout, words.feet.slid(figure(cm, 1, words)));
  }

  /** Draws an arrow from the foot's position without the hold to that with it. */
  #drawCorrection(axes: Axes, moved: number): void {
    const { state, now, other } = this.#shown!;
    const middle = ({ heel, ball }: Outline) =>
      [xOf(axes, (heel[0] + ball[0]) / 2), yOf(axes, (heel[1] + ball[1]) / 2)] as const;
    const [free, held] = state.hold ? [other, now] : [now, other];
    const visible = free && held && moved >= LEAST_ARROW;
    setAttributes(this.#correction, { d: visible ? arrow(middle(free), middle(held)) : "" });
    const [x, y] = held ? middle(held) : [0, 0];
    setAttributes(this.#label, { x: x + 8, y: y - 16 });
    setText(this.#label, visible ? `q ${figure(moved, 1, this.#parts.words)} cm` : "");
  }
}

/** An arrow from one point to another. */
function arrow([x, y]: readonly [number, number], [toX, toY]: readonly [number, number]): string {
  const angle = Math.atan2(toY - y, toX - x);
  const barb = (by: number) =>
    `${(toX - BARB * Math.cos(angle + by)).toFixed(1)} ${(toY - BARB * Math.sin(angle + by)).toFixed(1)}`;
  return `M${x.toFixed(1)} ${y.toFixed(1)}L${toX.toFixed(1)} ${toY.toFixed(1)}M${barb(0.5)}L${toX.toFixed(1)} ${toY.toFixed(1)}L${barb(-0.5)}`;
}

/** First and last frames of the stance at a frame, or of the next one. */
function stanceAt({ stands }: Tracks, at: number): [from: number, to: number] {
  let from = Math.min(at, stands.length - 1);
  while (stands[from] === 0 && from < stands.length - 1) from++;
  while (from > 0 && stands[from - 1] === 1) from--;
  let to = from;
  while (stands[to + 1] === 1) to++;
  return [from, to];
}

/** Ground positions in the frame of the flat foot, which is its orientation in the middle of the stance. */
function placesOf(flat: Sole): (sole: Sole, frame: number) => Outline {
  const origin = flat.heel;
  const [dx, dz] = [flat.ball[0] - flat.heel[0], flat.ball[2] - flat.heel[2]];
  const length = Math.hypot(dx, dz) || 1;
  const place = ([x, , z]: Sole["heel"]): [number, number] => {
    const [px, pz] = [CM * (x - origin[0]), CM * (z - origin[2])];
    // Left of a body that faces +Z is +X.
    return [(px * dx + pz * dz) / length, (px * dz - pz * dx) / length];
  };
  return ({ heel, ball }, frame) => ({ frame, heel: place(heel), ball: place(ball) });
}

/** Distance between the middles of a sole with and without the hold, cm: the length of q. */
export function correctionOf({ held, free }: Pick<Tracks, "held" | "free">, frame: number): number {
  const middle = ({ soles }: Track, axis: 0 | 2) => (soles[frame]!.heel[axis] + soles[frame]!.ball[axis]) / 2;
  return CM * Math.hypot(middle(held, 0) - middle(free, 0), middle(held, 2) - middle(free, 2));
}
