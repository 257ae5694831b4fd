/** The axes of a plot: positions of values, in units (`ui/drawing.ts`). */
import { type Extent, pixelOf, type Scale, valueAt } from "../ui/scale";

/** Space around marks, units. */
export type Margin = Readonly<Record<"left" | "right" | "top" | "bottom", number>>;

/** Space for ticks and the names of the axes. */
export const MARGIN: Margin = { left: 44, right: 16, top: 16, bottom: 44 };

/** How axes differ from the usual ones. */
export interface AxesShape {
  /** By default {@link MARGIN}. */
  margin?: Margin;
  /** Whether the horizontal axis is logarithmic. */
  logX?: boolean;
}

export class Axes {
  /** The edges of the area of marks. */
  readonly left: number;
  readonly right: number;
  readonly top: number;
  readonly bottom: number;

  constructor(
    readonly width: number,
    readonly height: number,
    /** The values between the edges. */
    readonly across: Extent,
    readonly up: Extent,
    { margin = MARGIN, logX = false }: AxesShape = {},
  ) {
    this.left = margin.left;
    this.right = margin.left + Math.max(1, width - margin.left - margin.right);
    this.top = margin.top;
    this.bottom = margin.top + Math.max(1, height - margin.top - margin.bottom);
    this.#x = { ...across, from: this.left, to: this.right, log: logX };
    this.#y = { ...up, from: this.bottom, to: this.top };
  }

  readonly #x: Scale;
  readonly #y: Scale;

  /** Position of a horizontal value. */
  x(value: number): number {
    return pixelOf(this.#x, value);
  }

  /** Position of a vertical value. */
  y(value: number): number {
    return pixelOf(this.#y, value);
  }

  /** The horizontal value at a position. */
  valueAtX(place: number): number {
    return valueAt(this.#x, place);
  }

  /** The vertical value at a position. */
  valueAtY(place: number): number {
    return valueAt(this.#y, place);
  }

  /** The position of a pair of values, for a path. */
  at(x: number, y: number): string {
    return `${this.x(x).toFixed(1)} ${this.y(y).toFixed(1)}`;
  }

  /** The path of values at a constant rate, with gaps where a value is not finite. */
  curve(values: ArrayLike<number>, rateHz: number): string {
    let path = "";
    let pen = "M";
    for (let frame = 0; frame < values.length; frame++) {
      const value = values[frame]!;
      if (Number.isFinite(value)) path += `${pen}${this.at(frame / rateHz, value)}`;
      pen = Number.isFinite(value) ? "L" : "M";
    }
    return path;
  }
}
