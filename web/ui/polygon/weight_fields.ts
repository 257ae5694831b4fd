/**
 * The weights of the selected styles as number fields: the polygon for keyboards and screen readers, since one slider
 * cannot announce two dimensions. They are visible while one of them has the focus.
 */

import { parseTyped } from "../controls/dial";
import { formatNumber, html } from "../dom";
import { strings } from "../strings";
import type { StyleWeight } from "./selection";

/** Weights beyond the polygon can only be set by dragging. */
const RANGE = { min: 0, max: 1, digits: 2, scale: "linear" } as const;

export class WeightFields {
  readonly element = html("div", {
    class: "polygon-weights",
    role: "group",
    "aria-label": strings.polygon.weights,
  });
  readonly #onChange: (name: string, weight: number) => void;
  #fields: { name: string; input: HTMLInputElement }[] = [];

  /** `onChange` is called with a typed weight, 0–1. */
  constructor(onChange: (name: string, weight: number) => void) {
    this.#onChange = onChange;
  }

  /** Shows styles and their weights; a single style has weight 1 and no field. */
  show(styles: readonly StyleWeight[]): void {
    const shown = styles.length > 1 ? styles : [];
    if (shown.map(({ name }) => name).join("\n") !== this.#fields.map(({ name }) => name).join("\n"))
      this.#build(shown);
    for (const [i, { input }] of this.#fields.entries()) {
      const text = formatNumber(shown[i]!.weight, RANGE.digits);
      input.defaultValue = text;
      // Text being typed is not changed.
      if (!input.matches(":focus")) input.value = text;
    }
  }

  #build(styles: readonly StyleWeight[]): void {
    this.#fields = styles.map(({ name }) => ({ name, input: this.#field(name) }));
    this.element.replaceChildren(
      ...this.#fields.map(({ name, input }) => html("label", {}, html("span", {}, name), input)),
    );
  }

  #field(name: string): HTMLInputElement {
    const input = html("input", { type: "text", inputmode: "decimal" });
    input.addEventListener("focus", () => input.select());
    input.addEventListener("change", () => {
      const weight = parseTyped(input.value, RANGE);
      if (weight !== undefined) this.#onChange(name, weight);
      input.value = input.defaultValue;
    });
    // Elsewhere, letters and digits are shortcuts of the page.
    input.addEventListener("keydown", (event) => {
      if (event.key !== "Tab" && event.key !== "Escape") event.stopPropagation();
    });
    return input;
  }
}
