/** The picture of a plot: its size, its grid with labels, and the terms of its marks. It is drawn in units (`drawing.ts`). */
import { html, setAttributes, svg } from "../ui/dom";
import { sizeOf } from "../ui/drawing";
import { type Axes, digitsOf, MARGIN, xOf, yOf } from "./axes";
import { figure, type Words } from "./words/words";

/** Labels of the axes, and their ticks. */
export interface Grid {
  x: string;
  y: string;
  columns: readonly (readonly [value: number, label: string])[];
  rows: readonly number[];
}

export class PlotFrame {
  /** The element of the picture. */
  readonly element: HTMLElement;
  readonly picture = svg("svg", { class: "plot", role: "group" });
  /** Numbers of the axes are meaningless without the picture; its handles have labels of their own. */
  readonly #grid = svg("g", { class: "grid", "aria-hidden": "true" });
  readonly #draw: () => void;
  #request = 0;
  /** The data from which the grid was drawn. */
  #drawn = "";
  width = 0;
  height = 0;

  /** @param draw draws again; called when there is space to draw in */
  constructor(name: string, draw: () => void, signal: AbortSignal) {
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

  /** Reports the term of the hovered marks; to be called when all marks exist. */
  listenToMarks(point: (term: string | undefined) => void): void {
    for (const mark of this.picture.querySelectorAll("[data-term]")) {
      mark.addEventListener("pointerenter", () => point(mark.getAttribute("data-term")!));
      mark.addEventListener("pointerleave", () => point(undefined));
    }
  }

  light(term: string | undefined): void {
    for (const mark of this.picture.querySelectorAll("[data-term]"))
      mark.classList.toggle("lit", mark.getAttribute("data-term") === term);
  }

  /** Draws the grid, unless it is unchanged. */
  drawGrid(axes: Axes, grid: Grid, words: Words): void {
    const drawn = JSON.stringify([axes, grid]);
    if (drawn === this.#drawn) return;
    this.#drawn = drawn;
    const { x, y, columns, rows } = grid;
    const [left, right] = [xOf(axes, axes.x[0]), xOf(axes, axes.x[1])];
    const [top, bottom] = [yOf(axes, axes.y[1]), yOf(axes, axes.y[0])];
    const text = (at: number, height: number, anchor: string, label: string) =>
      svg("text", { x: at, y: height, "text-anchor": anchor }, label);
    const digits = digitsOf(rows);
    this.#grid.replaceChildren(
      ...rows.flatMap((value) => [
        svg("path", { d: `M${left} ${yOf(axes, value)}H${right}` }),
        text(left - 6, yOf(axes, value) + 4, "end", figure(value, digits, words)),
      ]),
      ...columns.flatMap(([value, label]) => [
        svg("path", { d: `M${xOf(axes, value)} ${top}V${bottom}` }),
        text(xOf(axes, value), bottom + 16, "middle", label),
      ]),
      text(left, MARGIN.top - 5, "start", y),
      text(right, bottom + 32, "end", x),
    );
  }
}
