/** The picture of an atlas on a canvas: one canvas pixel per pixel of the picture, stretched by the page. */
import { html } from "../../../../ui/dom";
import type { Shades, Span } from "./shades";

export class AtlasCanvas {
  readonly element = html("canvas", { class: "atlas-picture", "aria-hidden": "true" });
  readonly #context: CanvasRenderingContext2D;
  #shades: Shades | undefined;
  #span: Span = { first: 0, last: 1 };
  #ramp: Uint8Array = new Uint8Array(0);
  #stale = false;

  constructor() {
    // The page's tests read it, and a canvas on the GPU would wait for the 3-D picture.
    this.#context = this.element.getContext("2d", { willReadFrequently: true })!;
  }

  /** Colours of shades, three bytes each. */
  set ramp(ramp: Uint8Array) {
    this.#ramp = ramp;
    this.#invalidate();
  }

  /** Begins another picture. Until it arrives, the previous picture of the same windows is stretched to its position. */
  begin(shades: Shades, span: Span): void {
    const { columns, height } = shades;
    const before = this.#shades;
    if (before?.columns === columns) this.#foresee(shades, span, before);
    this.#shades = shades;
    this.#span = span;
    if (this.element.width !== columns || this.element.height !== height) {
      this.element.width = columns;
      this.element.height = height;
    }
    this.#invalidate();
  }

  /** Shows the part of the picture that has arrived. */
  update(): void {
    this.#invalidate();
  }

  #foresee(shades: Shades, { first, last }: Span, before: Shades): void {
    const length = this.#span.last - this.#span.first;
    for (let line = 0; line < shades.height; line++) {
      const window = first + ((line + 0.5) / shades.height) * (last - first);
      const from = Math.floor(((window - this.#span.first) / length) * before.height);
      if (from < 0 || from >= before.height) continue;
      const { columns } = shades;
      shades.levels.set(before.levels.subarray(from * columns, (from + 1) * columns), line * columns);
    }
  }

  /** Paints once before the next frame of the page. */
  #invalidate(): void {
    if (this.#stale) return;
    this.#stale = true;
    requestAnimationFrame(() => {
      this.#stale = false;
      this.#paint();
    });
  }

  #paint(): void {
    const shades = this.#shades;
    if (!shades || this.#ramp.length === 0) return;
    const image = this.#context.createImageData(shades.columns, shades.height);
    const { data } = image;
    const { levels } = shades;
    for (let i = 0; i < levels.length; i++) {
      const at = 3 * levels[i]!;
      data[4 * i] = this.#ramp[at]!;
      data[4 * i + 1] = this.#ramp[at + 1]!;
      data[4 * i + 2] = this.#ramp[at + 2]!;
      data[4 * i + 3] = 255;
    }
    this.#context.putImageData(image, 0, 0);
  }
}
