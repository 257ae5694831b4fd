/** Distance of every window of a class from the query, over time, with the K nearest marked. */
import { html, keepCount, setAttributes, setText, svg } from "../../ui/dom";
import { roundedExtent } from "../../ui/scale";
import type { Axes } from "../axes";
import { RATE_HZ } from "../built_in";
import type { FigureKind, FigureParts } from "../kind";
import { PlotFigure } from "../plot_figure";
import sheet from "./near.css?inline";
import { distanceOf, type Found, foundOf, measureNear } from "./near_measure";
import { NEAR_FIELDS, NEAR_RANGES, type NearState, NO_GUESS, WINDOWS } from "./near_state";

/** Minimum range of the axis, mm. */
const LEAST_EXTENT = 10;
/** Rows of the table. */
const TABLE_ROWS = 12;
const MM = 1000;

export const PROFILE: FigureKind<NearState> = {
  fields: NEAR_FIELDS,
  measure: measureNear,
  sheet,
  create: (parts) => new ProfileFigure(parts),
};

interface Shown {
  state: NearState;
  found: Found;
}

class ProfileFigure extends PlotFigure<NearState, Shown> {
  readonly #curve = svg("path", { class: "curve", "data-term": "D" });
  readonly #dots = svg("g", { class: "dots nearest", "data-term": "K" });
  readonly #reach = svg("path", { class: "reach", "data-term": "K" });

  constructor(parts: FigureParts<NearState>) {
    const { near } = parts.words;
    super(parts, near.title);
    const { picture, element } = this.frame;
    picture.append(this.#curve, this.#reach, this.#dots);
    const window = this.segment("window", near.window, WINDOWS, (frames) => frames, "s");
    const windows = html("div", { class: "windows" }, html("span", {}, near.window), window.element);
    this.lay({
      title: near.title,
      picture: element,
      head: [this.readout],
      foot: [],
      controls: [
        ...this.knobs(["k"], near.knobs, NEAR_RANGES, { k: "K" }),
        html("div", { class: "others" }, windows, this.toggle("reversed", near.reversed)),
        this.guess("guess", near.guess, { min: 0, max: 5000 }, NO_GUESS, 2),
      ],
    });
  }

  protected async load(state: NearState): Promise<Shown> {
    return { state, found: await foundOf(this.parts.engine, state) };
  }

  protected describe({ found, state: { window, reversed, k } }: Shown): string {
    return this.words.near.said(window, reversed, this.#mm(found, 0), String(k), this.#mm(found, k - 1));
  }

  protected get columns() {
    return this.words.near.columns.slice(0, 2);
  }

  protected rows({ found }: Shown): string[][] {
    const { order, firstRow } = found;
    return Array.from(order.subarray(0, TABLE_ROWS), (at, place) => [String(firstRow + at), this.#mm(found, place)]);
  }

  protected override quantities({ found, state: { k, window } }: Shown) {
    return { D: `${this.#mm(found, 0)} mm`, K: `${this.#mm(found, k - 1)} mm`, s: window };
  }

  /** √D of the nearest window at a given rank, as text. */
  #mm(found: Found, place: number): string {
    return this.number(MM * distanceOf(found, place), 1);
  }

  protected draw({ found, state }: Shown): void {
    const { near } = this.words;
    const { distances, order } = found;
    const farthest = MM * distanceOf(found, order.length - 1);
    const secs = distances.length / RATE_HZ;
    const axes = this.plot(
      { min: 0, max: secs },
      { min: 0, max: roundedExtent([0, farthest], LEAST_EXTENT).max },
      { x: near.rows, y: near.distance, columns: 6, digits: 0, rows: 5 },
    );
    setAttributes(this.#curve, { d: envelope(axes, distances) });
    const reach = axes.y(MM * distanceOf(found, Math.min(state.k, order.length) - 1));
    setAttributes(this.#reach, { d: `M${axes.x(0)} ${reach}H${axes.x(secs)}` });
    this.#drawDots(axes, found, state.k);
    setText(this.readout, near.read(this.#mm(found, 0), String(state.k), this.#mm(found, state.k - 1)));
  }

  #drawDots(axes: Axes, { order, distances }: Found, k: number): void {
    const nearest = order.subarray(0, k);
    keepCount(this.#dots, nearest.length, () => svg("circle", { r: 2.5 }));
    nearest.forEach((at, i) => {
      setAttributes(this.#dots.children[i]!, {
        cx: axes.x(at / RATE_HZ).toFixed(1),
        cy: axes.y(MM * distances[at]!).toFixed(1),
      });
    });
  }
}

/** The lower envelope of the distances per unit of the picture: a class has more windows than units. */
function envelope(axes: Axes, distances: Float32Array): string {
  let path = "";
  let pen = "M";
  for (let at = 0; at < distances.length; ) {
    const pixel = Math.floor(axes.x(at / RATE_HZ));
    let least = Number.POSITIVE_INFINITY;
    for (; at < distances.length && Math.floor(axes.x(at / RATE_HZ)) === pixel; at++)
      if (distances[at]! < least) least = distances[at]!;
    if (!Number.isFinite(least)) pen = "M";
    else {
      path += `${pen}${pixel} ${axes.y(MM * least).toFixed(1)}`;
      pen = "L";
    }
  }
  return path;
}
