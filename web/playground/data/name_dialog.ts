/** Asks what a style shall be called, before it is made. */
import "../styles/data.css";
import { button } from "../controls/buttons";
import { html, setText } from "../dom";
import { strings } from "../strings/strings";

const words = strings.data.style;

/** Longest name of a style. */
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
  return new Promise((resolve) => {
    let chosen: string | undefined;
    const done = button(words.make, () => form.requestSubmit(), { label: true, class: "outlined" });
    const cancel = button(strings.data.cancel, () => dialog.close(), { label: true });
    const form = html(
      "form",
      { method: "dialog" },
      input,
      fault,
      html("div", { class: "dialog-actions" }, cancel, done),
    );
    const dialog = html(
      "dialog",
      { class: "help style-name", "aria-labelledby": "name-heading" },
      html("h2", { id: "name-heading" }, words.heading),
      form,
    );
    const check = () => {
      const name = input.value.trim();
      setText(fault, taken.includes(name) ? words.taken(name) : "");
      done.disabled = name === "" || taken.includes(name);
    };
    form.addEventListener("submit", (event) => {
      if (done.disabled) event.preventDefault();
      else chosen = input.value.trim();
    });
    input.addEventListener("input", check);
    dialog.addEventListener("close", () => {
      dialog.remove();
      resolve(chosen);
    });
    input.value = guess;
    check();
    document.body.append(dialog);
    dialog.showModal();
    input.select();
  });
}
