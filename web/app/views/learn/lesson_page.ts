/** The text of one lesson in one language: its parts, of which one is shown. */

import { BEATS, type Beat, type Lesson, type Verdict } from "../../../lessons/lesson";
import type { LearnText, LessonText, Said } from "../../../lessons/text/text";
import { button } from "../../../ui/controls/buttons";
import { html, setText } from "../../../ui/dom";
import { BetPanel } from "./bet_panel";
import { EquationPanel } from "./equation";
import { ExerciseCard } from "./exercise_card";
import type { LessonProgress } from "./progress";
import { paragraphs, prose } from "./prose";

interface LessonPageListeners {
  onBeat: (beat: number) => void;
  onBet: (option: string) => void;
  onWords: (words: string) => void;
  onBegin: (exercise: string) => void;
  onSolution: (exercise: string) => void;
  onLink: () => void;
}

/** Options of a page, fixed while it is open. */
interface LessonPageOptions {
  /** Whether solutions are offered. */
  answers: boolean;
  /** Titles of the previous and the next lesson; `undefined` if there is none. */
  previous: string | undefined;
  next: string | undefined;
}

/** State of a page other than its text. */
interface LessonPageState {
  beat: number;
  task: string;
  progress: LessonProgress;
  kept: boolean;
}

/** Parts that would reveal the answer to the bet. */
const LOCKED: readonly Beat[] = ["look", "why"];

export class LessonPage {
  readonly element: HTMLElement;
  readonly #learn: LearnText;
  readonly #beside: Pick<LessonPageOptions, "previous" | "next">;
  readonly #parts: Record<Beat, HTMLElement>;
  readonly #locks: HTMLElement[] = [];
  readonly #steps: HTMLButtonElement[];
  readonly #previous: HTMLButtonElement;
  readonly #next: HTMLButtonElement;
  readonly #bet: BetPanel;
  readonly #equation: EquationPanel;
  readonly #words: HTMLTextAreaElement;
  readonly #kept = html("p", { class: "caption" });
  readonly #cards: Map<string, ExerciseCard>;
  readonly #answers = html("section", { class: "learn-answers" });
  #beat = 0;

