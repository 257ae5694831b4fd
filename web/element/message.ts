/** An error message over the stage, and what can be done. */
import { button } from "../ui/controls/buttons";
import { html } from "../ui/dom";
import { strings } from "./strings";

export class Message {
  readonly element = html("div", { class: "message", part: "message", role: "alert", hidden: true });

  /** Shows an error's sentence and hint; `retry` is called by “Try again”, if that may help. */
  show(error: unknown, retry?: () => void): void {
    const { message, hint } = error as { message?: unknown; hint?: unknown };
    const sentence = [message, hint].filter((part) => typeof part === "string" && part !== "").join(" ");
    this.element.replaceChildren(html("span", {}, sentence));
    if (retry) this.element.append(button(strings.retry, retry, { label: true, class: "outlined" }));
    this.element.hidden = false;
  }

  /** Shows that nothing can be drawn here, and the page's fallback. */
  showFallback(sentence: string): void {
    this.element.replaceChildren(html("slot", { name: "fallback" }, sentence));
    this.element.hidden = false;
  }

  hide(): void {
    this.element.hidden = true;
  }
}
