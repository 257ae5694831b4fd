/** `<strut-figure>`: one live figure of the engine, on any page. */
import type { LearnEngine } from "../client/learn/protocol";
import { themeOf } from "../element/colours";
import { button } from "../ui/controls/buttons";
import { html, setText } from "../ui/dom";
import type { Measure, TextFigure } from "./kind";
import { loadKind } from "./kinds";
import { LANGUAGES, type Language, WORDS } from "./languages";
import { engines } from "./shared";
import { figureSheets } from "./sheets";
import type { Words } from "./words/words";

/** A change of the state by the user; `settled` when the drag has ended. */
export interface StateChange {
  state: string;
  settled: boolean;
}

/** Minimum time between two announcements of the figure's sentence, milliseconds. */
const SAY_MS = 1000;

/**
 * Attributes: `kind`; `state`, the text of a link; `lang`; `hide`, a comma-separated list of `controls` and `table`; `theme`;
 * `poster`, the URL of a picture that is shown until the figure is ready.
 * Events: `statechange` with a {@link StateChange}; `figurechange` when the displayed values change; `termpoint` with the term
 * of the hovered mark.
 */
export class StrutFigure extends HTMLElement {
  static readonly observedAttributes = ["kind", "state", "lang", "poster"];
  readonly #container = html("div", { class: "figure" });
  readonly #message = html("p", { class: "message" });
  readonly #poster = html("img", { class: "poster", alt: "", hidden: true });
  /** Has the colour of the page's theme, and a transition that reports its changes. */
  readonly #probe = html("span", { class: "probe", "aria-hidden": "true" });
  readonly #live = html("p", { class: "visually-hidden", role: "status" });
  readonly #table = html("details", { class: "table" });
  #life: AbortController | undefined;
  #figure: TextFigure | undefined;
  /** Aborts with the figure: another kind or language creates another one. */
  #figureLife: AbortController | undefined;
  #engine: LearnEngine | undefined;
  /** Settles when the last state that was set is displayed. */
  #shown: Promise<void> = Promise.resolve();
  #opened: Promise<void> | undefined;
  #saying: ReturnType<typeof setTimeout> | undefined;
  #onScreen = false;
  /** Whether it is rendered on the page; querying the document at every change would cause a layout. */
  #placed = false;
  /** The displayed state, or the one that is being displayed. */
  #state: string | undefined;

  /** Whether the state was changed by a drag that has not ended. */
  #held = false;

