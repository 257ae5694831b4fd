/** The equation of a lesson, and a button with the current value for each of its symbols. */

import type { Lesson } from "../../../lessons/lesson";
import type { LearnText, LessonText } from "../../../lessons/text/text";
import { html, setText } from "../../../ui/dom";

export class EquationPanel {
  readonly element: HTMLElement;
  readonly #values = new Map<string, HTMLElement>();

  constructor({ equation, symbols }: Lesson, text: LessonText, learn: LearnText) {
    const buttons = symbols.map((term) => {
      const { symbol, name } = text.symbols[term]!;
      const value = html("span", { class: "value" });
      this.#values.set(term, value);
      const label = html("span", { class: "name" }, name);
      return html(
        "button",
        { type: "button", class: "symbol", "data-term": term },
        html("i", {}, symbol),
        label,
        value,
      );
    });
    this.element = html(
      "div",
      { class: "learn-equation" },
      markup(equation),
      html("div", { class: "learn-symbols", role: "group", "aria-label": learn.symbols }, ...buttons),
    );
  }

  set values(values: Readonly<Record<string, string>>) {
    for (const [term, element] of this.#values) setText(element, values[term] ?? "");
  }
}

/** The part of the Trusted Types API that is used; it is not in TypeScript's library yet. */
interface TrustedTypes {
  createPolicy(name: string, rules: { createHTML: (text: string) => string }): { createHTML(text: string): string };
}

/** Only the markup that the build made from equations may become elements of this page. */
const policy = (globalThis as { trustedTypes?: TrustedTypes }).trustedTypes?.createPolicy("equations", {
  createHTML: (text) => text,
});

/**
 * KaTeX's markup as elements; its styles are set through the object model, because the page's policy forbids the
 * attributes.
 */
function markup(text: string): HTMLElement {
  const element = html("div", { class: "equation", tabindex: 0 });
  element.innerHTML = policy ? policy.createHTML(text) : text;
  for (const styled of element.querySelectorAll<HTMLElement>("[data-css]")) styled.style.cssText = styled.dataset.css!;
  return element;
}
