/** Controls shared by several kinds of figures. */

import { icon } from "../ui/controls/icons";
import type { Range } from "../ui/controls/range";
import { html } from "../ui/dom";

/** A list of options. */
export class Choice<T extends string> {
  readonly element: HTMLElement;
  readonly #select: HTMLSelectElement;

  constructor(name: string, options: readonly (readonly [value: T, label: string])[], onChange: (value: T) => void) {
    this.#select = html("select", { "aria-label": name });
    for (const [value, label] of options) this.#select.append(html("option", { value }, label));
    this.#select.addEventListener("change", () => onChange(this.#select.value as T));
    this.element = html("div", { class: "select" }, this.#select, icon("chevron"));
  }

  set value(value: T) {
    this.#select.value = value;
  }
}

/** A field for a number computed by the learner. */
export class GuessField {
  readonly element: HTMLElement;
  readonly #field: HTMLInputElement;

  /**
   * @param range range to which a number is clamped
   * @param empty value of an empty field
   */
  constructor(
    name: string,
    { min, max }: Pick<Range, "min" | "max">,
    empty: number,
    onChange: (guess: number) => void,
    signal: AbortSignal,
  ) {
    this.#field = html("input", { class: "text-field", type: "text", inputmode: "decimal", "aria-label": name });
    const commit = () => {
      const text = this.#field.value.trim().replace(",", ".").replace("−", "-");
      const typed = Number(text);
      onChange(text === "" || !Number.isFinite(typed) ? empty : Math.min(max, Math.max(min, typed)));
    };
    this.#field.addEventListener("change", commit, { signal });
    this.#field.addEventListener("keydown", (event) => event.stopPropagation(), { signal });
    this.element = html("label", { class: "guess" }, html("span", {}, name), this.#field);
  }

  /** The displayed text, unless the learner is typing. */
  set text(text: string) {
    if (!this.#field.matches(":focus")) this.#field.value = text;
  }
}
