/** The picture of a plot: its size, and its grid with labels. It is drawn in units (`drawing.ts`). */
import { html, setAttributes, svg } from "../ui/dom";
import { sizeOf } from "../ui/drawing";
import { type Extent, ticks } from "../ui/scale";
import { Axes, type AxesShape, MARGIN } from "./axes";
import { formatNumber, type Words } from "./words/words";

/** Names of the axes, and their ticks. */
export interface Labels {
  x: string;
  y: string;
  /** The largest number of steps between the ticks of the horizontal axis, or the ticks with their labels. */
  columns: number | readonly (readonly [value: number, label: string])[];
  /** The largest number of steps between the ticks of the vertical axis; 0 for none. */
  rows: number;
  /** Number of decimals of the horizontal axis, by default as many as distinguish its ticks, and its unit. */
  digits?: number;
  unit?: string;
}

export class PlotFrame {
  /** The element of the picture. */
  readonly element: HTMLElement;
  readonly picture = svg("svg", { class: "plot", role: "group" });
  /** Numbers of the axes are meaningless without the picture; its handles have labels of their own. */
  readonly #grid = svg("g", { class: "grid", "aria-hidden": "true" });
  readonly #words: Words;
  readonly #draw: () => void;
  #request = 0;
  /** The data from which the grid was drawn. */
  #drawn = "";
  width = 0;
  height = 0;

  /** @param draw draws again; called when there is space to draw in */
  constructor(name: string, words: Words, draw: () => void, signal: AbortSignal) {
    this.#words = words;
    this.#draw = draw;
    this.picture.setAttribute("aria-label", name);
    this.picture.append(this.#grid);
    this.element = html("div", { class: "picture" }, this.picture);
    const observer = new ResizeObserver(() => {
      const { width, height } = sizeOf(this.element);
      if (width === this.width && height === this.height) return;
      [this.width, this.height] = [width, height];
      setAttributes(this.picture, { viewBox: `0 0 ${this.width} ${this.height}` });
      this.request();
    });
    observer.observe(this.element);
    const end = () => {
      observer.disconnect();
      cancelAnimationFrame(this.#request);
    };
    signal.addEventListener("abort", end, { once: true });
  }

  /** Draws with the next display frame: a drag may bring several states for one. */
  request(): void {
    cancelAnimationFrame(this.#request);
    this.#request = requestAnimationFrame(() => {
      if (this.width > 0) this.#draw();
    });
  }

  /** Axes that fill the picture. */
  axes(across: Extent, up: Extent, shape?: AxesShape): Axes {
    return new Axes(this.width, this.height, across, up, shape);
  }

  /** Draws the grid, unless it is unchanged. */
  drawGrid(axes: Axes, labels: Labels): void {
    const drawn = JSON.stringify([axes, labels]);
    if (drawn === this.#drawn) return;
    this.#drawn = drawn;
    const { left, right, top, bottom } = axes;
    const text = (x: number, y: number, anchor: string, label: string) =>
      svg("text", { x, y, "text-anchor": anchor }, label);
    const rows = labels.rows > 0 ? ticks(axes.up, labels.rows) : { values: [], digits: 0 };
    this.#grid.replaceChildren(
      ...rows.values.flatMap((value) => [
        svg("path", { d: `M${left} ${axes.y(value)}H${right}` }),
        text(left - 6, axes.y(value) + 4, "end", formatNumber(value, rows.digits, this.#words)),
      ]),
      ...this.#columns(axes, labels).flatMap(([value, label]) => [
        svg("path", { d: `M${axes.x(value)} ${top}V${bottom}` }),
        text(axes.x(value), bottom + 16, "middle", label),
      ]),
      text(left, MARGIN.top - 5, "start", labels.y),
      text(right, bottom + 32, "end", labels.x),
    );
  }

  #columns({ across }: Axes, { columns, digits, unit = "" }: Labels): readonly (readonly [number, string])[] {
    if (typeof columns !== "number") return columns;
    const found = ticks(across, columns);
    return found.values.map((value) => [value, `${formatNumber(value, digits ?? found.digits, this.#words)}${unit}`]);
  }
}
