/** A sheet at the bottom of a narrow screen, which is pulled down by its head to close it. */
import { html } from "../../../../ui/dom";
import { listenToDrags } from "../../../../ui/drag";

/** How far a sheet is pulled to be closed: a quarter of its height, and at most this, pixels. */
const MOST_PULL = 96;

/**
 * Puts a handle into a sheet's head and lets the head be pulled. The button that closes the sheet stays, for those who do not
 * drag. Where the sheet is no sheet, as on a wide screen, style sheets hide the handle and nothing can be pulled.
 */
export function pullToClose(sheet: HTMLElement, head: HTMLElement, onClose: () => void): void {
  const handle = html("span", { class: "sheet-handle", "aria-hidden": "true" });
  head.prepend(handle);
  listenToDrags(head, ({ clientY: from, target }) => {
    if (handle.offsetHeight === 0 || (target as Element).closest("button")) return undefined;
    let pulled = 0;
    const pull = (by: number) => {
      pulled = Math.max(0, by);
      sheet.style.translate = pulled > 0 ? `0 ${pulled}px` : "";
    };
    return {
      move: ({ clientY }) => pull(clientY - from),
      cancel: () => pull(0),
      end: () => {
        const closes = pulled > Math.min(MOST_PULL, sheet.offsetHeight / 4);
        pull(0);
        if (closes) onClose();
      },
    };
  });
}
