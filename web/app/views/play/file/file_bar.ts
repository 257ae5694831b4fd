/** The bar about a dropped input: its length and rate, how it was read, its trim, and its removal. */
import "./file_bar.css";
import type { FrameRange, InputInfo } from "../../../../client/protocol";
import { button } from "../../../../ui/controls/buttons";
import { formatNumber, html, setAttributes, setText } from "../../../../ui/dom";
import { strings } from "../../../strings/strings";
import { type Edge, trimOf, trimSecs, withEdge } from "../timeline/trim";
import { fileWords as words } from "./strings.en";

interface FileListeners {
  /** Called when the panel with the file's reading is to be opened or closed. */
  onReading: () => void;
  /** Called when the trim changes; `undefined` is the whole clip. */
  onRange: (range: FrameRange | undefined) => void;
  onRemove: () => void;
}

export class FileBar {
  readonly element: HTMLElement;
  /** Opens the panel that shows how the file was read. */
  readonly howRead: HTMLButtonElement;
  readonly #name = html("span", { class: "file-name" });
  readonly #facts = html("span", { class: "caption file-facts" });
  readonly #trimmed = html("span", { class: "caption file-trimmed" });
  readonly #kept = html("span", { class: "caption file-kept" });
  readonly #fields: Record<Edge, HTMLInputElement>;
  readonly #whole: HTMLButtonElement;
  readonly #listeners: FileListeners;
  #input: InputInfo | undefined;
  #range: FrameRange | undefined;

  constructor(listeners: FileListeners) {
    this.#listeners = listeners;
    this.howRead = button(words.howRead, listeners.onReading, { label: true, class: "outlined how-read" });
    this.howRead.setAttribute("aria-haspopup", "dialog");
    this.reading = false;
    this.#fields = { first: this.#field("first", words.from), last: this.#field("last", words.to) };
    this.#whole = button(words.whole, () => listeners.onRange(undefined), { label: true, class: "plain" });
    this.#whole.title = words.wholeWhy;
    const remove = button(words.remove, listeners.onRemove, { icon: "remove", label: true, class: "file-remove" });
    remove.title = words.removeWhy;
    remove.setAttribute("aria-label", words.removeWhy);
    const caption = (text: string) => html("span", { class: "caption", "aria-hidden": "true" }, text);
    this.element = html(
      "section",
      { class: "file-bar", "aria-labelledby": "file-heading", hidden: true },
      html("h2", { id: "file-heading" }, words.heading),
      html("div", { class: "file-about" }, this.#name, this.#facts, this.#trimmed),
      this.howRead,
      html(
        "div",
        { class: "file-trim", role: "group", "aria-label": words.trim },
        html("span", { class: "file-label", "aria-hidden": "true" }, words.trim),
        this.#fields.first,
        caption(words.between),
        this.#fields.last,
        caption(words.unit),
        this.#kept,
        this.#whole,
      ),
      remove,
    );
  }

  /** The open input and its name in the list; `undefined` if it is no dropped file. */
  show(file: { name: string; input: InputInfo } | undefined): void {
    this.element.hidden = !file;
    this.#input = file?.input;
    if (!file) return;
    const { input, name } = file;
    const { reading, note } = input;
    setText(this.#name, name);
    this.#name.title = name;
    const rate = reading?.rateHz ?? input.rateHz;
    setText(this.#facts, words.facts(formatNumber(input.durationSecs, 2), String(Math.round(100 * rate) / 100)));
    const count = reading?.guesses.length ?? 0;
    this.howRead.hidden = !reading;
    this.howRead.title = note;
    this.howRead.classList.toggle("guessed", count > 0);
    this.howRead.lastElementChild?.replaceChildren(count > 0 ? words.guesses(count) : words.howRead);
    this.#showTrim();
  }

  /** The trim; `undefined` is the whole clip. */
  set range(range: FrameRange | undefined) {
    this.#range = range;
    this.#showTrim();
  }

  /** Whether the panel with the file's reading is open. */
  set reading(open: boolean) {
    setAttributes(this.howRead, { "aria-expanded": String(open) });
  }

  #showTrim(): void {
    const input = this.#input;
    if (!input) return;
    const trim = trimOf(this.#range, input.frames);
    const secs = (frame: number) => formatNumber(frame / input.rateHz, 2);
    for (const edge of ["first", "last"] as const) this.#fields[edge].value = (trim[edge] / input.rateHz).toFixed(2);
    const [from, to, kept] = [secs(trim.first), secs(trim.last), formatNumber(trimSecs(this.#range, input), 2)];
    setText(this.#kept, this.#range ? strings.play.trim.kept(kept) : "");
    setText(this.#trimmed, this.#range ? words.trimmed(from, to, kept) : "");
    this.#whole.hidden = !this.#range;
    this.element.classList.toggle("trimmed", this.#range !== undefined);
  }

  #field(edge: Edge, label: string): HTMLInputElement {
    const field = html("input", {
      type: "number",
      class: "text number",
      step: "any",
      inputmode: "decimal",
      "aria-label": label,
    });
    field.addEventListener("change", () => {
      const input = this.#input;
      const secs = field.valueAsNumber;
      if (input && Number.isFinite(secs))
        this.#listeners.onRange(withEdge(this.#range, edge, secs * input.rateHz, input.frames));
      // A value beyond the clip, or none, does not stay.
      this.#showTrim();
    });
    return field;
  }
}
