/** A sheet at the bottom of a narrow screen, which is closed by pulling down its header. */
import { html } from "../../../../ui/dom";
import { listenToDrags } from "../../../../ui/drag";

/** Pull that closes a sheet: a quarter of its height, and at most this, pixels. */
const MOST_PULL = 96;

/**
 * Adds a handle to a sheet's header and makes the header draggable. The close button stays, for users who do not drag.
 * On a wide screen the element is not a sheet: style sheets hide the handle and dragging is off.
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
