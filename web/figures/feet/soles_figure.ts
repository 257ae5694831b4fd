/** A sole from above during a stance: if it is held, all outlines coincide. */
import { html, setAttributes, setText, svg } from "../../ui/dom";
import type { Axes } from "../axes";
import { RATE_HZ } from "../built_in";
import type { FigureKind, FigureParts } from "../kind";
import { PlotFigure } from "../plot_figure";
import sheet from "./feet.css?inline";
import { measureFeet, type Track, type Tracks, tracksOf, within } from "./feet_measure";
import { FEET_FIELDS, type FeetState } from "./feet_state";
import { pivotTravel, type Sole } from "./soles";

/** Minimum displayed range along the foot, cm: a foot's length, and space to slide; and the displayed range across. */
const ALONG = { min: -5, max: 23 } as const;
const ACROSS = 6;
/** Frames between two rows of the table. */
const TABLE_STEP = 5;
const CM = 100;
/** Length of an arrow's head, units; an arrow shorter than the second value, cm, is not drawn. */
const BARB = 8;
const LEAST_ARROW = 0.2;

export const SOLES: FigureKind<FeetState> = {
  fields: FEET_FIELDS,
  measure: measureFeet,
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

class SolesFigure extends PlotFigure<FeetState, Shown> {
  readonly #outlines = svg("g", { class: "outlines" });
  readonly #other = svg("path", { class: "sole other" });
  readonly #now = svg("path", { class: "sole now", "data-term": "p" });
  readonly #correction = svg("path", { class: "correction", "data-term": "q" });
  readonly #label = svg("text", { class: "label chosen" });

  constructor(parts: FigureParts<FeetState>) {
    const { soles } = parts.words.feet;
    super(parts, soles);
    const { picture, element } = this.frame;
    picture.append(this.#outlines, this.#other, this.#now, this.#correction, this.#label);
    this.lay({
      title: soles,
      picture: element,
      controls: [html("div", { class: "others" }, this.instant("at", 2))],
    });
  }

  protected async load(asked: FeetState): Promise<Shown> {
    const tracks = await tracksOf(this.parts.engine, asked);
    const state = within(asked, tracks);
    const [from, to] = stanceAt(tracks, state.at);
    const [{ soles }, other] = state.hold ? [tracks.held, tracks.free] : [tracks.free, tracks.held];
    let cm = 0;
    for (let frame = from + 1; frame <= to; frame++)
      cm += CM * Math.hypot(...pivotTravel(soles[frame]!, soles[frame - 1]!));
    const place = placesOf(soles[(from + to) >> 1]!);
    const outlines = soles.slice(from, to + 1).map((sole, i) => place(sole, from + i));
    const now = outlines.find(({ frame }) => frame === state.at);
    return {
      state,
      outlines,
      cm,
      now,
      other: now && place(other.soles[state.at]!, state.at),
      moved: correctionOf(tracks, state.at),
    };
  }

  protected describe({ state, cm }: Shown): string {
    const { feet } = this.words;
    return feet.seen(feet.sides[state.foot], this.number(cm, 1), state.hold);
  }

  protected get columns() {
    return this.words.feet.places;
  }

  protected rows({ outlines }: Shown): string[][] {
    return outlines
      .filter((_, i) => i % TABLE_STEP === 0)
      .map(({ frame, heel }) => [this.number(frame / RATE_HZ, 2), this.number(heel[0], 1), this.number(heel[1], 1)]);
  }

  protected override quantities({ moved }: Shown) {
    return { q: `${this.number(moved, 1)} cm` };
  }

  protected draw(shown: Shown): void {
    const { outlines, cm, now, other } = shown;
    const { width, height } = this.frame;
    // The scale is equal in both directions.
    const [wide, high] = [Math.max(1, width - 60), Math.max(1, height - 60)];
    const perCm = Math.min(wide / (ALONG.max - ALONG.min), high / ACROSS);
    const half = high / perCm / 2;
    const { along, across } = this.words.feet;
    const axes = this.plot(
      { min: ALONG.min, max: ALONG.min + wide / perCm },
      { min: -half, max: half },
      { x: along, y: across, columns: 8, digits: 0, rows: 4 },
    );
    const shape = ({ heel, ball }: Outline) => `M${axes.at(...heel)}L${axes.at(...ball)}`;
    this.#outlines.replaceChildren(...outlines.map((one) => svg("path", { class: "sole", d: shape(one) })));
    setAttributes(this.#now, { d: now ? shape(now) : "" });
    setAttributes(this.#other, { d: other ? shape(other) : "" });
    this.#drawCorrection(axes, shown);
    setText(this.readout, this.words.feet.slid(this.number(cm, 1)));
  }

  /** Draws an arrow from the foot's position without the hold to that with it. */
  #drawCorrection(axes: Axes, { state, now, other, moved }: Shown): void {
    const middle = ({ heel, ball }: Outline) =>
      [axes.x((heel[0] + ball[0]) / 2), axes.y((heel[1] + ball[1]) / 2)] as const;
    const [free, held] = state.hold ? [other, now] : [now, other];
    const visible = free && held && moved >= LEAST_ARROW;
    setAttributes(this.#correction, { d: visible ? arrow(middle(free), middle(held)) : "" });
    const [x, y] = held ? middle(held) : [0, 0];
    setAttributes(this.#label, { x: x + 8, y: y - 16 });
    setText(this.#label, visible ? `q ${this.number(moved, 1)} cm` : "");
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
