/** Updates the options of a list only if they differ, so that an open list stays open. */
import { html } from "../../../ui/dom";

/** An option: its value and its text. */
export type Choice = readonly [value: string, text: string];

/** Shows these options in a list, with one of them selected. */
export function showChoices(list: HTMLSelectElement, choices: readonly Choice[], chosen: string): void {
  const { options } = list;
  const same =
    options.length === choices.length &&
    choices.every(([value, text], i) => options[i]!.value === value && options[i]!.text === text);
  if (!same) list.replaceChildren(...choices.map(([value, text]) => html("option", { value }, text)));
  list.value = chosen;
}
