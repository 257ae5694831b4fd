/** One exercise: its task, the result of the last answer, hints, and a link to a solution. */

import type { Verdict } from "../../../lessons/lesson";
import type { ExerciseText, LearnText, Said } from "../../../lessons/text/text";
import { button } from "../../../ui/controls/buttons";
import { html, setText } from "../../../ui/dom";
import { prose } from "./prose";

/** Number of wrong answers after which the solution is offered. */
const TRIES = 3;

interface ExerciseListeners {
  onBegin: () => void;
  onSolution: () => void;
  onLink: () => void;
}

export class ExerciseCard {
  readonly element: HTMLElement;
  readonly #text: ExerciseText;
  readonly #learn: LearnText;
  readonly #status = html("p", { class: "caption" });
  readonly #verdict = html("p", { class: "verdict", role: "status" });
  readonly #hints: HTMLElement[];
  /** Hidden until a hint was requested: an empty list would be announced. */
  readonly #list = html("ol", { class: "hints", hidden: true });
  readonly #hint: HTMLButtonElement;
  readonly #begin: HTMLButtonElement;
  readonly #solution: HTMLButtonElement;
  readonly #link: HTMLButtonElement;
  #hinted = 0;
  /** The text about the last correct answer. */
  #passed = "";

  constructor(id: string, text: ExerciseText, learn: LearnText, answers: boolean, listeners: ExerciseListeners) {
    [this.#text, this.#learn] = [text, learn];
    const made = (name: string, act: () => void) => button(name, act, { label: true, class: "outlined" });
    this.#begin = made(learn.begin, listeners.onBegin);
    this.#link = made(learn.linkToAnswer, listeners.onLink);
    this.#solution = made(learn.solution, listeners.onSolution);
    this.#hint = made(learn.hint(1), () => this.#showHint());
    this.#hints = text.hints.map((hint) => html("li", { hidden: true }, ...prose(hint)));
    this.#list.append(...this.#hints);
    const heading = html("h3", { id: `exercise-${id}` }, id);
    // All exercises have buttons with the same names.
    for (const control of [this.#begin, this.#link, this.#solution, this.#hint])
      control.setAttribute("aria-describedby", heading.id);
    this.element = html(
      "article",
      { class: "exercise", "data-exercise": id, "aria-labelledby": heading.id },
      html("header", {}, heading, this.#status),
      html("p", {}, ...prose(text.task)),
      this.#verdict,
      this.#list,
      html("div", { class: "actions" }, this.#begin, this.#link, ...(answers ? [this.#hint, this.#solution] : [])),
    );
  }

  /** Shows whether it is active, and its results so far. */
  show({ active, tries, solved }: { active: boolean; tries: number; solved: boolean }): void {
    const { solved: done, tries: count, working } = this.#learn;
    const parts = [...(solved ? [done] : []), ...(tries > 0 ? [count(tries)] : []), ...(active ? [working] : [])];
    setText(this.#status, parts.join(" · "));
    this.element.classList.toggle("active", active);
    this.element.classList.toggle("solved", solved);
    this.#begin.hidden = active;
    this.#link.hidden = !active;
    this.#solution.hidden = tries < TRIES || solved;
    if (!active) this.#judge("", "");
  }

  /** Shows the result of an answer. */
  judge(verdict: Verdict, said: Said): void {
    const { pass, near, refuse, no } = this.#text;
    const sentence = verdict.result === "near" ? near[verdict.way]!(said) : { pass, refuse, no }[verdict.result](said);
    this.#judge(verdict.result, sentence);
    if (verdict.result === "pass") this.#passed = sentence;
  }

  fail(sentence: string): void {
    this.#judge("no", sentence);
  }

  /** The text about the last correct answer, for the printed answers; empty if there is none. */
  get passed(): string {
    return this.#passed;
  }

  #judge(result: Verdict["result"] | "", sentence: string): void {
    this.element.dataset.result = result;
    const sign = { pass: "✓ ", refuse: "✗ ", no: "✗ ", near: "≈ ", "": "" }[result];
    setText(this.#verdict, sign + sentence);
  }

  #showHint(): void {
    this.#list.hidden = false;
    this.#hints[this.#hinted]!.hidden = false;
    this.#hinted += 1;
    const left = this.#hinted < this.#hints.length;
    this.#hint.hidden = !left;
    if (left) setText(this.#hint.querySelector("span")!, this.#learn.hint(this.#hinted + 1));
  }
}
