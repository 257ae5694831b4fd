/** Controls that several kinds of figures have. */
import { icon } from "../../ui/controls/icons";
import { html } from "../../ui/dom";

/** A list to choose from. */
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