  constructor() {
    super();
    const root = this.attachShadow({ mode: "open" });
    root.adoptedStyleSheets = figureSheets();
    root.append(this.#poster, this.#container, this.#message, this.#table, this.#probe, this.#live);
    this.#probe.addEventListener("transitionrun", () => this.#takeTheme());
    this.#table.addEventListener("toggle", () => this.#showTable());
    // Keys handled by a control must not reach the page around it.
    root.addEventListener("keydown", (event) => {
      const { target, ctrlKey, metaKey, altKey } = event as KeyboardEvent;
      const own = target instanceof Element && target.matches("select, input, [role=slider]");
      if (own && !ctrlKey && !metaKey && !altKey) event.stopPropagation();
    });
    // A key press has ended.
    for (const type of ["keyup", "focusout"])
      root.addEventListener(type, () => {
        if (this.#held) this.#tellState(true);
      });
  }

  connectedCallback(): void {
    this.#life = new AbortController();
    const { signal } = this.#life;
    const engine = engines.lease();
    this.#engine = engine.value;
    signal.addEventListener("abort", engine.release, { once: true });
    const observer = new IntersectionObserver(([entry]) => {
      this.#onScreen = entry!.isIntersecting;
      if (this.#onScreen) void this.ready();
      this.#run();
    });
    observer.observe(this);
    const places = new ResizeObserver(([entry]) => {
      this.#placed = entry!.borderBoxSize[0]!.inlineSize > 0;
      if (this.#placed && this.#opened) this.#show();
    });
    places.observe(this);
    signal.addEventListener(
      "abort",
      () => {
        observer.disconnect();
        places.disconnect();
      },
      { once: true },
    );
    document.addEventListener("visibilitychange", () => this.#run(), { signal });
    this.#say(this.#words.loading);
  }

  disconnectedCallback(): void {
    this.#close();
    this.#life?.abort();
    this.#life = undefined;
    clearTimeout(this.#saying);
    this.#saying = undefined;
  }

  attributeChangedCallback(name: string, before: string | null, after: string | null): void {
    if (name === "poster") this.#showPoster();
    else if (before === after || !this.#opened) return;
    else if (name === "state") {
      // A figure that is not rendered is displayed once it is rendered, or measured.
      if (this.#placed) this.#show();
    } else {
      this.#close();
      void this.ready();
    }
  }

  /** The state as the text of a link. */
  get state(): string {
    return this.getAttribute("state") ?? "";
  }

  set state(state: string) {
    this.setAttribute("state", state);
  }

  /** The figure's heading; empty before it is loaded. */
  get heading(): string {
    return this.#container.querySelector("h3")?.textContent ?? "";
  }

  /** Loads the figure now, whether visible or not. Resolves when its state is displayed. */
  async ready(): Promise<void> {
    if (!this.#life) return;
    if (!this.#opened) {
      this.#figureLife = new AbortController();
      this.#opened = this.#open(this.#figureLife.signal);
    }
    await this.#opened;
    this.#show();
    await this.#shown;
  }

  /** Loads the code of the figure, so that it needs no network when it becomes visible. */
  async prefetch(): Promise<void> {
    await loadKind(this.getAttribute("kind") ?? "");
  }

  /** The measures for the exercises. @throws StrutError */
  async measure(): Promise<Measure> {
    await this.ready();
    if (!this.#figure) throw new Error(this.#message.textContent ?? "");
    return this.#figure.measure();
  }

  /** Values with units of the displayed symbols, by term. */
  get values(): Readonly<Record<string, string>> {
    return this.#figure?.values() ?? {};
  }

  /** Highlights the marks of a term, or none. */
  light(term: string | undefined): void {
    this.#figure?.light(term);
  }

  get #words(): Words {
    return WORDS[this.#language];
  }

  get #language(): Language {
    return LANGUAGES.find((language) => language === this.lang) ?? "en";
  }

  async #open(signal: AbortSignal): Promise<void> {
    const words = this.#words;
    const name = this.getAttribute("kind") ?? "";
    this.#table.replaceChildren(html("summary", {}, words.table));
    try {
      const kind = await loadKind(name);
      if (signal.aborted || this.#figure) return;
      if (!kind) {
        this.#say(words.unknown(name));
        return;
      }
      this.shadowRoot!.adoptedStyleSheets = figureSheets(kind.sheet);
      this.#figure = kind.create({
        container: this.#container,
        engine: this.#engine!,
        language: this.#language,
        words,
        change: (state, settled) => {
          // Grabbing a knob settles the previous state.
          if (settled && !this.#held && state === this.#state) return;
          this.#state = state;
          this.state = state;
          this.#take(state);
          this.#tellState(settled);
        },
        point: (term) => this.#tell("termpoint", { term }),
        changed: () => this.#changed(),
        signal,
      });
      this.#takeTheme();
      this.#run();
      this.#show();
      await this.#shown;
    } catch (error) {
      if (signal.aborted) return;
      this.#fail(error);
      // After a failure, loading is tried again at the next request, or at a click.
      if (this.#figure) return;
      this.#opened = undefined;
      this.#message.append(
        " ",
        button(words.retry, () => void this.ready(), { label: true, class: "outlined" }),
      );
    }
  }

  #show(): void {
    if (!this.#figure || this.#state === this.state) return;
    this.#state = this.state;
    this.#take(this.#state);
  }

  /** Shows a state, and an error if that fails. */
  #take(state: string): void {
    this.#shown = this.#figure!.show(state).then(
      () => {
        this.#container.classList.add("shown");
        this.#say("");
      },
      (error: unknown) => this.#fail(error),
    );
  }

  #fail(error: unknown): void {
    this.#say(this.#words.failed(error instanceof Error ? error.message : String(error)));
  }

  #takeTheme(): void {
    this.#figure?.stage?.setTheme(themeOf(this.#probe));
    this.#figure?.repaint?.();
  }

  #run(): void {
    this.#figure?.stage?.run(this.#onScreen && document.visibilityState === "visible");
  }

  #close(): void {
    this.#figure?.stage?.dispose();
    this.#figureLife?.abort();
    this.#figureLife = undefined;
    this.#figure = undefined;
    this.#opened = undefined;
    this.#state = undefined;
    this.#container.classList.remove("shown");
    this.#container.replaceChildren();
  }

  #say(message: string): void {
    setText(this.#message, message);
    this.#message.hidden = message === "";
    this.#showPoster();
  }

  /** The poster is shown until the figure is visible. */
  #showPoster(): void {
    const address = this.getAttribute("poster");
    this.#poster.hidden = address === null || this.#message.hidden;
    if (address !== null && this.#poster.getAttribute("src") !== address) this.#poster.src = address;
  }

  #changed(): void {
    // Some of its values may still be being computed.
    this.#container.classList.add("shown");
    this.#tell("figurechange", undefined);
    if (this.#saying !== undefined) return;
    this.#saying = setTimeout(() => {
      this.#saying = undefined;
      if (!this.#figure) return;
      setText(this.#live, this.#figure.sentence());
      this.#showTable();
    }, SAY_MS);
  }

  #showTable(): void {
    if (!this.#table.open || !this.#figure) return;
    const { head, rows } = this.#figure.table();
    const row = (cells: readonly string[], tag: "th" | "td") =>
      html("tr", {}, ...cells.map((cell) => html(tag, tag === "th" ? { scope: "col" } : {}, cell)));
    const table = html(
      "table",
      {},
      html("caption", {}, this.#figure.sentence()),
      html("thead", {}, row(head, "th")),
      html("tbody", {}, ...rows.map((cells) => row(cells, "td"))),
    );
    this.#table.replaceChildren(this.#table.firstElementChild!, html("div", { class: "scroll", tabindex: 0 }, table));
  }

  #tellState(settled: boolean): void {
    this.#held = !settled;
    this.#tell("statechange", { state: this.state, settled } satisfies StateChange);
  }

  #tell(type: string, detail: unknown): void {
    this.dispatchEvent(new CustomEvent(type, { detail, bubbles: true, composed: true }));
  }
}

/** Defines the element, once. */
export function defineFigure(): void {
  if (!customElements.get("strut-figure")) customElements.define("strut-figure", StrutFigure);
}

declare global {
  interface HTMLElementTagNameMap {
    "strut-figure": StrutFigure;
  }
}
