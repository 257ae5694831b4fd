/** A table of costs as an image: the higher the cost, the darker. */
import { html } from "../../ui/dom";
import { rem } from "../../ui/drawing";
import type { Axes } from "../axes";
import type { Warping } from "./warping";

/** Opacity of the cell with the highest cost. */
const FULL = 0.85;

export class Heat {
  readonly element = html("canvas", { class: "heat", "aria-hidden": "true" });
  #painted: { costs: Float32Array; colour: string } | undefined;

  /** Moves the image to its position in the axes. */
  place(axes: Axes, warping: Warping): void {
    const { style } = this.element;
    const { left, right, bottom, top } = axes;
    [style.left, style.top] = [rem(left), rem(top)];
    [style.width, style.height] = [rem(right - left), rem(bottom - top)];
    this.#paint(warping);
  }

  /** One pixel per cell; square roots make valleys distinguishable. */
  #paint({ costs, neutral, styled }: Warping): void {
    const { color: colour } = getComputedStyle(this.element);
    if (this.#painted?.costs === costs && this.#painted.colour === colour) return;
    const [width, height] = [neutral.frames, styled.frames];
    [this.element.width, this.element.height] = [width, height];
    const context = this.element.getContext("2d");
    if (!context) return;
    const image = context.createImageData(width, height);
    const dearest = costs.reduce((a, b) => Math.max(a, b), 0);
    for (let i = 0; i < width; i++)
      for (let j = 0; j < height; j++) {
        const share = Math.sqrt(costs[i * height + j]! / dearest);
        image.data[4 * ((height - 1 - j) * width + i) + 3] = 255 * FULL * share;
      }
    context.putImageData(image, 0, 0);
    context.globalCompositeOperation = "source-in";
    context.fillStyle = colour;
    context.fillRect(0, 0, width, height);
    this.#painted = { costs, colour };
  }
}
