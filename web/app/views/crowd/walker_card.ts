/** The card of a walker: its speed, its styles, and actions. */

import { button } from "../../../ui/controls/buttons";
import { formatNumber, html, keepCount, setText } from "../../../ui/dom";
import type { CrowdKind } from "../../state/crowd";
import { strings } from "../../strings/strings";

const words = strings.crowd;

interface CardListeners {
  onFollow: () => void;
  onExport: () => void;
  onOpen: () => void;
  onClose: () => void;
}

/** Contents of the card. */
interface CardModel {
  kind: CrowdKind;
  walker: number;
  /** m/s. */
  speed: number;
  /** Styles, including the average, and their weights, 0 to 1. */
  shares: readonly { name: string; share: number }[];
  follows: boolean;
}

export class WalkerCard {
  readonly element: HTMLElement;
  readonly #title = html("h2");
  readonly #speed = html("span", { class: "caption" });
  readonly #bars = html("dl", { class: "crowd-bars" });
  readonly #follow: HTMLButtonElement;
  readonly #export: HTMLButtonElement;
  readonly #open: HTMLButtonElement;

  constructor(listeners: CardListeners) {
    this.#follow = button(words.follow, listeners.onFollow, { icon: "follow", label: true, class: "outlined" });
    this.#export = button(words.exportBvh, listeners.onExport, { icon: "export", label: true, class: "outlined" });
    this.#open = button(words.of.walkers.open, listeners.onOpen, { label: true, class: "crowd-open" });
    const close = button(words.close, listeners.onClose, { icon: "close" });
    this.element = html(
      "section",
      { class: "crowd-card", hidden: true },
      html("header", {}, this.#title, this.#speed, close),
      this.#bars,
      html("div", { class: "crowd-card-actions" }, this.#follow, this.#export),
      this.#open,
    );
  }

  /** Shows a walker's card, or hides it. */
  show(model: CardModel | undefined): void {
    this.element.hidden = model === undefined;
    if (!model) return;
    const { kind, walker, speed, shares, follows } = model;
    const name = words.of[kind].one(walker + 1);
    setText(this.#title, name);
    this.element.setAttribute("aria-label", name);
    setText(this.#speed, words.speed(formatNumber(speed, 2)));
    setText(this.#open.querySelector("span")!, words.of[kind].open);
    this.#follow.setAttribute("aria-pressed", String(follows));
    keepCount(this.#bars, shares.length, () =>
      html("div", {}, html("dt"), html("dd", {}, html("i"), html("span", { class: "value" }))),
    );
    for (const [i, { name, share }] of shares.entries()) {
      const row = this.#bars.children[i]!;
      setText(row.querySelector("dt")!, name);
      setText(row.querySelector("span")!, formatNumber(share, 2));
      row.querySelector("i")!.style.setProperty("--share", share.toFixed(3));
    }
  }

  /** Whether a file is being exported. */
  set exporting(exporting: boolean) {
    this.#export.disabled = exporting;
  }
}
