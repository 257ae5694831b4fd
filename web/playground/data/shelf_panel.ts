/** The databases of this device: opened, exported, deleted. */
import { button } from "../controls/buttons";
import { html, setText } from "../dom";
import { megabytes } from "../numerals";
import { strings } from "../strings/strings";
import type { Shelved } from "./shelf";

const words = strings.data.shelf;

export interface ShelfListeners {
  onOpen: (database: Shelved) => void;
  onBuiltIn: () => void;
  onExport: (database: Shelved) => void;
  onDelete: (database: Shelved) => void;
}

export class ShelfPanel {
  readonly element: HTMLElement;
  readonly #list = html("ul", { class: "shelf" });
  readonly #note = html("p", { class: "caption" });
  readonly #listeners: ShelfListeners;

  constructor(listeners: ShelfListeners) {
    this.#listeners = listeners;
    this.element = html(
      "section",
      { class: "section", "aria-labelledby": "shelf-heading" },
      html("div", { class: "section-heading" }, html("h2", { id: "shelf-heading" }, words.heading)),
      this.#list,
      this.#note,
    );
  }

  /** Lists them; `open` is the name of the playground's, empty for the built-in one. */
  show(databases: readonly Shelved[], open: string): void {
    this.#list.replaceChildren(this.#builtIn(open === ""), ...databases.map((d) => this.#item(d, d.name === open)));
    setText(this.#note, databases.length > 0 ? words.kept : words.none);
  }

  #builtIn(isOpen: boolean): HTMLElement {
    const open = button(words.open, this.#listeners.onBuiltIn, { label: true, class: "outlined" });
    return item(words.builtIn, words.comesAlong, isOpen, [open]);
  }

  #item(database: Shelved, isOpen: boolean): HTMLElement {
    const { name, styles, clips, file } = database;
    const open = button(words.open, () => this.#listeners.onOpen(database), { label: true, class: "outlined" });
    const save = button(words.export, () => this.#listeners.onExport(database), { icon: "export" });
    const remove = button(words.delete, () => this.#listeners.onDelete(database), { icon: "remove" });
    for (const [made, does] of [
      [open, words.open],
      [save, words.export],
      [remove, words.delete],
    ] as const)
      made.setAttribute("aria-label", words.does(does, name));
    const caption = words.contents(styles.length, clips, megabytes(file.size));
    return item(name, caption, isOpen, [save, remove, open]);
  }
}

function item(name: string, caption: string, isOpen: boolean, buttons: HTMLButtonElement[]): HTMLElement {
  const text = html(
    "div",
    { class: "shelf-words" },
    html("p", { class: "shelf-name", title: name }, html("bdi", {}, name)),
    html("p", { class: "caption" }, isOpen ? words.isOpen(caption) : caption),
  );
  return html("li", isOpen ? { "aria-current": "true" } : {}, text, ...buttons);
}
