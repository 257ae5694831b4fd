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
