/** The Learn view: a lesson at the left, its figures at the right; every state of both is a link. */
import "../../../ui/controls/text_field.css";
import "katex/dist/katex.min.css";
import "./learn.css";
import { isCancellation } from "../../../client/protocol";
import { LANGUAGES, type Language } from "../../../figures/languages";
import { engines, startEngine } from "../../../figures/shared";
import { BEATS, judge, type Lesson } from "../../../lessons/lesson";
import { LESSONS, type LessonEntry, lessonBeside, lessonOf } from "../../../lessons/lessons";
import { TEXTS } from "../../../lessons/text";
import type { LearnText, LessonText } from "../../../lessons/text/text";
import { button } from "../../../ui/controls/buttons";
import { icon } from "../../../ui/controls/icons";
import { html, saveFile } from "../../../ui/dom";
import { isDark, onSystemTheme } from "../../../ui/theme";
import { type AppState, toHash } from "../../state/state";
import { announce } from "../../ui/announce";
import { askInDialog, dialogActions } from "../../ui/dialog";
import { errorText } from "../../ui/words";
import type { KeyTable, View, ViewHost } from "../../view";
import { showFigureCode } from "./figure_dialog";
import { LessonFigures } from "./lesson_figures";
import { LessonPage } from "./lesson_page";
import { ProgressStore } from "./progress";
import { saidIn } from "./said";

export function createView(host: ViewHost): View {
  return new LearnView(host);
}

export function prepare({ lesson }: Readonly<AppState>): void {
  startEngine(lessonOf(lesson).begin);
}

/** An open lesson, in a language. */
interface Open {
  key: string;
  lesson: Lesson;
  text: LessonText;
  language: Language;
  page: LessonPage;
  figures: LessonFigures;
}

class LearnView implements View {
  readonly element = html("main", { class: "view learn" });
  readonly #host: ViewHost;
  readonly #progress = new ProgressStore();
  readonly #text = html("section", { class: "learn-text" });
  readonly #head = html("header", { class: "learn-head" });
  readonly #engine = engines.lease();
  #open: Open | undefined;
  /** Key of the lesson and language that are open, or are being loaded. */
  #wanted = "";
  #shown = new AbortController();
  /** The term highlighted by a tap. */
  #tapped: string | undefined;
  /** Counter of the checks: only the answer of the last one is shown. */
  #check = 0;

