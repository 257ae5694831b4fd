/** `<strut-figure>`: one live figure of the engine, on any page. */
import type { LearnEngine } from "../../client/learn/protocol";
import { button } from "../../ui/controls/buttons";
import { html, setText } from "../../ui/dom";
import { themeOf } from "../colours";
import type { FigureInstance, Measure } from "./kind";
import { loadKind } from "./kinds";
import { LANGUAGES, type Language, WORDS } from "./languages";
import { joinEngine, leaveEngine } from "./shared";
import { figureSheets } from "./sheets";
import type { Words } from "./words/words";

/** A person changed the state; `settled` where the hand has let go. */
export interface StateChange {
  state: string;
  settled: boolean;
}

/** The figure's sentence is said so often at most, milliseconds. */
const SAY_MS = 1000;

/**
 * Attributes: `kind`; `state`, the text of a link; `lang`; `hide`, of `controls` and `table`, with commas; `theme`;
 * `poster`, the address of a picture that is shown until the figure can be.
 * Events: `statechange` with a {@link StateChange}; `figurechange` when it shows other things; `termpoint` with the term of
 * the mark that is pointed at.
 */
export class StrutFigure extends HTMLElement {
  static readonly observedAttributes = ["kind", "state", "lang", "poster"];
  readonly #container = html("div", { class: "figure" });
  readonly #message = html("p", { class: "message" });
  readonly #poster = html("img", { class: "poster", alt: "", hidden: true });
  /** Has the colour of the page's theme, and a transition that tells when it changes. */
  readonly #probe = html("span", { class: "probe", "aria-hidden": "true" });
  readonly #live = html("p", { class: "visually-hidden", role: "status" });
  readonly #table = html("details", { class: "table" });
  #life: AbortController | undefined;
  #figure: FigureInstance<string> | undefined;
  /** Ends with the figure: another kind or language makes another one. */
  #figureLife: AbortController | undefined;
  #engine: LearnEngine | undefined;
  /** Settles when the state is shown that was set last. */
  #shown: Promise<void> = Promise.resolve();
  #opened: Promise<void> | undefined;
  #saying: ReturnType<typeof setTimeout> | undefined;
  #onScreen = false;
  /** Whether it has a place on the page; to ask the document with every change would cost a layout. */
  #placed = false;
  /** The state that is shown, or is going to be. */
  #state: string | undefined;

  /** Whether the state was changed by a hand that has not let go yet. */
  #held = false;

  constructor() {
    super();
    const root = this.attachShadow({ mode: "open" });
    root.adoptedStyleSheets = figureSheets();
    root.append(this.#poster, this.#container, this.#message, this.#table, this.#probe, this.#live);
    this.#probe.addEventListener("transitionrun", () => this.#takeTheme());
    this.#table.addEventListener("toggle", () => this.#showTable());
    // What a control does with a key is not for the page around it.
    root.addEventListener("keydown", (event) => {
      const { target, ctrlKey, metaKey, altKey } = event as KeyboardEvent;
      const own = target instanceof Element && target.matches("select, input, [role=slider]");
      if (own && !ctrlKey && !metaKey && !altKey) event.stopPropagation();
    });
    // The hand has let go of a key.
    for (const type of ["keyup", "focusout"])
      root.addEventListener(type, () => {
        if (this.#held) this.#tellState(true);
      });
  }

  connectedCallback(): void {
    this.#life = new AbortController();
    const { signal } = this.#life;
    this.#engine = joinEngine();
    signal.addEventListener("abort", leaveEngine, { once: true });
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
      // What has no place on the page is shown once it has one, or is measured.
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

  /** Loads the figure now, seen or not; resolves when its state is shown. */
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

  /** Loads what the figure is drawn with, so that it needs no network when it is seen. */
  async prefetch(): Promise<void> {
    await loadKind(this.getAttribute("kind") ?? "");
  }

  /** What exercises are judged by. @throws StrutError */
  async measure(): Promise<Measure> {
    await this.ready();
    if (!this.#figure) throw new Error(this.#message.textContent ?? "");
    return this.#figure.measure();
  }

  /** Values with units of the symbols that it shows, by term. */
  get values(): Readonly<Record<string, string>> {
    return this.#figure?.values() ?? {};
  }

  /** Lights the marks of a term, or none. */
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
          // A knob that is taken hold of settles what was before.
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
      // What could not be loaded is loaded again by whoever asks for it, or by a click.
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

  /** Shows a state, and says why where that fails. */
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

  /** The poster stands for the figure until it can be seen. */
  #showPoster(): void {
    const address = this.getAttribute("poster");
    this.#poster.hidden = address === null || this.#message.hidden;
    if (address !== null && this.#poster.getAttribute("src") !== address) this.#poster.src = address;
  }

  #changed(): void {
    // Some of what it shows may still be computed.
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
