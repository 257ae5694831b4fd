/** The bet of a lesson: placed or skipped, and then its answer. */

import type { Lesson } from "../../../lessons/lesson";
import type { LearnText, LessonText } from "../../../lessons/text/text";
import { button } from "../../../ui/controls/buttons";
import { html } from "../../../ui/dom";
import { prose } from "./prose";

export class BetPanel {
  readonly element = html("div", { class: "bet" });
  readonly #reveal = html("div", { class: "reveal", role: "status" });
  readonly #inputs: HTMLInputElement[];
  readonly #actions: HTMLElement;

  /** @param onPlace called with the option, or an empty text if the bet was skipped */
  constructor({ id, bet }: Lesson, text: LessonText, learn: LearnText, onPlace: (option: string) => void) {
    this.#inputs = bet.options.map((value) => html("input", { type: "radio", name: `bet-${id}`, value }));
    const place = button(learn.place, () => onPlace(this.#chosen), { label: true, class: "outlined" });
    place.disabled = true;
    const skip = button(learn.skip, () => onPlace(""), { label: true });
    this.#actions = html("div", { class: "actions" }, place, skip);
    const options = this.#inputs.map((input) => html("label", {}, input, text.bet.options[input.value]!));
    for (const input of this.#inputs)
      input.addEventListener("change", () => {
        place.disabled = this.#chosen === "";
      });
    this.element.append(
      html("fieldset", {}, html("legend", {}, ...prose(text.bet.question)), ...options),
      this.#actions,
      this.#reveal,
    );
  }

  /** Shows the placed bet; `undefined` until then. */
  show(placed: string | undefined): void {
    for (const input of this.#inputs) {
      if (placed !== undefined) input.checked = input.value === placed;
      input.disabled = placed !== undefined;
    }
    this.#actions.hidden = placed !== undefined;
    if (placed === undefined) this.#reveal.replaceChildren();
  }

  /** Shows the answer. */
  reveal(...sentences: string[]): void {
    this.#reveal.replaceChildren(...sentences.map((sentence) => html("p", {}, ...prose(sentence))));
  }

  /** The revealed text, for the printed answers. */
  get revealed(): string {
    return this.#reveal.textContent ?? "";
  }

  get #chosen(): string {
    return this.#inputs.find((input) => input.checked)?.value ?? "";
  }
}
