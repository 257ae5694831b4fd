/** The top bar: name, tabs, undo and redo, share, export, theme, help; on a narrow screen partly in a menu. */

import type { ViewName } from "../../link/page";
import { button } from "../../ui/controls/buttons";
import { icon, mark } from "../../ui/controls/icons";
import { html, setAttributes } from "../../ui/dom";
import type { OutputFormat, VideoSize } from "../outputs/formats";
import { strings } from "../strings/strings";
import { ExportMenu } from "./export_menu";
import { type ProjectListeners, ProjectMenu } from "./project_menu";
import { VIEWS } from "./view_table";

interface TopBarListeners extends ProjectListeners {
  onView: (view: ViewName) => void;
  /** Called when the tab of a view is hovered or focused. */
  onReach: (view: ViewName) => void;
  onUndo: () => void;
  onRedo: () => void;
  onShare: () => void;
  /** Shows the code to embed the displayed figure. */
  onEmbed: () => void;
  onExport: (format: OutputFormat, size: VideoSize) => void;
  onTheme: () => void;
  onHelp: () => void;
}

export class TopBar {
  readonly element: HTMLElement;
  readonly #undo: HTMLButtonElement[];
  readonly #redo: HTMLButtonElement[];
  readonly #theme: HTMLButtonElement;
  readonly #export: ExportMenu;
  readonly #project: ProjectMenu;
  readonly #embeds: HTMLButtonElement[];
  /** Elements that contain the embed buttons. */
  readonly #embedPlaces: HTMLElement[];
  /** The tabs, and the menu items for them on a narrow screen. */
  readonly #views: { name: ViewName; element: HTMLElement }[];

  constructor(listeners: TopBarListeners) {
    const divider = () => html("span", { class: "bar-divider" });
    const undo = button(strings.page.bar.undo, listeners.onUndo, { icon: "undo", keys: "Ctrl+Z" });
    const redo = button(strings.page.bar.redo, listeners.onRedo, { icon: "redo", keys: "Ctrl+Shift+Z" });
    const share = button(strings.page.bar.share, listeners.onShare, {
      icon: "share",
      label: true,
      class: "bar-action",
    });
    const embed = button(strings.page.bar.embed, listeners.onEmbed, {
      icon: "embed",
      label: true,
      class: "bar-action",
    });
    const menuEmbed = button(strings.page.bar.embed, listeners.onEmbed, {
      icon: "embed",
      label: true,
      class: "menu-item",
    });
    this.#embeds = [embed, menuEmbed];
    const embedPlace = html("span", { class: "wide" }, embed);
    this.#embedPlaces = [embedPlace, menuEmbed];
    this.#project = new ProjectMenu(listeners);
    this.#export = new ExportMenu(listeners.onExport);
    this.#theme = button(strings.page.bar.theme, listeners.onTheme, { icon: "sun" });
    const help = button(strings.page.bar.help, listeners.onHelp, { icon: "help", keys: "?" });
    const menuUndo = button(strings.page.bar.undo, listeners.onUndo, { icon: "undo", label: true, class: "menu-item" });
    const menuRedo = button(strings.page.bar.redo, listeners.onRedo, { icon: "redo", label: true, class: "menu-item" });
    const menuTheme = button(strings.page.bar.lightOrDark, listeners.onTheme, {
      icon: "moon",
      label: true,
      class: "menu-item",
    });
    const menuHelp = button(strings.page.bar.help, listeners.onHelp, { icon: "help", label: true, class: "menu-item" });
    const home = html("a", { class: "wordmark", href: "./", "aria-label": strings.page.bar.home }, mark(), "Strut");
    onPlainClick(home, () => listeners.onView("play"));
    const tabs = VIEWS.map(({ name, title }) => {
      const element = html("a", { href: `#view=${name}`, class: "tab" }, title);
      onPlainClick(element, () => listeners.onView(name));
      for (const type of ["pointerenter", "focus"]) element.addEventListener(type, () => listeners.onReach(name));
      return { name, element };
    });
    const menuViews = VIEWS.map(({ name, title }) => {
      const element = button(title, () => listeners.onView(name), { label: true, class: "menu-item" });
      element.addEventListener("click", () => menu.hidePopover());
      return { name, element };
    });
    this.#views = [...tabs, ...menuViews];
    const menu = html("div", { id: "menu", class: "menu", popover: "auto" });
    const { items } = this.#project;
    menu.append(...menuViews.map(({ element }) => element), menuUndo, menuRedo, ...items);
    menu.append(menuEmbed, menuTheme, menuHelp);
    for (const item of [...items, menuEmbed, menuTheme, menuHelp])
      item.addEventListener("click", () => menu.hidePopover());
    const menuButton = button(strings.page.bar.menu, () => {}, { icon: "menu", label: true, class: "menu-button" });
    menuButton.setAttribute("popovertarget", "menu");
    this.#undo = [undo, menuUndo];
    this.#redo = [redo, menuRedo];
    this.element = html(
      "header",
      { class: "bar" },
      home,
      html("nav", { "aria-label": strings.page.bar.views }, ...tabs.map(({ element }) => element)),
      html(
        "div",
        { class: "bar-actions" },
        html("span", { class: "wide" }, undo, redo, divider(), ...this.#project.elements),
        share,
        embedPlace,
        ...this.#export.elements,
        html("span", { class: "wide" }, divider(), this.#theme, help),
        menuButton,
        menu,
      ),
    );
  }

  show({ view, canUndo, canRedo, dark }: { view: ViewName; canUndo: boolean; canRedo: boolean; dark: boolean }): void {
    for (const { name, element } of this.#views) setAttributes(element, { "aria-current": name === view && "page" });
    // An embedded figure has the functions of Play.
    for (const place of this.#embedPlaces) place.hidden = view !== "play";
    for (const undo of this.#undo) undo.disabled = !canUndo;
    for (const redo of this.#redo) redo.disabled = !canRedo;
    const name = dark ? strings.page.bar.lightTheme : strings.page.bar.darkTheme;
    if (this.#theme.title === name) return;
    this.#theme.title = name;
    this.#theme.setAttribute("aria-label", name);
    this.#theme.replaceChildren(icon(dark ? "sun" : "moon"));
  }

  /** Number of dropped files, and their bytes. */
  set kept(kept: { files: number; bytes: number }) {
    this.#project.kept = kept;
  }

  /** Disabled until an input is open, and during an export. */
  set canExport(can: boolean) {
    this.#export.enabled = can;
    for (const embed of this.#embeds) embed.disabled = !can;
  }
}

/** Handles a plain click on a link instead of following it. With Ctrl, Cmd or Shift the browser opens the link as usual. */
function onPlainClick(link: HTMLElement, act: () => void): void {
  link.addEventListener("click", (event) => {
    if (event.ctrlKey || event.metaKey || event.shiftKey) return;
    event.preventDefault();
    act();
  });
}
