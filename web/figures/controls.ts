/** Controls shared by several kinds of figures. */

import type { Field } from "../link/fields";
import type { DialRange } from "../ui/controls/dial";
import { icon } from "../ui/controls/icons";
import { Knob } from "../ui/controls/knob";
import type { Range } from "../ui/controls/range";
import { Slider } from "../ui/controls/slider";
import { html } from "../ui/dom";
import { FRAMES, RATE_HZ } from "./built_in";
import type { KnobWords } from "./words/knob";
import { figure, type Words } from "./words/words";

/** The default frame if a link has none. */
const INSTANT = 160;

/** A list of options. */
export class Choice<T extends string> {
  readonly element: HTMLElement;
  readonly #select: HTMLSelectElement;

  constructor(name: string, options: readonly (readonly [value: T, label: string])[], onChange: (value: T) => void) {
    this.#select = html("select", { "aria-label": name });
    for (const [value, label] of options) this.#select.append(html("option", { value }, label));
    this.#select.addEventListener("change", () => onChange(this.#select.value as T));
    this.element = html("div", { class: "select" }, this.#select, icon("chevron"));
  }

  set value(value: T) {
    this.#select.value = value;
  }
}

/** A field for a number computed by the learner. */
export class GuessField {
  readonly element: HTMLElement;
  readonly #field: HTMLInputElement;

  /**
   * @param range range to which a number is clamped
   * @param empty value of an empty field
   */
  constructor(
    name: string,
    { min, max }: Pick<Range, "min" | "max">,
    empty: number,
    onChange: (guess: number) => void,
    signal: AbortSignal,
  ) {
    this.#field = html("input", { class: "text-field", type: "text", inputmode: "decimal", "aria-label": name });
    const commit = () => {
      const text = this.#field.value.trim().replace(",", ".").replace("−", "-");
      const typed = Number(text);
      onChange(text === "" || !Number.isFinite(typed) ? empty : Math.min(max, Math.max(min, typed)));
    };
    this.#field.addEventListener("change", commit, { signal });
    this.#field.addEventListener("keydown", (event) => event.stopPropagation(), { signal });
    this.element = html("label", { class: "guess" }, html("span", {}, name), this.#field);
  }

  /** The displayed text, unless the learner is typing. */
  set text(text: string) {
    if (!this.#field.matches(":focus")) this.#field.value = text;
  }
}

/** Called with the changes of a control. */
type Change<Name extends string> = (patch: Partial<Record<Name, number>>, settled: boolean) => void;

/** A knob for each of some numbers of a state. */
export function createKnobs<Name extends string>(
  names: readonly Name[],
  words: Words,
  texts: Readonly<Record<Name, KnobWords>>,
  ranges: Readonly<Record<Name, DialRange>>,
  fields: Readonly<Record<Name, Pick<Field<number>, "initial">>>,
  change: Change<Name>,
): Record<Name, Knob> {
  const settle = () => change({}, true);
  const knob = (name: Name) =>
    new Knob(
      texts[name],
      ranges[name],
      fields[name].initial,
      {
        onInput: (value) => change({ [name]: value } as Partial<Record<Name, number>>, false),
        onSettle: settle,
        onCancel: settle,
      },
      words,
    );
  return Object.fromEntries(names.map((name) => [name, knob(name)])) as Record<Name, Knob>;
}

/** A slider for the examined instant of a built-in input. @param first the first valid frame */
export function createInstant(words: Words, first: number, change: Change<"at">): Slider {
  const slider = new Slider(words.playhead, { min: first, max: FRAMES - 1, digits: 0 }, INSTANT, {
    onInput: (at) => change({ at }, false),
    onSettle: () => change({}, true),
  });
  slider.words = (frame) => `${figure(frame / RATE_HZ, 2, words)} s`;
  return slider;
}
