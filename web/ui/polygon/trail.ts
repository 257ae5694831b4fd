/** The path of the handle during a drag: a line that fades within 1.2 s. */
import { svg } from "../dom";
import type { Point } from "./geometry";

const LIFETIME_MS = 1200;
/** Points within this distance of the last one are not added. */
const SPACING = 2;
/** Opacity of the newest segment. */
const OPACITY = 0.6;

export class Trail {
  readonly element = svg("g", { class: "trail" });
  #points: { at: number; p: Point }[] = [];
  #frame = 0;

  /** Adds the current position of the handle. */
  add(p: Point): void {
    const last = this.#points.at(-1)?.p;
    if (last && Math.hypot(last.x - p.x, last.y - p.y) < SPACING) return;
    this.#points.push({ at: performance.now(), p });
    if (this.#frame === 0) this.#frame = requestAnimationFrame(() => this.#draw());
  }

  dispose(): void {
    cancelAnimationFrame(this.#frame);
  }

  #draw(): void {
    const now = performance.now();
    this.#points = this.#points.filter((point) => now - point.at < LIFETIME_MS);
    const lines = this.#points.slice(1).map(({ at, p }, i) => {
      const from = this.#points[i]!.p;
      const opacity = (OPACITY * (1 - (now - at) / LIFETIME_MS)).toFixed(3);
      return svg("line", { x1: from.x, y1: from.y, x2: p.x, y2: p.y, "stroke-opacity": opacity });
    });
    this.element.replaceChildren(...lines);
    this.#frame = this.#points.length > 0 ? requestAnimationFrame(() => this.#draw()) : 0;
  }
}
