/** Asks what a style shall be called, before it is made. */

import { button } from "../../../ui/controls/buttons";
import { html, setText } from "../../../ui/dom";
import { strings } from "../../strings/strings";
import { askInDialog, dialogActions } from "../../ui/dialog";

const words = strings.data.style;

/** Longest name of a style, characters. */
const LONGEST = 40;

/**
 * Asks for the name of a style of a clip.
 * @param guess what the clip's file suggests
 * @param taken names that other styles have
 * @returns the name, or undefined where no style is wanted
 */
export function askForStyleName(guess: string, taken: readonly string[]): Promise<string | undefined> {
  const input = html("input", { type: "text", class: "text", "aria-label": words.name, maxlength: LONGEST });
  const fault = html("p", { class: "caption", role: "status" });
  const asked = askInDialog<string>("style-name", words.heading, (choose, cancel) => {
    const make = button(words.make, () => form.requestSubmit(), { label: true, class: "outlined" });
    const actions = dialogActions(button(strings.data.cancel, cancel, { label: true }), make);
    const form = html("form", { method: "dialog" }, input, fault, actions);
    const check = () => {
      const name = input.value.trim();
      setText(fault, taken.includes(name) ? words.taken(name) : "");
      make.disabled = name === "" || taken.includes(name);
    };
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      if (!make.disabled) choose(input.value.trim());
    });
    input.addEventListener("input", check);
    input.value = guess;
    check();
    return [form];
  });
  input.select();
  return asked;
}
