/** Buttons, toggles and segmented controls based on native elements. */
import { html } from "../dom";
import { type IconName, icon } from "./icons";

/** A button with an icon, a label, or both; without a label the name is its accessible name and tooltip. */
export function button(
  name: string,
  onClick: () => void,
  options: { icon?: IconName; label?: boolean; class?: string; keys?: string } = {},
): HTMLButtonElement {
  const tooltip = options.keys ? `${name} (${options.keys})` : name;
  const made = html("button", { type: "button", class: `button ${options.class ?? ""}`.trim(), title: tooltip });
  if (options.icon) made.append(icon(options.icon));
  if (options.label) made.append(html("span", {}, name));
  else made.setAttribute("aria-label", name);
  // The tooltip would repeat the name.
  if (options.keys) made.setAttribute("aria-description", options.keys);
  made.addEventListener("click", onClick);
  return made;
}

/** A switch with its label. */
export class Toggle {
  readonly element: HTMLElement;
  readonly #button: HTMLButtonElement;

  constructor(name: string, onChange: (on: boolean) => void) {
    this.#button = html("button", { type: "button", role: "switch", class: "toggle", "aria-label": name });
    this.#button.addEventListener("click", () => onChange(this.#button.getAttribute("aria-checked") !== "true"));
    const label = html("span", { "aria-hidden": "true" }, name);
    label.addEventListener("click", () => this.#button.click());
    this.element = html("div", { class: "toggle-row" }, this.#button, label);
  }

  /** Its purpose: a tooltip, and a description for assistive technology. */
  set description(description: string) {
    this.element.title = description;
    this.#button.setAttribute("aria-description", description);
  }

  set on(on: boolean) {
    this.#button.setAttribute("aria-checked", String(on));
  }
}

/** Number of segments so far: each is a group of its own, whatever its label. */
let segments = 0;

/** A choice of one option out of a few, as radio buttons styled as segments. */
export class Segment<T extends string> {
  readonly element: HTMLElement;
  readonly #inputs = new Map<T, HTMLInputElement>();

  constructor(
    name: string,
    options: readonly { value: T; label: string; icon?: IconName }[],
    onChange: (value: T) => void,
  ) {
    const group = `segment-${++segments}`;
    this.element = html("div", { class: "segment", role: "radiogroup", "aria-label": name });
    for (const { value, label, icon: iconName } of options) {
      const input = html("input", { type: "radio", name: group, value });
      input.addEventListener("change", () => onChange(value));
      this.#inputs.set(value, input);
      const text = html("span", {}, label);
      this.element.append(html("label", {}, input, ...(iconName ? [icon(iconName)] : []), text));
    }
  }

  set value(value: T) {
    const input = this.#inputs.get(value);
    if (input) input.checked = true;
  }

  /** Changes the text of one option. */
  relabel(value: T, label: string): void {
    const text = this.#inputs.get(value)?.parentElement?.querySelector("span");
    if (text) text.textContent = label;
  }
}
