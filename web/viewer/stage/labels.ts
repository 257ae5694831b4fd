/** Names above the heads, as page text over the canvas, so that they are sharp and use the page's font. */

import { type PerspectiveCamera, Vector3 } from "three";

/** Gap between a head and the middle of its name, pixels. */
const GAP = 17;

/** A layer of names over the canvas. */
export class Labels {
  readonly element = document.createElement("div");
  readonly #names = new Map<string, HTMLSpanElement>();
  readonly #point = new Vector3();

  constructor() {
    // The names repeat the picture's description.
    this.element.setAttribute("aria-hidden", "true");
    this.element.style.cssText = "position:absolute;inset:0;overflow:hidden;pointer-events:none";
  }

  /** Sets the text and colour of a name; an empty text removes it. */
  set(key: string, text: string, colour: string): void {
    let name = this.#names.get(key);
    if (!text) {
      name?.remove();
      this.#names.delete(key);
      return;
    }
    if (!name) {
      name = document.createElement("span");
      name.className = "viewer-label";
      name.style.cssText =
        "position:absolute;left:0;top:0;visibility:hidden;font-size:12px;line-height:16px;font-weight:600;white-space:nowrap";
      this.#names.set(key, name);
      this.element.append(name);
    }
    name.textContent = text;
    name.style.color = colour;
  }

  /** Places a name above a head, a sphere in the world (metres), or hides it if the head is not in the picture. */
  place(key: string, head: Vector3, radius: number, camera: PerspectiveCamera, width: number, height: number): void {
    const name = this.#names.get(key);
    if (!name) return;
    const p = this.#point.copy(head).applyMatrix4(camera.matrixWorldInverse);
    const pixelsPerMetre = (camera.projectionMatrix.elements[5]! * height) / (2 * Math.max(camera.near, -p.z));
    p.applyMatrix4(camera.projectionMatrix);
    const visible = p.z < 1 && Math.abs(p.x) < 1.1 && Math.abs(p.y) < 1.1;
    // Hidden together with its view.
    name.style.visibility = visible ? "inherit" : "hidden";
    const x = ((p.x + 1) / 2) * width;
    const y = ((1 - p.y) / 2) * height - radius * pixelsPerMetre - GAP;
    name.style.transform = `translate(${x.toFixed(1)}px,${y.toFixed(1)}px) translate(-50%,-50%)`;
  }

  dispose(): void {
    this.element.remove();
  }
}
