/** The plane of the style variables with the training frames in it. */
import { setAttributes, svg } from "../../ui/dom";
import { roundedExtent } from "../../ui/scale";
import type { Axes } from "../axes";
import type { PlotFrame } from "../plot_frame";
import type { Words } from "../words/words";

/** The training frames as dots on the plane. They and the axes are computed again only when the size changes. */
export class SamplePlane {
  /** A single path, as there are hundreds of frames. */
  readonly dots = svg("path", { class: "samples" });
  #axes: Axes | undefined;

  /** Axes that contain all training frames, with their grid and dots in the picture. */
  draw(frame: PlotFrame, values: Float32Array, words: Words): Axes {
    const { width, height } = frame;
    if (this.#axes?.width === width && this.#axes.height === height) return this.#axes;
    const of = (axis: number) => values.filter((_, i) => i % 2 === axis);
    const axes = frame.axes(roundedExtent(of(0), 10), roundedExtent(of(1), 5));
    frame.drawGrid(axes, { x: words.map.separation, y: words.map.height, columns: 6, digits: 0, rows: 4 });
    setAttributes(this.dots, { d: dotsOf(axes, values) });
    this.#axes = axes;
    return axes;
  }
}

function dotsOf(axes: Axes, values: Float32Array): string {
  let path = "";
  for (let i = 0; i < values.length; i += 2) path += `M${axes.at(values[i]!, values[i + 1]!)}h0`;
  return path;
}

/** Height of a bar of weight 1, units; and the distance between bars: at most `most`, and together a share of the plot. */
const BAR = { height: 34, most: 10, share: 0.3, filled: 0.7 };

/** A bar for every component at the upper right, with the name of their quantity. */
export class ShareBars {
  readonly element: SVGGElement;
  readonly #name: SVGTextElement;
  /** A single path: there are dozens of bars, which all change at once. */
  readonly #bars = svg("path");

  /** @param name name and term of the bars */
  constructor(name: string) {
    this.#name = svg("text", { class: "label y", "text-anchor": "end" }, name);
    this.element = svg("g", { class: "bars", "data-term": name }, this.#name, this.#bars);
  }

  draw(axes: Axes, shares: Float32Array): void {
    const [begin, end] = [axes.left, axes.right];
    const step = Math.min(BAR.most, (BAR.share * (end - begin)) / shares.length);
    const left = end - shares.length * step;
    const bottom = axes.top + BAR.height + 6;
    let path = "";
    shares.forEach((share, i) => {
      const height = Math.max(1, BAR.height * share);
      path += `M${(left + i * step).toFixed(1)} ${bottom}h${(BAR.filled * step).toFixed(1)}v${(-height).toFixed(1)}h${(-BAR.filled * step).toFixed(1)}z`;
    });
    setAttributes(this.#name, { x: left - 8, y: bottom });
    setAttributes(this.#bars, { d: path });
  }
}
