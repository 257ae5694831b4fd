/** The table of clips: a virtual list, in which only visible rows are in the page, so that it can have thousands. */

import { formatNumber, html, setAttributes, setText } from "../../../ui/dom";
import { isNarrow, textZoom } from "../../../ui/media";
import { strings } from "../../strings/strings";
import { type KnownSkeleton, type LabelField, obstacle, type Row } from "./corpus";

/** Height of a row at a text size of 16 px, as in `clips.css`: one line, two on a narrow screen; pixels. */
const ROW = { wide: 30, narrow: 92 };
/** Rows above and below the visible ones that are in the page too. */
const MARGIN = 6;

/** Maximum number of names that the label fields suggest. */
const MAX_SUGGESTED = 200;

const words = strings.data.list;

interface ClipListListeners {
  onSelect: (row: Row) => void;
  onEdit: (row: Row, field: LabelField, value: string) => void;
}

interface ShownRow {
  element: HTMLElement;
  file: HTMLButtonElement;
  inputs: Record<LabelField, HTMLInputElement>;
  length: HTMLElement;
  rate: HTMLElement;
  note: HTMLElement;
}

export class ClipList {
  readonly element: HTMLElement;
  readonly #table: HTMLElement;
  readonly #body = html("div", { role: "rowgroup", class: "clip-rows" });
  readonly #actions = html("datalist", { id: "actions" });
  readonly #styles = html("datalist", { id: "styles" });
  readonly #listeners: ClipListListeners;
  /** The elements of the rows in the page. A row of another clip is another object, even with the same index. */
  readonly #shown = new Map<Row, ShownRow>();
  #rows: readonly Row[] = [];
  #skeletons: readonly KnownSkeleton[] = [];
  #selected: number | undefined;
  #asked = 0;
  readonly #resized: ResizeObserver;
  /** Position and height of the visible part, pixels: measured only when they change, because measuring causes a layout. */
  #top = 0;
  #height = 0;

  constructor(listeners: ClipListListeners) {
    this.#listeners = listeners;
    const head = Object.values(words.columns).map((name) => html("span", { role: "columnheader" }, name));
    this.#table = html(
      "div",
      { role: "table", class: "clips", "aria-label": words.name },
      html("div", { role: "rowgroup" }, html("div", { role: "row", class: "clip-row clip-head" }, ...head)),
      this.#body,
    );
    this.element = html("div", { class: "clip-list" }, this.#table, this.#actions, this.#styles);
    const moved = () => {
      this.#top = this.element.scrollTop;
      this.#soon();
    };
    this.element.addEventListener("scroll", moved, { passive: true });
    this.#resized = new ResizeObserver(([entry]) => {
      this.#height = entry!.contentRect.height;
      moved();
    });
    this.#resized.observe(this.element);
  }

  dispose(): void {
    this.#resized.disconnect();
    cancelAnimationFrame(this.#asked);
  }

  /** Shows these rows; `names` are the suggestions of the label fields. */
  show(
    rows: readonly Row[],
    skeletons: readonly KnownSkeleton[],
    selected: number | undefined,
    names: { actions: readonly string[]; styles: readonly string[] },
  ): void {
    this.#rows = rows;
    this.#skeletons = skeletons;
    this.#selected = selected;
    for (const [list, values] of [
      [this.#actions, names.actions],
      [this.#styles, names.styles],
    ] as const)
      suggest(list, values.slice(0, MAX_SUGGESTED));
    setAttributes(this.#table, { "aria-rowcount": rows.length + 1 });
    this.#fill();
  }

  #soon(): void {
    cancelAnimationFrame(this.#asked);
    this.#asked = requestAnimationFrame(() => this.#fill());
  }

  /** Adds the visible rows to the page and removes the others. */
  #fill(): void {
    const height = (isNarrow() ? ROW.narrow : ROW.wide) * textZoom();
    this.#body.style.height = `${height * this.#rows.length}px`;
    const first = Math.max(0, Math.floor(this.#top / height) - MARGIN);
    const last = Math.min(this.#rows.length, first + Math.ceil(this.#height / height) + 2 * MARGIN);
    const wanted = new Map<Row, number>();
    for (let i = first; i < last; i++) wanted.set(this.#rows[i]!, i);
    for (const [row, { element }] of this.#shown) {
      if (wanted.has(row)) continue;
      element.remove();
      this.#shown.delete(row);
    }
    for (const [row, place] of wanted) {
      const shown = this.#shown.get(row) ?? this.#make(row);
      if (!this.#shown.has(row)) this.#body.append(shown.element);
      this.#shown.set(row, shown);
      shown.element.style.transform = `translateY(${place * height}px)`;
      setAttributes(shown.element, { "aria-rowindex": place + 2 });
      this.#update(shown, row);
    }
  }

  #make(row: Row): ShownRow {
    const file = html("button", { type: "button", class: "clip-file", title: row.path });
    file.append(html("bdi", {}, row.path.slice(row.path.lastIndexOf("/") + 1)));
    file.addEventListener("click", () => this.#listeners.onSelect(row));
    const input = (field: LabelField, attributes: Record<string, string>) => {
      const made = html("input", { type: "text", "aria-label": words.field[field](row.path), ...attributes });
      made.addEventListener("change", () => this.#listeners.onEdit(row, field, made.value));
      return made;
    };
    const inputs = {
      action: input("action", { list: "actions" }),
      style: input("style", { list: "styles" }),
      take: input("take", { inputmode: "numeric" }),
    };
    const cell = (name: string, ...children: Node[]) => html("span", { role: "cell", class: name }, ...children);
    const [length, rate, note] = [cell("clip-length"), cell("clip-rate"), cell("clip-note")];
    const element = html(
      "div",
      { role: "row", class: "clip-row" },
      cell("clip-name", file),
      cell("clip-action", inputs.action),
      cell("clip-style", inputs.style),
      cell("clip-take", inputs.take),
      length,
      rate,
      note,
    );
    return { element, file, inputs, length, rate, note };
  }

  #update({ element, file, inputs, length, rate, note }: ShownRow, row: Row): void {
    const reason = obstacle(row, this.#skeletons);
    element.classList.toggle("unusable", reason !== "");
    setAttributes(file, { "aria-pressed": String(row.index === this.#selected) });
    for (const field of ["action", "style", "take"] as const) {
      const text = String(row[field] ?? "");
      if (document.activeElement !== inputs[field] && inputs[field].value !== text) inputs[field].value = text;
    }
    const { read } = row;
    setText(length, read ? words.seconds(formatNumber(read.frames / read.rateHz, 1)) : "");
    setText(rate, read ? words.hertz(formatNumber(read.rateHz, 0)) : "");
    const text = reason || this.#skeletonNote(row);
    setText(note, text);
    setAttributes(note, { title: text });
  }

  /** The skeleton of a clip, if the clips have several. */
  #skeletonNote({ read }: Row): string {
    const skeleton = read && this.#skeletons.length > 1 ? this.#skeletons[read.skeleton] : undefined;
    return skeleton ? words.skeleton(read!.skeleton + 1, skeleton.joints.length) : "";
  }
}

/** Updates a list of suggestions if it differs. */
function suggest(list: HTMLDataListElement, values: readonly string[]): void {
  const same = list.options.length === values.length && values.every((value, i) => list.options[i]!.value === value);
  if (!same) list.replaceChildren(...values.map((value) => html("option", { value })));
}
