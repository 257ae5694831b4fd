/** The help dialog: what the keys do. */
import { button } from "../controls/buttons";
import { html } from "../dom";

const KEYS: readonly [keys: string, does: string][] = [
  ["Space", "play or pause"],
  ["← →", "one frame back or on"],
  ["Home End", "first or last frame"],
  ["L", "loop"],
  ["I O", "play from here, or to here; U plays all"],
  ["K", "style key here: styles change from key to key"],
  ["G", "ghost of the input: beside, in the same place, off"],
  ["T", "motion trail: lines, the body before and after, off"],
  ["F", "follow the character"],
  ["H", "hide or show the panels"],
  ["X", "the other of two settings, A or B"],
  ["R", "three styles by chance"],
  ["1 – 8", "all of one style, clockwise from the top"],
  ["Ctrl Z", "undo; with Shift redo"],
  ["?", "this help"],
];

const POLYGON: readonly [keys: string, does: string][] = [
  ["Drag", "mix the selected styles; with Shift also beyond them"],
  ["Click a corner", "select that style"],
  ["Double-click a corner", "all of it"],
  ["Arrow keys", "move the point; with Shift in small steps"],
  ["Tab, Enter, Delete", "visit, select and drop corners"],
];

const list = (rows: readonly [string, string][]) =>
  html("dl", {}, ...rows.flatMap(([keys, does]) => [html("dt", {}, keys), html("dd", {}, does)]));

export class Help {
  readonly element: HTMLDialogElement;

  constructor() {
    const close = button("Close", () => this.element.close(), { icon: "close", class: "plain" });
    this.element = html(
      "dialog",
      { class: "help", "aria-labelledby": "help-heading" },
      html("div", { class: "section-heading" }, html("h2", { id: "help-heading" }, "Keys"), close),
      list(KEYS),
      html("h3", {}, "The polygon"),
      list(POLYGON),
      html(
        "p",
        { class: "caption" },
        "Drop a BVH anywhere to style it. Knobs turn by dragging up and down; type a number for an exact value.",
      ),
    );
    this.element.addEventListener("click", (event) => {
      if (event.target === this.element) this.element.close();
    });
  }

  open(): void {
    if (!this.element.open) this.element.showModal();
  }
}
