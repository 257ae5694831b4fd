/** The Export menu. */

import { button } from "../../ui/controls/buttons";
import { html } from "../../ui/dom";
import { makesMp4, OUTPUT_FORMATS, type OutputFormat, VIDEO_SIZES, type VideoSize } from "../outputs/formats";
import { strings } from "../strings/strings";

export class ExportMenu {
  /** The button that opens the menu, and the menu. */
  readonly elements: readonly [HTMLButtonElement, HTMLElement];
  readonly #open: HTMLButtonElement;

  constructor(onExport: (format: OutputFormat, size: VideoSize) => void) {
    const size = html("select", { "aria-label": strings.page.outputs.size });
    size.append(
      ...Object.entries(VIDEO_SIZES).map(([name, size]) =>
        html("option", { value: name }, size ? name : strings.page.outputs.asOnScreen),
      ),
    );
    const menu = html("div", { id: "export-menu", class: "menu export-menu", popover: "auto" });
    for (const { format, name } of OUTPUT_FORMATS) {
      const item = button(name, () => onExport(format, size.value as VideoSize), { label: true, class: "menu-item" });
      item.append(html("span", { class: "caption" }, strings.page.outputs.what[format]));
      item.removeAttribute("title");
      item.addEventListener("click", () => menu.hidePopover());
      menu.append(format === "webm" ? html("div", { class: "menu-row" }, item, size) : item);
      if (format !== "mp4") continue;
      item.hidden = true;
      const offer = async () => {
        item.hidden = !(await makesMp4());
      };
      menu.addEventListener("toggle", () => void offer(), { once: true });
    }
    this.#open = button(strings.page.outputs.export, () => {}, {
      icon: "export",
      label: true,
      class: "bar-action outlined",
    });
    this.#open.title = strings.page.outputs.why;
    // Its text is hidden on a narrow screen.
    this.#open.setAttribute("aria-label", strings.page.outputs.export);
    this.#open.setAttribute("popovertarget", "export-menu");
    this.elements = [this.#open, menu];
  }

  /** Disabled until an input is open, and during an export. */
  set enabled(enabled: boolean) {
    this.#open.disabled = !enabled;
  }
}