  constructor(
    lesson: Lesson,
    text: LessonText,
    learn: LearnText,
    { answers, previous, next }: LessonPageOptions,
    listeners: LessonPageListeners,
  ) {
    this.#learn = learn;
    this.#beside = { previous, next };
    this.#bet = new BetPanel(lesson, text, learn, listeners.onBet);
    this.#equation = new EquationPanel(lesson, text, learn);
    this.#words = html("textarea", { rows: 5, "aria-label": learn.yourWords });
    this.#words.addEventListener("input", () => listeners.onWords(this.#words.value));
    this.#cards = new Map(
      lesson.exercises.map(({ id }) => [
        id,
        new ExerciseCard(id, text.exercises[id]!, learn, answers, {
          onBegin: () => listeners.onBegin(id),
          onSolution: () => listeners.onSolution(id),
          onLink: listeners.onLink,
        }),
      ]),
    );
    const content: Record<Beat, HTMLElement[]> = {
      idea: paragraphs(text.idea),
      bet: [this.#bet.element],
      look: [...paragraphs(text.look.slice(0, 1)), this.#equation.element, ...paragraphs(text.look.slice(1))],
      why: [html("p", {}, ...prose(text.why)), this.#words, this.#kept],
      exercises: [...this.#cards.values()].map((card) => card.element),
      sources: [html("ul", {}, ...text.sources.map((source) => html("li", {}, ...prose(source))))],
    };
    const part = (beat: Beat) => {
      const body = html("div", { class: "learn-body" }, ...content[beat]);
      const lock = LOCKED.includes(beat) ? [this.#lock(body, listeners)] : [];
      return html(
        "section",
        { class: "learn-part", "data-beat": beat },
        html("h2", {}, learn.beats[beat]),
        ...lock,
        body,
      );
    };
    this.#parts = Object.fromEntries(BEATS.map((beat) => [beat, part(beat)])) as Record<Beat, HTMLElement>;
    this.#steps = BEATS.map((beat, i) => {
      const name = `${i + 1}: ${learn.beats[beat]}`;
      const step = html("button", { type: "button", class: "button", title: name, "aria-label": name }, String(i + 1));
      step.addEventListener("click", () => listeners.onBeat(i));
      return step;
    });
    this.#previous = button(learn.previous, () => listeners.onBeat(this.#beat - 1), { label: true, class: "turn" });
    this.#next = button(learn.next, () => listeners.onBeat(this.#beat + 1), { label: true, class: "turn next" });
    this.element = html(
      "div",
      { class: "learn-page" },
      html("nav", { class: "learn-steps", "aria-label": learn.parts }, ...this.#steps),
      html("div", { class: "learn-parts" }, ...Object.values(this.#parts), this.#answers),
      html("footer", { class: "learn-turn" }, this.#previous, this.#next),
    );
  }

  show({ beat, task, progress, kept }: LessonPageState): void {
    if (beat !== this.#beat) this.#parts[BEATS[beat]!].parentElement!.scrollTop = 0;
    this.#beat = beat;
    const open = progress.bet !== undefined;
    for (const [i, name] of BEATS.entries()) {
      this.#parts[name].hidden = i !== beat;
      const step = this.#steps[i]!;
      if (i === beat) step.setAttribute("aria-current", "step");
      else step.removeAttribute("aria-current");
    }
    for (const lock of this.#locks) {
      lock.hidden = open;
      (lock.nextElementSibling as HTMLElement).hidden = !open;
    }
    this.#bet.show(progress.bet);
    if (document.activeElement !== this.#words) this.#words.value = progress.words;
    setText(this.#kept, kept ? this.#learn.keptHere : this.#learn.notKept);
    for (const [id, card] of this.#cards)
      card.show({ active: id === task, tries: progress.tries[id] ?? 0, solved: progress.solved.includes(id) });
    this.#turn(this.#previous, beat - 1);
    this.#turn(this.#next, beat + 1);
  }

  /** Whether a part is locked until the bet is placed. */
  static isLocked(beat: Beat, bet: string | undefined): boolean {
    return bet === undefined && LOCKED.includes(beat);
  }

  set values(values: Readonly<Record<string, string>>) {
    this.#equation.values = values;
  }

  reveal(...sentences: string[]): void {
    this.#bet.reveal(...sentences);
  }

  judge(exercise: string, verdict: Verdict, said: Said): void {
    this.#cards.get(exercise)?.judge(verdict, said);
  }

  fail(exercise: string, sentence: string): void {
    this.#cards.get(exercise)?.fail(sentence);
  }

  /** Highlights the words and symbols of a term. */
  light(term: string | undefined): void {
    for (const mark of this.element.querySelectorAll("[data-term]"))
      mark.classList.toggle("lit", mark.getAttribute("data-term") === term);
  }

  /** Prints the known answers at the end of the page. */
  printAnswers(): void {
    const said = [this.#bet.revealed, ...[...this.#cards].map(([id, card]) => card.passed && `${id}: ${card.passed}`)];
    this.#answers.replaceChildren(...said.filter((line) => line !== "").map((line) => html("p", {}, line)));
  }

  #turn(control: HTMLButtonElement, beat: number): void {
    const part = BEATS[beat];
    // Before the first and after the last part are the neighbouring lessons.
    const to = part ? this.#learn.beats[part] : beat < 0 ? this.#beside.previous : this.#beside.next;
    control.hidden = to === undefined;
    if (to) setText(control.querySelector("span")!, to);
    control.title = control === this.#next ? this.#learn.next : this.#learn.previous;
  }

  #lock(body: HTMLElement, { onBet, onBeat }: LessonPageListeners): HTMLElement {
    const learn = this.#learn;
    const lock = html(
      "div",
      { class: "lock" },
      html("p", {}, learn.locked),
      html(
        "div",
        { class: "actions" },
        button(learn.beats.bet, () => onBeat(BEATS.indexOf("bet")), { label: true, class: "outlined" }),
        button(learn.skip, () => onBet(""), { label: true }),
      ),
    );
    body.hidden = true;
    this.#locks.push(lock);
    return lock;
  }
}
