/** The tabs that select a panel on a narrow screen. */

import { TABS, type Tab } from "../../../link/play";
import { html, setAttributes } from "../../../ui/dom";
import { strings } from "../../strings/strings";

export class Tabs {
  readonly element: HTMLElement;
  readonly #buttons: Map<Tab, HTMLButtonElement>;

  constructor(onChange: (tab: Tab) => void) {
    this.#buttons = new Map(
      TABS.map((tab) => [tab, html("button", { type: "button", class: "tab" }, strings.play.tabs[tab])]),
    );
    for (const [tab, button] of this.#buttons) button.addEventListener("click", () => onChange(tab));
    this.element = html("nav", { class: "tabs", "aria-label": strings.play.tabs.name }, ...this.#buttons.values());
  }

  show(chosen: Tab): void {
    for (const [tab, button] of this.#buttons) setAttributes(button, { "aria-current": tab === chosen && "true" });
  }
}
