/** What the page says over the stage: errors and offers stay until dismissed, notes go by themselves. */

import { isUnloaded } from "../../client/protocol";
import { button } from "../../ui/controls/buttons";
import { html } from "../../ui/dom";
import { strings } from "../strings/strings";
import { errorText } from "./words";

const NOTE_MS = 6000;
/** Maximum number of toasts at a time; the oldest is removed first. */
const MOST = 3;

/** What a person can do about a message, with one press. */
export interface ToastAction {
  label: string;
  act: () => void;
}

/** Loads the page anew; its address has the state. */
export const RELOAD: ToastAction = { label: strings.page.reload, act: () => location.reload() };

export class Toasts {
  readonly element = html("div", { class: "toasts" });
  /** Live regions must be in the page before their text comes, or screen readers miss it. */
  readonly #alerts = html("div", { role: "alert" });
  readonly #notes = html("div", { role: "status" });
  readonly #lasting = new WeakSet<Element>();

  constructor() {
    this.element.append(this.#alerts, this.#notes);
  }

  /**
   * Something failed: a sentence that says what, and what to do.
   * @param lasts whether {@link clearErrors} leaves it, as nothing that works makes it untrue
   * @param action may become known, or turn out not to exist, while the sentence is already shown
   * @returns takes it away
   */
  error(
    text: string,
    { lasts = false, action }: { lasts?: boolean; action?: ToastAction | Promise<ToastAction | undefined> } = {},
  ): () => void {
    if (says(this.#alerts, text)) return () => {};
    const toast = this.#add(this.#alerts, text, "error");
    if (lasts) this.#lasting.add(toast);
    const take = () => toast.remove();
    const offer = ({ label, act }: ToastAction) =>
      addButton(toast, label, () => {
        take();
        act();
      });
    if (action instanceof Promise) action.then((known) => known && offer(known), console.error);
    else if (action) offer(action);
    return take;
  }

  /** Something was thrown. Where a part of Strut could not be loaded, the page can be loaded again. */
  failure(error: unknown): void {
    this.error(errorText(error), isUnloaded(error) ? { action: RELOAD } : {});
  }

  /** Shows a message. */
  note(text: string): void {
    const toast = this.#add(this.#notes, text, "note");
    setTimeout(() => toast.remove(), NOTE_MS);
  }

  /** Shows a message with a button that does something about it. @returns takes it away */
  offer(text: string, label: string, act: () => void): () => void {
    if (says(this.#notes, text)) return () => {};
    const toast = this.#add(this.#notes, text, "note");
    addButton(toast, label, act);
    return () => toast.remove();
  }

  /** Takes errors away, after what they were about has worked. */
  clearErrors(): void {
    for (const toast of [...this.#alerts.children]) if (!this.#lasting.has(toast)) toast.remove();
  }

  #add(region: HTMLElement, text: string, kind: "error" | "note"): HTMLElement {
    const toast = html("div", { class: `toast ${kind}` }, html("p", {}, text));
    toast.append(button("Dismiss", () => toast.remove(), { icon: "close", class: "plain" }));
    region.append(toast);
    while (region.children.length > MOST) region.firstElementChild?.remove();
    return toast;
  }
}

/** Puts a button before the one that dismisses. */
function addButton(toast: HTMLElement, label: string, act: () => void): void {
  toast.lastElementChild?.before(button(label, act, { label: true, class: "outlined" }));
}

/** Whether a region has a toast with this text. */
function says(region: HTMLElement, text: string): boolean {
  return [...region.children].some((toast) => toast.firstElementChild?.textContent === text);
}
