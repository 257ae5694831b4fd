/** The menu of the files that the page makes. */
import { button } from "../controls/buttons";
import { html } from "../dom";
import { OUTPUT_FORMATS, type OutputFormat, VIDEO_SIZES, type VideoSize } from "../outputs/formats";
import { strings } from "../strings/strings";

export class ExportMenu {
  /** The button that opens it, and the menu. */
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
    }
    this.#open = button(strings.page.outputs.export, () => {}, {
      icon: "export",
      label: true,
      class: "bar-action outlined",
    });
    this.#open.title = strings.page.outputs.why;
    this.#open.setAttribute("popovertarget", "export-menu");
    this.elements = [this.#open, menu];
  }

  /** There is nothing to export before an input is open, and not twice at a time. */
  set enabled(enabled: boolean) {
    this.#open.disabled = !enabled;
  }
}
