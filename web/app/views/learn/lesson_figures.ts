/** The figures of a lesson with one common state. */
import { defineFigure, type StateChange, type StrutFigure } from "../../../figures/figure_element";
import type { Measure } from "../../../figures/kind";
import type { Language } from "../../../figures/languages";
import { BEATS, type Lesson } from "../../../lessons/lesson";
import { html } from "../../../ui/dom";

export interface FigureListeners {
  onState: (change: StateChange) => void;
  /** Called when the values of the figures have changed. */
  onValues: (values: Readonly<Record<string, string>>) => void;
  onPoint: (term: string | undefined) => void;
}

/** State of the figures. */
interface FiguresState {
  figures: string;
  /** The part of the lesson, and how much of the bet's answer it may reveal. */
  beat: number;
  locked: boolean;
  /** The solved exercises. */
  solved: readonly string[];
  theme: "dark" | "light";
  large: boolean;
  controls: boolean;
}

export class LessonFigures {
  readonly element: HTMLElement;
  readonly #lesson: Lesson;
  readonly #figures: Map<string, StrutFigure>;
  readonly #listeners: FigureListeners;

  constructor(lesson: Lesson, language: Language, label: string, listeners: FigureListeners) {
    defineFigure();
    this.#lesson = lesson;
    this.#listeners = listeners;
    this.#figures = new Map(
      lesson.figures.map(({ name, kind }) => {
        const figure = html("strut-figure", { kind, lang: language, "data-name": name });
        return [name, figure];
      }),
    );
    this.element = html("section", { class: "learn-figures", "aria-label": label }, ...this.#figures.values());
    this.element.addEventListener("statechange", (event) =>
      listeners.onState((event as CustomEvent<StateChange>).detail),
    );
    this.element.addEventListener("figurechange", () => this.#tellValues());
    this.element.addEventListener("termpoint", (event) =>
      listeners.onPoint((event as CustomEvent<{ term: string | undefined }>).detail.term),
    );
  }

  show({ figures, beat, locked, solved, theme, large, controls }: FiguresState): void {
    // Until the bet is placed, only the figures of the bet are shown.
    const name = BEATS[locked ? BEATS.indexOf("bet") : beat]!;
    const shown = this.#lesson.figures.filter(
      ({ beats, after }) => beats.includes(name) && (after === undefined || solved.includes(after)),
    );
    for (const one of this.#lesson.figures) {
      const { name: id, explained } = one;
      const figure = this.#figures.get(id)!;
      figure.hidden = !shown.includes(one);
      figure.toggleAttribute("large", large);
      figure.setAttribute("theme", theme);
      figure.setAttribute("hide", hiddenIn(controls, explained.includes(name)));
      figure.state = figures;
    }
    this.element.dataset.shown = String(shown.length);
    this.#tellValues();
  }

  /** The measurement by which exercises are judged. @throws what the engine throws */
  measure(figure: string): Promise<Measure> {
    return this.#figures.get(figure)!.measure();
  }

  /** Scrolls a figure into view: there may not be room for all. */
  bring(figure: string): void {
    this.#figures.get(figure)?.scrollIntoView({ block: "nearest", inline: "nearest" });
  }

  /** The figures that are currently in the page. */
  get shown(): { kind: string; heading: string }[] {
    return this.#lesson.figures.flatMap(({ name, kind }) => {
      const { hidden, heading } = this.#figures.get(name)!;
      return hidden ? [] : [{ kind, heading: heading || kind }];
    });
  }

  /** Resolves when the figures in the page show their state. */
  async ready(): Promise<void> {
    await Promise.all(this.#visible.map((figure) => figure.ready()));
  }

  /** Loads the figures of the other parts of the lesson, so that they need no network. */
  async prefetch(): Promise<void> {
    const fonts = [...document.fonts].map((face) => face.load());
    await Promise.allSettled([...fonts, ...[...this.#figures.values()].map((figure) => figure.prefetch())]);
    this.element.dataset.prefetched = "";
  }

  get #visible(): StrutFigure[] {
    return [...this.#figures.values()].filter(({ hidden }) => !hidden);
  }

  /** Figures that are not in the page are ignored: they may still show an earlier state. */
  #tellValues(): void {
    this.#listeners.onValues(Object.assign({}, ...this.#visible.map(({ values }) => values)));
  }

  light(term: string | undefined): void {
    for (const figure of this.#figures.values()) figure.light(term);
  }
}

/** Hidden parts of a figure: those that the lesson has not introduced yet, or all controls. */
function hiddenIn(controls: boolean, explained: boolean): string {
  return [...(controls ? [] : ["controls"]), ...(explained ? [] : ["choices", "marks"])].join(",");
}
