/** The panel of the field: its vertices, the selected one's reach and intensity, and styles to add. */

import { type FieldVertex, MAX_VERTICES } from "../../../client/crowd/limits";
import { button } from "../../../ui/controls/buttons";
import { icon } from "../../../ui/controls/icons";
import { Slider } from "../../../ui/controls/slider";
import { formatNumber, html, keepCount, setAttributes, setText } from "../../../ui/dom";
import { CROWD_RANGES, type CrowdKind } from "../../state/crowd";
import { strings } from "../../strings/strings";
import { spoken } from "../../ui/words";
import type { StyleColours } from "./colours";
import type { FieldEditor } from "./field_editor";

const words = strings.crowd;

export class FieldPanel {
  readonly element: HTMLElement;
  readonly #colours: StyleColours;
  readonly #editor: FieldEditor;
  readonly #rows = html("ul", { class: "crowd-rows" });
  readonly #head: HTMLElement;
  readonly #reach: Slider;
  readonly #intensity: Slider;
  readonly #remove: HTMLButtonElement;
  readonly #add = html("select", { "aria-label": words.styleToAdd });
  readonly #addBox: HTMLElement;
  readonly #note = html("p", { class: "caption" });
  #chosen = 0;
  #styles: readonly string[] = [];

  constructor(colours: StyleColours, editor: FieldEditor) {
    this.#colours = colours;
    this.#editor = editor;
    const { onSettle } = editor.gestures;
    const slider = (name: string, key: "reach" | "intensity", initial: number) =>
      new Slider(name, CROWD_RANGES[key], initial, {
        onInput: (value) => editor.change(this.#chosen, { [key]: value }),
        onSettle,
      });
    this.#reach = slider(words.reach, "reach", 3);
    this.#reach.words = (value) => words.metres(formatNumber(value, 1));
    this.#intensity = slider(words.intensity, "intensity", 1);
    this.#remove = button(words.removeStyle, () => editor.remove(this.#chosen), { icon: "remove" });
    this.#add.addEventListener("change", () => {
      const style = this.#add.value;
      this.#add.value = "";
      if (style !== "") editor.add(style);
    });
    this.#addBox = html("div", { class: "select crowd-add" }, this.#add, icon("chevron"));
    const reset = button(words.reset, () => editor.reset(), { label: true, class: "plain" });
    this.#head = html(
      "p",
      { class: "crowd-head caption", "aria-hidden": "true" },
      html("span", {}, words.style),
      html("span", {}, words.reach),
      html("span", {}, words.intensity),
    );
    this.element = html(
      "section",
      { class: "crowd-section", "aria-labelledby": "crowd-field-heading" },
      html("div", { class: "section-heading" }, html("h2", { id: "crowd-field-heading" }, words.field), reset),
      this.#head,
      this.#rows,
      this.#reach.element,
      this.#intensity.element,
      html("div", { class: "row crowd-add-row" }, this.#addBox, this.#remove, this.#note),
    );
  }

  /** Sets the styles of the model. */
  setStyles(styles: readonly string[]): void {
    if (styles.join() === this.#styles.join()) return;
    this.#styles = styles;
    const none = html("option", { value: "" }, words.addStyle);
    this.#add.replaceChildren(none, ...styles.map((style) => html("option", { value: style }, spoken(style))));
  }

  show(kind: CrowdKind, field: readonly FieldVertex[], chosen: number): void {
    this.#chosen = chosen;
    keepCount(this.#rows, field.length, () => this.#makeRow());
    for (const [i, { style, reach, intensity }] of field.entries()) {
      const row = this.#rows.children[i]!.firstElementChild as HTMLElement;
      const [dot, name, metres, factor] = row.children;
      (dot as HTMLElement).style.setProperty("--colour", this.#colours.of(style));
      setText(name!, spoken(style));
      setText(metres!, words.metres(formatNumber(reach, 1)));
      setText(factor!, formatNumber(intensity, 2));
      setAttributes(row, { "aria-pressed": String(i === chosen), title: words.choose(spoken(style)) });
    }
    const vertex = field[chosen];
    this.#head.hidden = field.length === 0;
    for (const { element } of [this.#reach, this.#intensity]) element.hidden = vertex === undefined;
    this.#remove.hidden = vertex === undefined;
    this.#add.disabled = field.length >= MAX_VERTICES || this.#styles.length === 0;
    if (vertex) {
      this.#reach.value = vertex.reach;
      this.#intensity.value = vertex.intensity;
      this.#remove.setAttribute("aria-label", `${words.removeStyle}: ${spoken(vertex.style)}`);
    }
    setText(this.#note, vertex ? words.of[kind].elsewhere : words.of[kind].empty);
  }

  #makeRow(): HTMLElement {
    const row = html(
      "button",
      { type: "button", class: "crowd-row" },
      html("i", { class: "crowd-dot" }),
      html("span"),
      html("span", { class: "value" }),
      html("span", { class: "value" }),
    );
    const item = html("li", {}, row);
    row.addEventListener("click", () => this.#editor.choose([...this.#rows.children].indexOf(item)));
    return item;
  }
}
