/** A card at the corner of the stage for background work. */
import "./task_card.css";
import { html } from "../../ui/dom";

/** A card that is shown until it is removed. @param name name for screen readers */
export function taskCard(name: string, ...content: Node[]): HTMLElement {
  return html("section", { class: "task-card", "aria-label": name }, ...content);
}
