/** A card at the corner of the stage for what goes on while a person does something else. */
import "./task_card.css";
import { html } from "../../ui/dom";

/** A card that is shown until it is removed. @param name what screen readers call it */
export function taskCard(name: string, ...content: Node[]): HTMLElement {
  return html("section", { class: "task-card", "aria-label": name }, ...content);
}
