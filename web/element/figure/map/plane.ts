/** The plane of the style variables with the training frames in it. */
import { svg } from "../../../ui/dom";
import { type Axes, extentOf, ticksOf, xOf, yOf } from "../axes";
import type { PlotFrame } from "../plot_frame";
import { figure, type Words } from "../words/words";

/** Axes that hold all training frames, with a grid. */
export function planeOf(frame: PlotFrame, values: Float32Array, words: Words): Axes {
  const of = (axis: number) => values.filter((_, i) => i % 2 === axis);
  const axes: Axes = { width: frame.width, height: frame.height, x: extentOf(of(0), 10), y: extentOf(of(1), 5) };
  const columns = ticksOf(axes.x, 6).map((value) => [value, figure(value, 0, words)] as const);
  const labels = { x: words.map.separation, y: words.map.height, columns, rows: ticksOf(axes.y, 4) };
  frame.drawGrid(axes, labels, words);
  return axes;
}

/** A dot for every training frame: one path, as there are hundreds. */
export function dotsOf(axes: Axes, values: Float32Array): string {
  let path = "";
  for (let i = 0; i < values.length; i += 2)
    path += `M${xOf(axes, values[i]!).toFixed(1)} ${yOf(axes, values[i + 1]!).toFixed(1)}h0`;
  return path;
}

/** The element that {@link dotsOf} is the path of. */
export function createDots(): SVGPathElement {
  return svg("path", { class: "samples" });
}

/** Height of the bar of 1, pixels; and how far from one bar to the next, at most that, and together a share of the plot. */
const BAR = { height: 34, most: 10, share: 0.3, filled: 0.7 };

/** A bar for every component at the upper right, with the name of what they are. */
export function barsOf(axes: Axes, shares: Float32Array, name: string): SVGElement[] {
  const [begin, end] = [xOf(axes, axes.x[0]), xOf(axes, axes.x[1])];
  const step = Math.min(BAR.most, (BAR.share * (end - begin)) / shares.length);
  const left = end - shares.length * step;
  const bottom = yOf(axes, axes.y[1]) + BAR.height + 6;
  const bars = Array.from(shares, (share, i) => {
    const height = Math.max(1, BAR.height * share);
    return svg("rect", { x: left + i * step, y: bottom - height, width: BAR.filled * step, height });
  });
  return [svg("text", { class: "label y", x: left - 8, y: bottom, "text-anchor": "end" }, name), ...bars];
}
