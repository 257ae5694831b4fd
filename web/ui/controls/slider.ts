/** A labelled slider based on `<input type="range">` with its value next to it and a tick at the default. */

import { formatNumber, html } from "../dom";
import type { Range } from "./range";
import { rangeInput } from "./range_input";

export class Slider {
  readonly element: HTMLElement;
  readonly #input: HTMLInputElement;
  readonly #value: HTMLOutputElement;
  readonly #range: Range;
  readonly #track: HTMLElement;

  constructor(
    name: string,
    range: Range,
    initial: number,
    listeners: { onInput: (value: number) => void; onSettle: () => void },
  ) {
    this.#range = range;
    const step = 10 ** -range.digits;
    this.#input = rangeInput({ min: range.min, max: range.max, step, "aria-label": name });
    // The slider announces both itself.
    this.#value = html("output", { class: "value", "aria-hidden": "true" });
    this.#track = html("div", { class: "slider-track" }, this.#input);
    this.#track.style.setProperty("--default", String((initial - range.min) / (range.max - range.min)));
    this.element = html(
      "div",
      { class: "row slider" },
      html("span", { class: "label", "aria-hidden": "true" }, name),
      this.#track,
      this.#value,
    );
    this.#input.addEventListener("input", () => listeners.onInput(Number(this.#input.value)));
    this.#input.addEventListener("change", () => listeners.onSettle());
    this.#input.addEventListener("dblclick", () => {
      listeners.onInput(initial);
      listeners.onSettle();
    });
  }

  /** Converts values to text instead of bare numbers. */
  words: ((value: number) => string) | undefined;

  /** Marks the plausible part of the range. */
  set plausible(plausible: { min: number; max: number }) {
    const { min, max } = this.#range;
    const share = (value: number) => String(Math.min(1, Math.max(0, (value - min) / (max - min))));
    this.#track.style.setProperty("--min", share(plausible.min));
    this.#track.style.setProperty("--max", share(plausible.max));
    this.#track.classList.add("ranged");
  }

  set value(value: number) {
    this.#input.value = String(value);
    const share = (value - this.#range.min) / (this.#range.max - this.#range.min);
    this.#input.style.setProperty("--share", String(Math.min(1, Math.max(0, share))));
    const said = this.words?.(value) ?? formatNumber(value, this.#range.digits);
    this.#value.value = said;
    this.#input.setAttribute("aria-valuetext", said);
  }
}
