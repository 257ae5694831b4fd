/** The classes of the clips: a row for every style, a column for every action, and the choice of the neutral style. */

import { html } from "../../../ui/dom";
import { strings } from "../../strings/strings";
import type { ClassTable } from "./corpus";

const words = strings.data.matrix;

/** A class by which the list is filtered. */
export interface ClassFilter {
  action: string;
  style: string;
}

interface MatrixListeners {
  onNeutral: (style: string) => void;
  /** Called with a filter; `undefined` shows all clips. */
  onFilter: (filter: ClassFilter | undefined) => void;
  onRename: (field: "action" | "style", from: string, to: string) => void;
}

export class Matrix {
  readonly element = html("div", { class: "matrix", tabindex: 0, role: "region", "aria-label": words.name });
  readonly #listeners: MatrixListeners;
  /** The displayed contents, so that the page changes only if they differ. */
  #shown = "";

  constructor(listeners: MatrixListeners) {
    this.#listeners = listeners;
  }

  show(table: ClassTable, neutral: string, filter: ClassFilter | undefined): void {
    const { actions, styles } = table;
    const counts = styles.map((style) => actions.map((action) => table.count(action, style)));
    const wanted = JSON.stringify([actions, styles, counts, neutral, filter]);
    if (wanted === this.#shown) return;
    this.#shown = wanted;
    const head = html(
      "tr",
      {},
      html("th", { scope: "col" }, words.style),
      html("th", { scope: "col", class: "neutral" }, words.neutral),
      ...actions.map((action) => html("th", { scope: "col", class: "number" }, this.#name("action", action))),
    );
    const rows = styles.map((style) =>
      html(
        "tr",
        {},
        html("th", { scope: "row" }, this.#name("style", style)),
        html("td", { class: "neutral" }, this.#radio(style, style === neutral)),
        ...actions.map((action) => this.#cell(action, style, table.count(action, style), filter)),
      ),
    );
    const focused = this.element.contains(document.activeElement) && document.activeElement?.getAttribute("aria-label");
    this.element.replaceChildren(html("table", {}, html("thead", {}, head), html("tbody", {}, ...rows)));
    // The focused element was replaced.
    if (focused) this.element.querySelector<HTMLElement>(`[aria-label="${CSS.escape(focused)}"]`)?.focus();
  }

  /** A text field with a name; changing it renames the action or the style everywhere. */
  #name(field: "action" | "style", name: string): HTMLElement {
    const input = html("input", {
      type: "text",
      class: "class-name",
      value: name,
      title: name,
      size: Math.max(4, name.length),
      "aria-label": words.rename[field](name),
    });
    input.addEventListener("change", () => {
      const to = input.value.trim();
      if (to === "" || to === name) input.value = name;
      else this.#listeners.onRename(field, name, to);
    });
    input.addEventListener("keydown", (event) => {
      if (event.key === "Enter") input.blur();
      else if (event.key === "Escape") input.value = name;
    });
    return input;
  }

  #cell(action: string, style: string, count: number, filter: ClassFilter | undefined): HTMLElement {
    if (count === 0) return html("td", { class: "number missing" }, "–");
    const pressed = filter?.action === action && filter.style === style;
    const button = html(
      "button",
      {
        type: "button",
        class: "button cell",
        "aria-pressed": String(pressed),
        "aria-label": words.cell(action, style, count),
      },
      String(count),
    );
    button.addEventListener("click", () => this.#listeners.onFilter(pressed ? undefined : { action, style }));
    return html("td", { class: "number" }, button);
  }

  #radio(style: string, checked: boolean): HTMLElement {
    const radio = html("input", { type: "radio", name: "neutral", "aria-label": words.isNeutral(style), checked });
    radio.addEventListener("change", () => this.#listeners.onNeutral(style));
    return html("label", { class: "target" }, radio);
  }
}
