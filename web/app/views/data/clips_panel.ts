/** The open clips of the Data view: the heading, the pattern of the names, the classes, and the table. */

import { button } from "../../../ui/controls/buttons";
import { html, setText } from "../../../ui/dom";
import { strings } from "../../strings/strings";
import { ProgressLine } from "../../ui/progress";
import type { ClipCollection } from "./clip_collection";
import "./clips.css";
import { ClipList } from "./clip_list";
import { type ClassTable, classTable, obstacle, type Row } from "./corpus";
import { type ClassFilter, Matrix } from "./matrix";

const words = strings.data;

/** Filter of the table. */
type Filter = ClassFilter | "left out" | undefined;

interface ClipsPanelListeners {
  /** Called when files, or a folder, are to be chosen. */
  onAddFiles: () => void;
  onAddFolder: () => void;
  onClear: () => void;
  onPattern: (pattern: string) => void;
  onSelect: (row: Row) => void;
}

export class ClipsPanel {
  readonly element: HTMLElement;
  readonly progress = new ProgressLine();
  readonly #heading = html("h1", { class: "page-title" });
  readonly #summary = html("p", { class: "caption data-summary" });
  readonly #pattern = html("input", { type: "text", class: "text", "aria-label": words.names.pattern });
  readonly #labelNote = html("p", { class: "caption", role: "status" });
  readonly #leftOut: HTMLButtonElement;
  readonly #matrix: Matrix;
  readonly #list: ClipList;
  readonly #clips: ClipCollection;
  #filter: Filter;
  #selected: number | undefined;

  constructor(clips: ClipCollection, listeners: ClipsPanelListeners) {
    this.#clips = clips;
    this.#matrix = new Matrix({
      onNeutral: (style) => {
        clips.edits.setNeutral(style);
      },
      onFilter: (filter) => this.#narrow(filter),
      onRename: (field, from, to) => clips.rename(field, from, to),
    });
    this.#list = new ClipList({
      onSelect: listeners.onSelect,
      onEdit: (row, field, value) => clips.edit(row, field, value),
    });
    this.#leftOut = button(words.leftOut, () => this.#narrow(this.#filter === "left out" ? undefined : "left out"), {
      label: true,
    });
    this.#pattern.addEventListener("change", () => listeners.onPattern(this.#pattern.value.trim()));
    const actions = html(
      "div",
      { class: "data-actions" },
      button(words.add.clear, listeners.onClear, { label: true }),
      button(words.add.files, listeners.onAddFiles, { icon: "drop", label: true, class: "outlined" }),
      button(words.add.folder, listeners.onAddFolder, { icon: "folder", label: true, class: "outlined" }),
    );
    this.element = html(
      "div",
      { class: "data-clips" },
      this.progress.element,
      html("header", { class: "data-heading" }, html("div", {}, this.#heading, this.#summary), actions),
      html(
        "div",
        { class: "data-names" },
        html("label", { class: "row" }, html("span", { class: "label" }, words.names.label), this.#pattern),
        this.#labelNote,
        this.#leftOut,
      ),
      this.#matrix.element,
      this.#list.element,
    );
  }

  dispose(): void {
    this.progress.cancel();
    this.#list.dispose();
  }

  /** Index of the clip in the preview. */
  set selected(index: number | undefined) {
    this.#selected = index;
    this.#showList(classTable(this.#clips.usable));
  }

  /** Shows other clips, scrolled to the top. */
  reset(): void {
    this.#filter = undefined;
    this.#selected = undefined;
  }

  show(usable: readonly Row[], classes: ClassTable): void {
    const { rows, neutral, pattern, labelNote } = this.#clips;
    const left = rows.length - usable.length;
    setText(this.#heading, words.heading(usable.length, classes.styles.length));
    const sources = new Set(rows.map(({ path }) => path.slice(0, path.indexOf("/")) || path));
    const [source = ""] = sources;
    setText(
      this.#summary,
      words.summary(classes.actions.length, sources.size === 1 ? source : words.sources(sources.size)),
    );
    if (document.activeElement !== this.#pattern) this.#pattern.value = pattern;
    setText(this.#labelNote, labelNote);
    this.#leftOut.hidden = left === 0;
    setText(this.#leftOut.firstElementChild!, words.leftOutCount(left));
    this.#leftOut.setAttribute("aria-pressed", String(this.#filter === "left out"));
    this.#matrix.show(classes, neutral, this.#filter === "left out" ? undefined : this.#filter);
    this.#showList(classes);
  }

  /** Filters the table of clips by a class, and scrolls it into view. */
  reveal(of: ClassFilter): void {
    this.#narrow(of);
    this.#list.element.scrollIntoView({ block: "nearest" });
  }

  #narrow(filter: Filter): void {
    this.#filter = filter;
    this.#list.element.scrollTop = 0;
    const { usable } = this.#clips;
    this.show(usable, classTable(usable));
  }

  #showList(names: ClassTable): void {
    const filter = this.#filter;
    const { rows, skeletons } = this.#clips;
    const shown = rows.filter((row) => {
      if (filter === undefined) return true;
      if (filter === "left out") return obstacle(row, skeletons) !== "";
      return row.action === filter.action && row.style === filter.style;
    });
    this.#list.element.classList.toggle("left-out", filter === "left out");
    this.#list.show(shown, skeletons, this.#selected, names);
  }
}