  constructor(host: ViewHost) {
    this.#host = host;
    startEngine(lessonOf(this.#state.lesson).begin);
    this.element.append(this.#text);
    this.#listenToTerms();
  }

  get history() {
    return this.#host.store;
  }

  get keys(): KeyTable {
    const { beat, present } = this.#state;
    if (!present) return {};
    return {
      ArrowLeft: () => this.#turnTo(beat - 1),
      ArrowRight: () => this.#turnTo(beat + 1),
      r: () => this.#reset(),
      l: () => void this.#copyLink({ present: false, task: "" }, this.#words.linkToFigure),
      Escape: () => this.#host.store.edit({ present: false }),
    };
  }

  show(): void {
    this.#shown = new AbortController();
    const { signal } = this.#shown;
    this.#host.store.subscribe((_, changed) => this.#showState(changed.has("figures") || changed.has("task")), signal);
    onSystemTheme(() => this.#showState(false), signal);
    addEventListener("beforeprint", () => this.#open?.page.printAnswers(), { signal });
    this.#showState(false);
  }

  hide(): void {
    this.#shown.abort();
  }

  dispose(): void {
    this.hide();
    this.element.replaceChildren();
    this.#engine.release();
  }

  get #state(): Readonly<AppState> {
    return this.#host.store.state;
  }

  get #language(): Language {
    return LANGUAGES.find((language) => language === this.#state.language) ?? LANGUAGES[0]!;
  }

  get #words(): LearnText {
    return TEXTS[this.#language].learn;
  }

  /** @param arrived whether figures or task have changed */
  #showState(arrived: boolean): void {
    const entry = lessonOf(this.#state.lesson);
    const language = this.#language;
    const key = `${entry.id}/${language}/${this.#state.hide}`;
    if (this.#wanted !== key) {
      this.#wanted = key;
      void this.#load(entry, language, key);
      return;
    }
    const open = this.#open;
    // Another lesson than the one that is being loaded has other ranges.
    if (open?.key !== key) return;
    const { beat, present, task, hide, theme } = this.#state;
    const figures = open.lesson.clean(this.#state.figures);
    if (figures !== this.#state.figures) {
      this.#host.store.adopt({ figures });
      return;
    }
    const hidden = hide.split(",");
    const progress = this.#progress.of(open.lesson.id);
    const locked = LessonPage.isLocked(BEATS[beat]!, progress.bet);
    this.element.classList.toggle("present", present);
    this.element.classList.toggle("bare", hidden.includes("text"));
    open.page.show({ beat, task, progress, kept: this.#progress.kept });
    open.figures.show({
      figures,
      beat,
      locked,
      solved: progress.solved,
      theme: isDark(theme) ? "dark" : "light",
      large: present,
      controls: !hidden.includes("controls"),
    });
    const exercise = open.lesson.exercises.find(({ id }) => id === task);
    if (!arrived || !exercise || this.#byHand) return;
    open.figures.bring(exercise.figure);
    void this.#checkTask(false);
  }

  /** Whether the displayed change is part of a drag. */
  #byHand = false;

  async #load(entry: LessonEntry, language: Language, key: string): Promise<void> {
    try {
      const [lesson, text] = await Promise.all([entry.load(), TEXTS[language].lessons[entry.id]!()]);
      if (this.#wanted !== key) return;
      this.#build(key, entry, lesson, text, language);
    } catch (error) {
      if (this.#wanted === key) this.#wanted = "";
      this.#host.toasts.failure(error);
    }
  }

  #build(key: string, entry: LessonEntry, lesson: Lesson, text: LessonText, language: Language): void {
    const { learn } = TEXTS[language];
    const { store } = this.#host;
    const { id } = lesson;
    const beside = [-1, 1].map((by) => learn.titles[lessonBeside(id, by)?.id ?? ""]);
    const answers = !this.#state.hide.split(",").includes("answers");
    const page = new LessonPage(
      lesson,
      text,
      learn,
      { answers, previous: beside[0], next: beside[1] },
      {
        onBeat: (beat) => this.#turnTo(beat),
        onBet: (bet) => {
          this.#progress.change(id, { bet });
          this.#showState(false);
          void this.#reveal();
        },
        onWords: (words) => {
          this.#progress.change(id, { words });
          this.#showState(false);
        },
        onBegin: (task) => this.#begin(task),
        onSolution: (task) => void this.#solve(task),
        onLink: () => void this.#copyLink({}, learn.copied),
      },
    );
    const figures = new LessonFigures(lesson, language, learn.figures, {
      onState: ({ state, settled }) => {
        this.#byHand = true;
        store.edit({ figures: lesson.clean(state) }, "figure");
        this.#byHand = false;
        if (!settled) return;
        store.endGesture();
        void this.#checkTask(true);
      },
      onValues: (values) => {
        page.values = values;
      },
      onPoint: (term) => this.#light(term),
    });
    this.#open = { key, lesson, text, language, page, figures };
    this.#showHead(entry, learn);
    this.#text.lang = language;
    this.#text.replaceChildren(this.#head, page.element, this.#foot(learn));
    this.element.replaceChildren(this.#text, figures.element);
    this.#showState(true);
    void figures.ready().then(() => figures.prefetch());
    if (this.#progress.of(id).bet !== undefined) void this.#reveal();
  }

  #showHead(entry: LessonEntry, learn: LearnText): void {
    const { store } = this.#host;
    const language = html("select", { "aria-label": learn.language });
    for (const name of LANGUAGES)
      language.append(html("option", { value: name, lang: name }, TEXTS[name].learn.languageName));
    language.value = this.#language;
    language.addEventListener("change", () => store.edit({ language: language.value }));
    const lessons = html("select", { "aria-label": learn.lesson });
    for (const [i, { id }] of LESSONS.entries()) {
      const name = learn.lessonOf(i + 1, LESSONS.length);
      lessons.append(html("option", { value: id }, `${name}: ${learn.titles[id]}`));
    }
    lessons.value = entry.id;
    lessons.addEventListener("change", () => this.#goTo(lessonOf(lessons.value), 0));
    const present = button(learn.present, () => store.edit({ present: !this.#state.present }), { icon: "fullscreen" });
    this.#head.replaceChildren(
      html(
        "div",
        { class: "learn-tools" },
        html("div", { class: "select plain-select lessons" }, lessons, icon("chevron")),
        html("div", { class: "select plain-select" }, language, icon("chevron")),
        button(learn.embed, () => this.#embed(), { icon: "embed" }),
        present,
      ),
      html("h1", { class: "learn-title", tabindex: -1 }, learn.titles[entry.id]!),
    );
  }

  #foot(learn: LearnText): HTMLElement {
    const file = html("input", {
      type: "file",
      accept: ".json,application/json",
      hidden: true,
      "aria-label": learn.importProgress,
    });
    file.addEventListener("change", async () => {
      const [given] = file.files ?? [];
      if (given) this.#note(this.#progress.import(await given.text()), learn.imported, learn.notImported);
      file.value = "";
    });
    const act = (name: string, run: () => void) => button(name, run, { label: true });
    return html(
      "details",
      { class: "learn-progress" },
      html("summary", {}, learn.progress),
      html(
        "div",
        { class: "actions" },
        act(learn.exportProgress, () =>
          saveFile("strut-lessons.json", new Blob([this.#progress.export()], { type: "application/json" })),
        ),
        act(learn.importProgress, () => file.click()),
        act(learn.eraseProgress, () => void this.#erase(learn)),
        act(learn.print, () => print()),
        file,
      ),
    );
  }

  async #erase(learn: LearnText): Promise<void> {
    const erases = await askInDialog<true>("learn-erase", learn.eraseQuestion, (choose, cancel) => [
      dialogActions(
        button(learn.close, cancel, { label: true }),
        button(learn.eraseProgress, () => choose(true), { label: true, class: "outlined" }),
      ),
    ]);
    if (!erases) return;
    this.#progress.erase();
    this.#note(true, learn.erased, "");
  }

  #note(well: boolean, done: string, failed: string): void {
    if (well) this.#host.toasts.note(done);
    else this.#host.toasts.error(failed);
    this.#showState(false);
    void this.#reveal();
  }

  #turnTo(beat: number): void {
    if (beat < 0 || beat >= BEATS.length) {
      const beside = lessonBeside(this.#state.lesson, Math.sign(beat));
      if (beside) this.#goTo(beside, beat < 0 ? BEATS.length - 1 : 0);
      return;
    }
    this.#host.store.edit({ beat });
    announce(this.#words.beats[BEATS[beat]!]);
  }

  #embed(): void {
    if (!this.#open) return;
    const { figures, language } = this.#open;
    const shown = { site: new URL(".", location.href).href, language, state: this.#state.figures };
    void showFigureCode(
      figures.shown.map((figure) => ({ ...shown, ...figure })),
      this.#words,
    );
  }

  #goTo({ id }: LessonEntry, beat: number): void {
    this.#host.store.edit({ lesson: id, beat, task: "", figures: "" });
    announce(this.#words.titles[id]!);
  }

  #reset(): void {
    this.#host.store.edit({ figures: "", task: "" });
    announce(this.#words.resetFigures);
  }

  async #reveal(): Promise<void> {
    const open = this.#open;
    if (!open) return;
    const { lesson, language, page, text, figures } = open;
    const { bet } = this.#progress.of(lesson.id);
    if (bet === undefined || this.#state.hide.split(",").includes("answers")) return;
    const { learn } = TEXTS[language];
    try {
      // The engine answers in order: the visible figures come first.
      await figures.ready();
      const { answer, measure } = await lesson.bet.reveal(this.#engine.value);
      const how = bet === "" ? learn.skipped : bet === answer ? learn.right : learn.wrong;
      page.reveal(how, text.bet.reveal(saidIn(language, measure, lesson.decimals)));
    } catch (error) {
      if (!isCancellation(error)) page.reveal(learn.failed(errorText(error)));
    }
  }

  #begin(task: string): void {
    const exercise = this.#open?.lesson.exercises.find(({ id }) => id === task);
    if (!exercise) return;
    this.#byHand = true;
    this.#host.store.edit({ task, figures: exercise.start(this.#state.figures) });
    this.#byHand = false;
    this.#open?.figures.bring(exercise.figure);
  }

  async #solve(task: string): Promise<void> {
    const open = this.#open;
    const exercise = open?.lesson.exercises.find(({ id }) => id === task);
    if (!open || !exercise) return;
    try {
      const figures = await exercise.solve(this.#engine.value);
      if (this.#open !== open) return;
      this.#host.store.edit({ task, figures });
      open.figures.bring(exercise.figure);
      // The state may already be the same.
      void this.#checkTask(false);
    } catch (error) {
      open.page.fail(task, this.#words.failed(errorText(error)));
    }
  }

  /** Checks the current exercise. @param counts whether it was the learner's own answer, which is stored in the progress */
  async #checkTask(counts: boolean): Promise<void> {
    const open = this.#open;
    const { task } = this.#state;
    const exercise = open?.lesson.exercises.find(({ id }) => id === task);
    if (!open || !exercise) return;
    const check = ++this.#check;
    try {
      const measure = await open.figures.measure(exercise.figure);
      if (check !== this.#check || this.#open !== open || this.#state.task !== task) return;
      const verdict = judge(exercise, measure);
      if (counts) this.#remember(open.lesson.id, task, verdict.result === "pass");
      open.page.judge(task, verdict, saidIn(open.language, measure, open.lesson.decimals));
    } catch (error) {
      if (check === this.#check) open.page.fail(task, this.#words.failed(errorText(error)));
    }
  }

  #remember(lesson: string, task: string, passed: boolean): void {
    const { solved, tries } = this.#progress.of(lesson);
    if (solved.includes(task)) return;
    if (passed) this.#progress.change(lesson, { solved: [...solved, task] });
    else this.#progress.change(lesson, { tries: { ...tries, [task]: (tries[task] ?? 0) + 1 } });
    this.#showState(false);
  }

  async #copyLink(patch: Partial<AppState>, done: string): Promise<void> {
    const url = new URL(location.href);
    url.hash = toHash({ ...this.#state, ...patch });
    try {
      await navigator.clipboard.writeText(url.href);
      this.#host.toasts.note(done);
    } catch {
      this.#host.toasts.error(this.#words.notCopied);
    }
  }

  /** Hovering or focusing a term highlights its words, symbols and marks. */
  #listenToTerms(): void {
    const listen = (type: string, act: (term: string | undefined) => void) =>
      this.#text.addEventListener(type, ({ target }) => act(termOf(target)));
    listen("pointerover", (term) => this.#light(term));
    listen("pointerleave", () => this.#light(undefined));
    listen("focusin", () => this.#light(undefined));
    listen("focusout", () => this.#light(undefined));
    listen("click", (term) => {
      this.#tapped = term === this.#tapped ? undefined : term;
      this.#light(term);
    });
  }

  /** @param pointed the hovered term; without one, that of the focused element is highlighted, or the tapped one */
  #light(pointed: string | undefined): void {
    const focused = this.#text.contains(document.activeElement) ? termOf(document.activeElement) : undefined;
    const lit = pointed ?? focused ?? this.#tapped;
    this.#open?.page.light(lit);
    this.#open?.figures.light(lit);
  }
}

function termOf(target: EventTarget | null): string | undefined {
  return target instanceof Element
    ? (target.closest("[data-term]")?.getAttribute("data-term") ?? undefined)
    : undefined;
}
