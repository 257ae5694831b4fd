/** The still parts of the polygon control as SVG: labels and weight bars of its vertices, isolines, hatching. */
import { formatNumber, svg } from "../dom";
import { direction, type Point, quarterIsolines } from "./geometry";
import { BAR, type LabelledVertex, type LabelPlace, WORD_GAP } from "./labels";

/** The label of a vertex at its position, never rotated. */
export function label({ name, weight }: LabelledVertex, { x, y, anchor, numberBelow }: LabelPlace): SVGTextElement {
  const text = svg(
    "text",
    {
      class: "vertex-label",
      x: x.toFixed(1),
      y: y.toFixed(1),
      "text-anchor": anchor,
      "dominant-baseline": "central",
      "aria-hidden": "true",
    },
    svg("tspan", { class: "vertex-name" }, name),
  );
  if (weight === undefined) return text;
  const place = numberBelow > 0 ? { x: x.toFixed(1), dy: numberBelow } : { dx: WORD_GAP };
  text.append(
    // Keeps name and number two words for screen readers, without taking space in the drawing.
    svg("tspan", { "font-size": 0 }, " "),
    svg("tspan", { class: "vertex-number", ...place }, formatNumber(weight, 2)),
  );
  return text;
}

/** The radial bar of a selected vertex: yellow from the inner end; a negative weight extends inwards from there. */
export function weightBar(position: Point, weight: number): SVGGElement {
  const out = direction(position);
  const degrees = (Math.atan2(out.y, out.x) * 180) / Math.PI;
  const filled = Math.min(1, Math.abs(weight)) * BAR.length;
  const half = BAR.width / 2;
  const bar = svg("g", {
    transform: `translate(${position.x} ${position.y}) rotate(${degrees}) translate(${BAR.gap} ${-half})`,
  });
  bar.append(svg("rect", { class: "bar-track", width: BAR.length, height: BAR.width, rx: 1.5 }));
  bar.append(
    svg("rect", {
      class: "bar-weight",
      x: weight < 0 ? -filled : 0,
      width: filled.toFixed(2),
      height: BAR.width,
      rx: Math.min(1.5, filled / 2),
    }),
  );
  return bar;
}

/** Path through points, closed unless `close` is false. */
export function path(points: readonly Point[], close = true): string {
  const steps = points.map((p, i) => `${i === 0 ? "M" : "L"}${p.x.toFixed(2)} ${p.y.toFixed(2)}`);
  return steps.join("") + (close && points.length > 2 ? "z" : "");
}

/** Quarter isolines of a triangle as one path; empty for fewer corners. */
export function isolines(corners: readonly Point[]): string {
  const [a, b, c] = corners;
  if (!a || !b || !c || corners.length > 3) return "";
  return quarterIsolines(a, b, c)
    .map((line) => path(line, false))
    .join("");
}

/** The pattern of 45° hatching, 7 px apart, that marks the area beyond the data. */
export function hatching(id: string): SVGDefsElement {
  const line = svg("line", { class: "hatch", x1: 0, y1: 0, x2: 0, y2: 7 });
  const attributes = { id, width: 7, height: 7, patternUnits: "userSpaceOnUse", patternTransform: "rotate(45)" };
  return svg("defs", {}, svg("pattern", attributes, line));
}
