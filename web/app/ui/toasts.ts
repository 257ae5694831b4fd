/**
 * Messages over the stage: errors and offers stay until dismissed. Notes disappear by themselves, but not while they
 * are hovered or focused.
 */

import { isUnloaded } from "../../client/protocol";
import { button } from "../../ui/controls/buttons";
import { html } from "../../ui/dom";
import { strings } from "../strings/strings";
import { focusView } from "./focus_view";
import { errorText, isMissingModule } from "./words";

const NOTE_MS = 6000;
/** Maximum number of toasts at a time; the oldest is removed first. */
const MOST = 3;

/** A button of a message. */
export interface ToastAction {
  label: string;
  act: () => void;
}

/** Reloads the page; its address has the state. */
export const RELOAD: ToastAction = { label: strings.page.reload, act: () => location.reload() };

export class Toasts {
  readonly element = html("div", { class: "toasts" });
  /** Live regions must be in the page before their text is set, or screen readers miss it. */
  readonly #alerts = html("div", { role: "alert" });
  readonly #notes = html("div", { role: "status" });
  readonly #lasting = new WeakSet<Element>();
  readonly #view: () => Element | undefined;
  /** The element that was focused before a toast got the focus. */
  #focusedBefore: EventTarget | null = null;

  /** @param view returns the current view, which receives the focus of a removed toast if nothing had it before */
  constructor(view: () => Element | undefined) {
    this.#view = view;
    this.element.append(this.#alerts, this.#notes);
    this.element.addEventListener("focusin", ({ relatedTarget }) => {
      if (!this.element.contains(relatedTarget as Node | null)) this.#focusedBefore = relatedTarget;
    });
  }

  /**
   * Reports a failure: a sentence about what failed, and what to do.
   * @param lasts whether {@link clearErrors} keeps it, because later successes do not make it obsolete
   * @param action may be resolved, also to none, while the sentence is already shown
   * @returns a function that removes it
   */
  error(
    text: string,
    { lasts = false, action }: { lasts?: boolean; action?: ToastAction | Promise<ToastAction | undefined> } = {},
  ): () => void {
    if (says(this.#alerts, text)) return () => {};
    const toast = this.#add(this.#alerts, text, "error");
    if (lasts) this.#lasting.add(toast);
    if (action instanceof Promise)
      action.then((known) => {
        if (known) this.#addAction(toast, known);
      }, console.error);
    else if (action) this.#addAction(toast, action);
    return () => this.#take(toast);
  }

  /** Reports a thrown value. If a part of Strut could not be loaded, it offers to reload the page. */
  failure(error: unknown): void {
    this.error(errorText(error), isUnloaded(error) || isMissingModule(error) ? { action: RELOAD } : {});
  }

  /** Shows a message. */
  note(text: string): void {
    const toast = this.#add(this.#notes, text, "note");
    afterRest(toast, () => this.#take(toast));
  }

  /**
   * Shows a message with a button.
   * @returns a function that removes it
   */
  offer(text: string, label: string, act: () => void): () => void {
    if (says(this.#notes, text)) return () => {};
    const toast = this.#add(this.#notes, text, "note");
    this.#addAction(toast, { label, act });
    return () => this.#take(toast);
  }

  /** Removes errors after the failed operation has succeeded. */
  clearErrors(): void {
    for (const toast of [...this.#alerts.children]) if (!this.#lasting.has(toast)) this.#take(toast);
  }

  #add(region: HTMLElement, text: string, kind: "error" | "note"): HTMLElement {
    const toast = html("div", { class: `toast ${kind}` }, html("p", {}, text));
    const dismiss = button(strings.page.dismiss, () => this.#take(toast), { icon: "close", class: "plain" });
    toast.append(dismiss);
    region.append(toast);
    while (region.children.length > MOST) this.#take(region.firstElementChild!);
    return toast;
  }

  /** Adds a button before the dismiss button. */
  #addAction(toast: HTMLElement, { label, act }: ToastAction): void {
    const done = () => {
      this.#take(toast);
      act();
    };
    toast.lastElementChild?.before(button(label, done, { label: true, class: "outlined" }));
  }

  /** Removes a toast; its focus returns to the previous element, or else to the view. */
  #take(toast: Element): void {
    const hadFocus = toast.contains(document.activeElement);
    toast.remove();
    if (!hadFocus) return;
    const before = this.#focusedBefore;
    if (before instanceof HTMLElement || before instanceof SVGElement) before.focus({ preventScroll: true });
    const view = this.#view();
    if (view && (document.activeElement ?? document.body) === document.body) focusView(view);
  }
}

/** Calls back when a note has been neither hovered nor focused for a while. */
function afterRest(note: HTMLElement, call: () => void): void {
  let timer: ReturnType<typeof setTimeout> | undefined;
  const holds = { pointer: false, focus: false };
  const hold = (by: keyof typeof holds, held: boolean) => {
    holds[by] = held;
    clearTimeout(timer);
    if (!holds.pointer && !holds.focus) timer = setTimeout(call, NOTE_MS);
  };
  note.addEventListener("pointerenter", () => hold("pointer", true));
  note.addEventListener("pointerleave", () => hold("pointer", false));
  note.addEventListener("focusin", () => hold("focus", true));
  note.addEventListener("focusout", () => hold("focus", false));
  hold("pointer", false);
}

/** Whether a region has a toast with this text. */
function says(region: HTMLElement, text: string): boolean {
  return [...region.children].some((toast) => toast.firstElementChild?.textContent === text);
}
