/** Bimodal styles: the clips of each cluster, and a button that splits them into two styles. */

import { button } from "../../../ui/controls/buttons";
import { html } from "../../../ui/dom";
import { strings } from "../../strings/strings";
import type { Row } from "./corpus";
import { clipsInWords, fileName, type Manners } from "./manners";

const words = strings.data.manners;

interface MannersPanelListeners {
  /** Called when the clips of a style are to be listed. */
  onShow: (found: Manners) => void;
  onDivide: (found: Manners) => void;
}

export class MannersPanel {
  readonly element: HTMLElement;
  readonly #list = html("ul", { class: "manners" });
  readonly #listeners: MannersPanelListeners;
  /** The displayed contents, so that the page changes only if they differ. */
  #shown = "";

  constructor(listeners: MannersPanelListeners) {
    this.#listeners = listeners;
    this.element = html(
      "section",
      { class: "section", "aria-labelledby": "manners-heading", hidden: true },
      html("div", { class: "section-heading" }, html("h2", { id: "manners-heading" }, words.heading)),
      html("p", { class: "caption" }, words.note),
      this.#list,
    );
  }

  show(all: readonly Manners[]): void {
    const wanted = JSON.stringify(all);
    if (wanted === this.#shown) return;
    this.#shown = wanted;
    this.element.hidden = all.length === 0;
    this.#list.replaceChildren(...all.map((found) => this.#item(found)));
  }

  #item(found: Manners): HTMLElement {
    const { action, style } = found;
    const [first, second] = found.rows.map(clips);
    const show = button(words.show, () => this.#listeners.onShow(found), { label: true });
    const divide = button(words.divide, () => this.#listeners.onDivide(found), { label: true, class: "outlined" });
    for (const [made, does] of [
      [show, words.show],
      [divide, words.divide],
    ] as const)
      made.setAttribute("aria-label", words.does(does, action, style));
    return html(
      "li",
      {},
      html("p", {}, words.differ(action, style)),
      html("p", { class: "manner-clips" }, first!, html("span", { class: "caption" }, words.and), second!),
      html("div", { class: "data-actions" }, show, divide),
    );
  }
}

/** The clips of a cluster, with a tooltip of their files. */
function clips(rows: readonly Row[]): HTMLElement {
  return html("span", { title: rows.map(({ path }) => fileName(path)).join("\n") }, clipsInWords(rows));
}
