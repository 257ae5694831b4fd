/** The Project menu: open, save, and the stored dropped files; on a narrow screen items of the page's menu. */

import { button } from "../../ui/controls/buttons";
import type { IconName } from "../../ui/controls/icons";
import { html, setText } from "../../ui/dom";
import { strings } from "../strings/strings";

const words = strings.page.project;

export interface ProjectListeners {
  onOpen: () => void;
  onSave: () => void;
  /** Deletes the stored dropped files. */
  onForget: () => void;
}

export class ProjectMenu {
  /** The button that opens the menu, and the menu. */
  readonly elements: readonly HTMLElement[];
  /** The items for the page's menu on a narrow screen. */
  readonly items: readonly HTMLButtonElement[];
  readonly #kept = html("p", { class: "caption" });
  readonly #keptRow: HTMLElement;
  readonly #menuForget: HTMLButtonElement;

  constructor({ onOpen, onSave, onForget }: ProjectListeners) {
    const item = (name: string, what: string, keys: string, act: () => void) => {
      const made = button(name, act, { label: true, class: "menu-item" });
      made.append(html("span", { class: "caption" }, what), html("kbd", {}, keys));
      made.removeAttribute("title");
      made.addEventListener("click", () => menu.hidePopover());
      return made;
    };
    const menu = html("div", { id: "project-menu", class: "menu project-menu", popover: "auto" });
    const forget = button(words.forget, onForget, { label: true, class: "outlined" });
    forget.addEventListener("click", () => menu.hidePopover());
    this.#keptRow = html("div", { class: "project-kept", hidden: true }, this.#kept, forget);
    menu.append(
      item(words.open, words.openWhat, "Ctrl O", onOpen),
      item(words.save, words.saveWhat, "Ctrl S", onSave),
      this.#keptRow,
    );
    const open = button(strings.page.bar.project, () => {}, { icon: "folder", label: true, class: "bar-action" });
    open.title = words.why;
    // Its text is hidden on a narrow screen.
    open.setAttribute("aria-label", strings.page.bar.project);
    open.setAttribute("popovertarget", menu.id);
    menu.addEventListener("beforetoggle", () => {
      // Below its button, within the window.
      menu.style.setProperty("--left", `${open.getBoundingClientRect().left}px`);
    });
    this.elements = [open, menu];
    const narrow = (name: string, icon: IconName, act: () => void) =>
      button(name, act, { icon, label: true, class: "menu-item" });
    this.#menuForget = narrow(words.forget, "remove", onForget);
    this.#menuForget.hidden = true;
    this.items = [narrow(words.open, "folder", onOpen), narrow(words.menuSave, "save", onSave), this.#menuForget];
  }

  /** Number of dropped files, and their bytes. */
  set kept({ files, bytes }: { files: number; bytes: number }) {
    this.#keptRow.hidden = files === 0;
    this.#menuForget.hidden = files === 0;
    setText(this.#kept, words.kept(files, (bytes / 1e6).toFixed(1)));
    setText(this.#menuForget.lastElementChild!, words.menuForget(files));
    this.#menuForget.removeAttribute("title");
  }
}
