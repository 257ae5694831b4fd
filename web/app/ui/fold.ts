/** A part of a panel that can be folded away. The browser remembers whether it is open. */
import "./fold.css";
import { icon } from "../../ui/controls/icons";
import { html, setText } from "../../ui/dom";

/** Where it is remembered: the part of `Storage` that is needed here. */
type Memory = Pick<Storage, "getItem" | "setItem">;

export class Fold {
  readonly element: HTMLDetailsElement;
  readonly #note = html("span", { class: "caption" });

  /**
   * @param name title, which stays visible
   * @param key key in the storage
   * @param memory returns the storage; if it is refused, as in a private window, the part is closed at first
   */
  constructor(name: string, key: string, content: readonly Node[], memory: () => Memory = () => localStorage) {
    const summary = html("summary", { class: "fold-summary" }, icon("chevron"), html("span", {}, name), this.#note);
    this.element = html("details", { class: "fold" }, summary, ...content);
    try {
      this.element.open = memory().getItem(key) === "open";
    } catch {
      // It is closed at first.
    }
    this.element.addEventListener("toggle", () => {
      try {
        memory().setItem(key, this.element.open ? "open" : "closed");
      } catch {
        // It lasts as long as the page.
      }
    });
  }

  /** A short text beside the title. */
  set note(text: string) {
    setText(this.#note, text);
  }
}
