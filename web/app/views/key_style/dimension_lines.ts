/** Draws the measures of a pose over the picture of the body. */

import type { WorldPose } from "../../../humanoid";
import { html, svg } from "../../../ui/dom";
import type { Axis } from "../../state/key_style";
import { dimensionOf, type Point } from "./dimensions";

/** Projects a point of the world to the picture, pixels. */
type Project = (point: Point) => { x: number; y: number };

/** A measure of the current pose, in words. */
export interface Measured {
  axis: Axis;
  words: string;
}

/** The elements of a dimension. */
interface Drawn {
  group: SVGGElement;
  line: SVGPathElement;
  leaders: SVGPathElement;
  text: SVGTextElement;
}

/** Length of the ends of a dimension line, pixels. */
const END = 5;

export class DimensionLines {
  readonly element = html("div", { class: "dimensions", "aria-hidden": "true" });
  readonly #root = svg("svg", {});
  #rows: Drawn[] = [];

  constructor() {
    this.element.append(this.#root);
  }

  /** Shows the measures of a pose, the first one in the signal's colour. */
  draw(measured: readonly Measured[], joints: WorldPose, project: Project): void {
    while (this.#rows.length > measured.length) this.#rows.pop()!.group.remove();
    while (this.#rows.length < measured.length) this.#rows.push(this.#add(this.#rows.length));
    const left = this.#screenLeft(joints, project);
    for (const [i, { axis, words }] of measured.entries()) {
      const { group, line, leaders, text } = this.#rows[i]!;
      const dimension = dimensionOf(axis, joints, left);
      const [a, b] = dimension ? dimension.line.map(project) : [];
      // Before the picture has a size, positions are not finite.
      const placed = dimension !== undefined && a && b && Number.isFinite(a.x + a.y + b.x + b.y);
      group.classList.toggle("absent", !placed);
      if (!placed) continue;
      const length = Math.hypot(b.x - a.x, b.y - a.y) || 1;
      const [nx, ny] = [(-(b.y - a.y) / length) * END, ((b.x - a.x) / length) * END];
      const stroke = (p: { x: number; y: number }) => `M${at(p.x - nx, p.y - ny)}L${at(p.x + nx, p.y + ny)}`;
      line.setAttribute("d", `M${at(a.x, a.y)}L${at(b.x, b.y)}${stroke(a)}${stroke(b)}`);
      const lead = dimension.leaders.map(([from, to]) => {
        const [p, q] = [project(from), project(to)];
        return `M${at(p.x, p.y)}L${at(q.x, q.y)}`;
      });
      leaders.setAttribute("d", lead.join(""));
      // The text is next to a vertical line, which is to the right of the body, and above a horizontal one.
      const upright = Math.abs(b.y - a.y) > Math.abs(b.x - a.x);
      text.setAttribute("text-anchor", upright ? "start" : "middle");
      text.setAttribute("x", ((a.x + b.x) / 2 + (upright ? 10 : 0)).toFixed(1));
      text.setAttribute(
        "y",
        (upright ? (a.y + b.y) / 2 + 4 : dimension.below ? Math.max(a.y, b.y) + 20 : Math.min(a.y, b.y) - 8).toFixed(1),
      );
      if (text.textContent !== words) text.textContent = words;
    }
  }

  clear(): void {
    this.draw([], { positions: new Float32Array(), rotations: new Float32Array() }, () => ({ x: 0, y: 0 }));
  }

  #add(i: number): Drawn {
    const line = svg("path", { class: "dimension-line" });
    const leaders = svg("path", { class: "dimension-leader" });
    const text = svg("text", {});
    const group = svg("g", { class: i === 0 ? "dimension first" : "dimension" }, leaders, line, text);
    this.#root.append(group);
    return { group, line, leaders, text };
  }

  /** The direction on the ground towards the left of the picture; zero if it is seen from above. */
  #screenLeft(joints: WorldPose, project: Project): Point {
    if (joints.positions.length === 0) return [0, 0, 0];
    const [x, y, z] = hips(joints);
    const from = project([x, y, z]);
    const [dx, dz] = [project([x + 0.1, y, z]).x - from.x, project([x, y, z + 0.1]).x - from.x];
    const length = Math.hypot(dx, dz);
    return length < 1e-6 ? [0, 0, 0] : [-dx / length, 0, -dz / length];
  }
}

const at = (x: number, y: number) => `${x.toFixed(1)} ${y.toFixed(1)}`;
const hips = ({ positions }: WorldPose): Point => [positions[0]!, positions[1]!, positions[2]!];
