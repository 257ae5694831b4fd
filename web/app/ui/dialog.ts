/** Modal dialogs with a heading, a question, and buttons. */
import "./dialog.css";
import { html } from "../../ui/dom";

let dialogs = 0;

/**
 * Shows a modal dialog until it is closed.
 * @param fill makes its content below the heading; `choose` closes it with an answer, `cancel` without
 * @returns the answer, or `undefined` if there was none
 */
export function askInDialog<T>(
  kind: string,
  heading: string,
  fill: (choose: (answer: T) => void, cancel: () => void) => Node[],
): Promise<T | undefined> {
  return new Promise((resolve) => {
    let chosen: T | undefined;
    const id = `dialog-heading-${++dialogs}`;
    const dialog = html("dialog", { class: `help ${kind}`, "aria-labelledby": id }, html("h2", { id }, heading));
    const choose = (answer: T) => {
      chosen = answer;
      dialog.close();
    };
    dialog.append(...fill(choose, () => dialog.close()));
    dialog.addEventListener("close", () => {
      dialog.remove();
      resolve(chosen);
    });
    document.body.append(dialog);
    dialog.showModal();
  });
}

/** The row of buttons at the end of a dialog. */
export function dialogActions(...buttons: HTMLButtonElement[]): HTMLElement {
  return html("div", { class: "dialog-actions" }, ...buttons);
}
