/** Shown by a view instead of its picture while it has no model: the reason, and what can be done. */
import { button } from "../../../ui/controls/buttons";
import { html } from "../../../ui/dom";

/** An action with a button. */
interface EmptyChoice {
  label: string;
  onChoose: () => void;
}

export class EmptyPanel {
  readonly element = html("div", { class: "editor-empty", hidden: true });

  show(message: string, choices: readonly EmptyChoice[]): void {
    const buttons = choices.map(({ label, onChoose }) => button(label, onChoose, { label: true, class: "outlined" }));
    this.element.replaceChildren(html("p", {}, message), html("div", {}, ...buttons));
    this.element.hidden = false;
  }

  hide(): void {
    this.element.hidden = true;
  }
}
