/** A number field on an axis of the pad: the handle's value there, to read and to type. */
import { html, setAttributes } from "../../../ui/dom";
import { rem } from "../../../ui/drawing";
import type { Extent } from "../../../ui/scale";

/** Digits are tabular: width of a field per character, units of the pad's drawing. */
const CHARACTER = 7;
const PADDING = 18;
const HEIGHT = 24;

export class PadField {
  readonly element = html("input", { type: "number", class: "pad-field" });
  #digits = 1;
  #value = 0;
  #range: Extent = { min: 0, max: 1 };

  constructor(onType: (value: number) => void) {
    const { element } = this;
    element.addEventListener("change", () => {
      const typed = element.value === "" ? Number.NaN : Number(element.value);
      const { min, max } = this.#range;
      if (Number.isFinite(typed)) onType(Math.min(max, Math.max(min, typed)));
      this.#write();
    });
    element.addEventListener("blur", () => this.#write());
    element.addEventListener("keydown", (event) => {
      if (event.key !== "Escape") return;
      this.#write();
      element.blur();
    });
  }

  /** Sets another axis. */
  set axis({ label, range, digits }: { label: string; range: Extent; digits: number }) {
    this.#digits = digits;
    this.#range = range;
    const [min, max] = [range.min.toFixed(digits), range.max.toFixed(digits)];
    setAttributes(this.element, { "aria-label": label, min, max, step: 10 ** -digits });
  }

  /** Shows a value at a position of the pad's drawing, units: below it, or left of it. */
  show(value: number, x: number, y: number, side: "below" | "left"): void {
    this.#value = value;
    // Text being typed is not changed.
    if (document.activeElement !== this.element) this.#write();
    const width = CHARACTER * this.element.value.length + PADDING;
    const [left, top] = side === "below" ? [x - width / 2, y] : [x - width, y - HEIGHT / 2];
    const { style } = this.element;
    style.setProperty("width", rem(width));
    style.setProperty("transform", `translate(${rem(left)}, ${rem(top)})`);
  }

  #write(): void {
    const text = this.#value.toFixed(this.#digits);
    if (this.element.value !== text) this.element.value = text;
  }
}
