/** Chooses one to three style variables: named measures, or expressions with errors that mark the character. */
import { type CheckedAxis, checkAxis } from "../../../client/models/key_style";
import { icon } from "../../../ui/controls/icons";
import { html, setText } from "../../../ui/dom";
import { type Axis, encodeAxes, MAX_AXES, MAX_CHARACTERS } from "../../state/key_style";
import { strings } from "../../strings/strings";
import { errorText } from "../../ui/words";
import { isNamed, NAMED_AXES, titleOf } from "./axes";

/** Values of the options that are not measures. */
const NONE = "";
const EXPRESSION = "=";

interface Field {
  element: HTMLElement;
  select: HTMLSelectElement;
}

export class AxisChooser {
  readonly element: HTMLElement;
  /** The line in which an expression is typed, below the lists. */
  readonly line: HTMLElement;
  readonly #onChoose: (axes: Axis[]) => void;
  readonly #fields: Field[];
  readonly #input = html("input", {
    type: "text",
    maxlength: MAX_CHARACTERS,
    spellcheck: "false",
    autocomplete: "off",
    placeholder: strings.keyStyle.expressionHint,
    "aria-describedby": "axis-fault",
  });
  readonly #fault = html("p", { id: "axis-fault", class: "axis-fault", role: "status" });
  #axes: readonly Axis[] = [];
  /** Index of the variable whose expression is being typed. */
  #written = 0;

  constructor(onChoose: (axes: Axis[]) => void) {
    this.#onChoose = onChoose;
    this.#fields = Array.from({ length: MAX_AXES }, (_, i) => this.#field(i));
    const [first, ...others] = this.#fields;
    this.element = html(
      "div",
      { class: "axis-chooser" },
      first!.element,
      ...others.flatMap(({ element }) => [
        html("span", { class: "caption", "aria-hidden": "true" }, strings.keyStyle.by),
        element,
      ]),
    );
    this.line = html("div", { class: "axis-line", hidden: true }, this.#input, this.#fault);
    this.#input.addEventListener("input", () => void this.#check(false));
    this.#input.addEventListener("keydown", (event) => {
      if (event.key === "Enter") void this.#check(true);
      else if (event.key === "Escape") this.#close();
      else return;
      event.preventDefault();
      event.stopPropagation();
    });
  }

  show(axes: readonly Axis[]): void {
    // An open list is not changed.
    if (encodeAxes(axes) !== encodeAxes(this.#axes)) this.#fill(axes);
  }

  #fill(axes: readonly Axis[]): void {
    this.#axes = axes;
    for (const [i, { element, select }] of this.#fields.entries()) {
      const axis = axes[i];
      const others = axes.filter((_, at) => at !== i);
      const named = NAMED_AXES.filter((name) => !others.includes(name));
      const option = (value: string, words: string) => html("option", { value }, words);
      select.replaceChildren(
        ...(i > 0 ? [option(NONE, strings.keyStyle.none)] : []),
        ...named.map((name) => option(name, titleOf(name))),
        ...(axis !== undefined && !isNamed(axis) ? [option(axis, axis)] : []),
        option(EXPRESSION, strings.keyStyle.expression),
      );
      select.value = axis ?? NONE;
      element.classList.toggle("absent", axis === undefined);
      // A third variable is available once there are two.
      element.hidden = i > axes.length;
      const by = element.previousElementSibling;
      if (by instanceof HTMLElement) by.hidden = element.hidden;
    }
  }

  #field(i: number): Field {
    const select = html("select", { "aria-label": strings.keyStyle.axis[i]! });
    select.addEventListener("change", () => {
      const { value } = select;
      if (value === EXPRESSION) this.#write(i);
      else {
        this.#close();
        this.#choose(i, value);
      }
    });
    return { element: html("div", { class: "select axis-select" }, select, icon("chevron")), select };
  }

  #choose(i: number, axis: Axis): void {
    const axes = [...this.#axes];
    if (axis === NONE) axes.splice(i, MAX_AXES);
    else axes[i] = axis;
    this.#onChoose(axes);
  }

  #write(i: number): void {
    this.#written = i;
    const axis = this.#axes[i];
    this.#input.value = axis !== undefined && !isNamed(axis) ? axis : "";
    this.#input.setAttribute("aria-label", strings.keyStyle.expressionOf(strings.keyStyle.axis[i]!));
    setText(this.#fault, "");
    this.line.hidden = false;
    this.#input.focus();
  }

  #close(): void {
    this.line.hidden = true;
    this.#fill(this.#axes);
  }

  /** Shows the error of the expression, or applies it when it is finished. */
  async #check(finished: boolean): Promise<void> {
    const text = this.#input.value.trim();
    if (text === "") {
      this.#say(undefined, "");
      return;
    }
    const checked = await checkAxis(text).catch((error): CheckedAxis => ({ message: errorText(error), column: 0 }));
    if (this.#input.value.trim() !== text) return;
    const wrong = "message" in checked;
    this.#say(wrong ? checked : undefined, text);
    if (wrong || !finished) return;
    this.line.hidden = true;
    this.#choose(this.#written, text);
  }

  /** Marks the character. */
  #say(wrong: { message: string; column: number } | undefined, text: string): void {
    this.#input.setAttribute("aria-invalid", String(wrong !== undefined));
    if (!wrong) {
      this.#fault.replaceChildren();
      return;
    }
    const { message, column } = wrong;
    const character = text.slice(column, column + 1);
    this.#fault.replaceChildren(
      html(
        "code",
        {},
        text.slice(0, column),
        html("mark", {}, character === "" ? "\u00a0" : character),
        text.slice(column + 1),
      ),
      html("span", {}, message),
    );
  }
}
