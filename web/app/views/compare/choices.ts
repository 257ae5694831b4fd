/** The choices of a list, changed only where they differ, so that a list that is open stays open. */
import { html } from "../../../ui/dom";

/** A choice: its value, and what the list says. */
export type Choice = readonly [value: string, text: string];

/** Shows these choices in a list, with one of them chosen. */
export function showChoices(list: HTMLSelectElement, choices: readonly Choice[], chosen: string): void {
  const { options } = list;
  const same =
    options.length === choices.length &&
    choices.every(([value, text], i) => options[i]!.value === value && options[i]!.text === text);
  if (!same) list.replaceChildren(...choices.map(([value, text]) => html("option", { value }, text)));
  list.value = chosen;
}
