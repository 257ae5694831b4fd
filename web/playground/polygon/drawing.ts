/** The still parts of the polygon control as SVG: labels and weight bars of its vertices, isolines, hatching. */
import { formatNumber, svg } from "../dom";
import { type Point, quarterIsolines } from "./geometry";

/** Length, width and distance from the vertex of a radial weight bar. */
const BAR = { length: 22, width: 6, gap: 9 };
/** Distance from a vertex to the label of an idle style, and of a selected one beyond its bar. */
const IDLE_LABEL_GAP = 12;
const LABEL_GAP = 37;

/** What a label needs to know of its vertex. */
export interface LabelledVertex {
  name: string;
  /** Weight, where the style is selected. */
  weight: number | undefined;
  position: Point;
}

const direction = (p: Point): Point => {
  const length = Math.hypot(p.x, p.y) || 1;
  return { x: p.x / length, y: p.y / length };
};

const text = (p: Point, anchor: string, ...children: SVGTSpanElement[]) =>
  svg(
    "text",
    {
      class: "vertex-label",
      x: p.x.toFixed(1),
      y: p.y.toFixed(1),
      "text-anchor": anchor,
      "dominant-baseline": "central",
      "aria-hidden": "true",
    },
    ...children,
  );

const named = (name: string) => svg("tspan", { class: "vertex-name" }, name);
/** Keeps name and number two words for screen readers, without a place in the drawing. */
const wordBreak = () => svg("tspan", { "font-size": 0 }, " ");
const numbered = (weight: number, attributes: Record<string, string | number> = {}) =>
  svg("tspan", { class: "vertex-number", ...attributes }, formatNumber(weight, 2));

/**
 * The label of a vertex, never rotated: above and below the polygon on one line, elsewhere reading outwards from the
 * bar; at the very left and right the name stands over the bar and the number under it. `edge` is half the width
 * that labels may take.
 */
export function label({ name, weight, position }: LabelledVertex, edge: number): SVGTextElement {
  const out = direction(position);
  const side = Math.abs(out.x) < 0.3 ? 0 : Math.sign(out.x);
  const anchor = side === 0 ? "middle" : side > 0 ? "start" : "end";
  if (weight === undefined) {
    const gap = side === 0 ? IDLE_LABEL_GAP + 7 : IDLE_LABEL_GAP;
    return text({ x: position.x + out.x * gap, y: position.y + out.y * gap }, anchor, named(name));
  }
  if (side === 0) {
    const at = { x: position.x, y: position.y + out.y * (LABEL_GAP + 6) };
    return text(at, anchor, named(name), wordBreak(), numbered(weight, { dx: 6 }));
  }
  if (Math.abs(out.x) > 0.85) {
    const x = side * edge;
    const outer = side > 0 ? "end" : "start";
    const label = text({ x, y: position.y - 14 }, outer, named(name));
    label.append(wordBreak(), numbered(weight, { x, dy: 29 }));
    return label;
  }
  const at = { x: position.x + side * (LABEL_GAP - 10), y: position.y + out.y * (LABEL_GAP - 6) };
  const made = text({ x: at.x, y: out.y > 0 ? at.y : at.y - 15 }, anchor, named(name));
  made.append(wordBreak(), numbered(weight, { x: at.x.toFixed(1), dy: 15 }));
  return made;
}

/** The radial bar of a selected vertex: yellow from the inner end; a negative weight grows inwards from there. */
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

/** Path through points, closed unless told otherwise. */
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

/** The pattern of 45° hatching, 7 px apart, that marks what lies beyond the data. */
export function hatching(id: string): SVGDefsElement {
  const line = svg("line", { class: "hatch", x1: 0, y1: 0, x2: 0, y2: 7 });
  const attributes = { id, width: 7, height: 7, patternUnits: "userSpaceOnUse", patternTransform: "rotate(45)" };
  return svg("defs", {}, svg("pattern", attributes, line));
}
