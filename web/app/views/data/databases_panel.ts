/** The databases of this device: open, export, delete and restore. */

import { button } from "../../../ui/controls/buttons";
import { html, setText } from "../../../ui/dom";
import { megabytes } from "../../strings/numerals";
import { strings } from "../../strings/strings";
import { RELOAD } from "../../ui/toasts";
import type { DeviceDatabases } from "./device_databases";
import type { SavedDatabase } from "./saved_databases";

const words = strings.data.saved;

interface DatabasesPanelListeners {
  onOpen: (database: SavedDatabase) => void;
  onOpenBuiltIn: () => void;
  onExport: (database: SavedDatabase) => void;
  onDelete: (database: SavedDatabase) => void;
  onRestore: (database: SavedDatabase) => void;
}

export class DatabasesPanel {
  readonly element: HTMLElement;
  readonly #list = html("ul", { class: "stored" });
  readonly #note = html("p", { class: "caption" });
  readonly #reload = button(RELOAD.label, RELOAD.act, { label: true, class: "outlined" });
  readonly #listeners: DatabasesPanelListeners;

  constructor(listeners: DatabasesPanelListeners) {
    this.#listeners = listeners;
    this.element = html(
      "section",
      { class: "section", "aria-labelledby": "databases-heading" },
      html("div", { class: "section-heading" }, html("h2", { id: "databases-heading" }, words.heading)),
      this.#list,
      this.#note,
      this.#reload,
    );
  }

  /**
   * Lists them. For the one used by Play, `name` is its stored name, and `file` the file from which it was opened; both
   * are empty for the built-in one.
   */
  show(databases: DeviceDatabases, { name, file }: { name: string; file: Blob | undefined }): void {
    const { all, deleted, fault, outdated } = databases;
    const items = all.map((database) => {
      const isKept = databases.isKept(database.name);
      return this.#item(database, isKept, isKept ? database.name === name : database.file === file);
    });
    this.#list.replaceChildren(
      this.#builtIn(file === undefined),
      ...items,
      ...deleted.map((database) => this.#deleted(database)),
    );
    this.#reload.hidden = !outdated;
    const kept = all.every((database) => databases.isKept(database.name)) ? words.kept : words.someUnkept;
    setText(this.#note, fault || (all.length > 0 ? kept : words.none));
  }

  #builtIn(isOpen: boolean): HTMLElement {
    const open = button(words.open, this.#listeners.onOpenBuiltIn, { label: true, class: "outlined" });
    open.setAttribute("aria-label", words.does(words.open, words.builtIn));
    return item(words.builtIn, words.comesAlong, isOpen, [open]);
  }

  #item(database: SavedDatabase, isKept: boolean, isOpen: boolean): HTMLElement {
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
    const contents = words.contents(styles.length, clips, megabytes(file.size));
    return item(name, isKept ? contents : words.unkept(contents), isOpen, [save, remove, open]);
  }

  #deleted(database: SavedDatabase): HTMLElement {
    const restore = button(words.restore, () => this.#listeners.onRestore(database), {
      label: true,
      class: "outlined",
    });
    restore.setAttribute("aria-label", words.does(words.restore, database.name));
    const made = item(database.name, words.deleted, false, [restore]);
    made.classList.add("deleted");
    return made;
  }
}

function item(name: string, caption: string, isOpen: boolean, buttons: HTMLButtonElement[]): HTMLElement {
  const text = html(
    "div",
    { class: "stored-words" },
    html("p", { class: "stored-name", title: name }, html("bdi", {}, name)),
    html("p", { class: "caption" }, isOpen ? words.isOpen(caption) : caption),
  );
  return html("li", isOpen ? { "aria-current": "true" } : {}, text, ...buttons);
}
