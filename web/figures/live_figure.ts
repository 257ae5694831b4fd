/**
 * The base of all kinds of figures. It keeps the state and the data loaded for it, binds controls to the state, lays out
 * the figure, and reports and highlights its marks. A kind loads its data, draws them, and describes them.
 */
import { Segment, Toggle } from "../ui/controls/buttons";
import type { DialRange } from "../ui/controls/dial";
import { Knob, type KnobText } from "../ui/controls/knob";
import type { Range } from "../ui/controls/range";
import { Slider } from "../ui/controls/slider";
import { html, setText } from "../ui/dom";
import { LatestOnly } from "../ui/latest_only";
import { FRAMES, RATE_HZ } from "./built_in";
import { Choice, GuessField } from "./controls";
import type { FigureInstance, FigureParts, Table } from "./kind";
import { formatNumber, type Words } from "./words/words";

/** The default frame if a link has none. */
const INSTANT = 160;

/** Names of the members of a state that have a type. */
export type NamesOf<State, Type> = { [Name in keyof State]: State[Name] extends Type ? Name : never }[keyof State] &
  string;

/** What is around the picture of a figure. */
interface Layout {
  title: string;
  picture: Element;
  /** Beside the title. */
  head?: readonly Element[];
  /** Below the picture, by default the readout. */
  foot?: readonly Element[];
  footClass?: string;
  controls?: readonly Element[];
  controlsClass?: string;
}

export abstract class LiveFigure<State extends object, Shown> implements FigureInstance<State> {
  protected readonly parts: FigureParts<State>;
  protected readonly words: Words;
  protected readonly heading = html("h3");
  protected readonly readout = html("p", { class: "readout" });
  /** The last state that was set; its data may still be loading. */
  protected state: State | undefined;
  /** The displayed data. */
  protected shown: Shown | undefined;
  /** Whether a state is drawn over the previous data at once, without waiting for its own. */
  protected readonly drawsAhead: boolean = false;
  readonly #loading = new LatestOnly<State>((state) => this.#load(state));
  readonly #controls: ((state: State) => void)[] = [];
  /** Controls that are highlighted with a term. */
  readonly #lights: [control: Element, term: string][] = [];

  constructor(parts: FigureParts<State>) {
    this.parts = parts;
    this.words = parts.words;
  }

  show(state: State): Promise<void> {
    this.state = state;
    for (const control of this.#controls) control(state);
    if (this.drawsAhead && this.shown) this.redraw();
    return this.#loading.take(state);
  }

  sentence(): string {
    return this.state && this.shown ? this.describe(this.shown, this.state) : "";
  }

  table(): Table {
    return { head: this.columns, rows: this.state && this.shown ? this.rows(this.shown, this.state) : [] };
  }

  values(): Readonly<Record<string, string>> {
    return this.state && this.shown ? this.quantities(this.shown, this.state) : {};
  }

  light(term: string | undefined): void {
    const toggle = (mark: Element, of: string | null) => mark.classList.toggle("lit", of === (term ?? ""));
    for (const mark of this.parts.container.querySelectorAll("[data-term]"))
      toggle(mark, mark.getAttribute("data-term"));
    for (const [control, of] of this.#lights) toggle(control, of);
  }

  /** Loads the data of a state; `undefined` if the state has no data. */
  protected abstract load(state: State): Promise<Shown | undefined>;

  /** Displays the current data, and reports the change. */
  protected abstract redraw(): void;

  /** The sentence of the figure. */
  protected abstract describe(shown: Shown, state: State): string;

  /** The head and the rows of the table. */
  protected abstract get columns(): readonly string[];
  protected abstract rows(shown: Shown, state: State): string[][];

  /** Values with units of the displayed symbols, by term. */
  protected quantities(_shown: Shown, _state: State): Readonly<Record<string, string>> {
    return {};
  }

  /** A number in the figure's language. */
  protected number(value: number, digits: number): string {
    return formatNumber(value, digits, this.words);
  }

  /** Changes members of the state; a control that was dragged settles afterwards. */
  protected change(patch: Partial<State>, settled = true): void {
    this.parts.change(patch, settled);
  }

  protected set<Name extends keyof State>(name: Name, value: unknown, settled = true): void {
    this.parts.change({ [name]: value } as Partial<State>, settled);
  }

  protected settle(): void {
    this.parts.change({}, true);
  }

  /** Fills the container. To be called once, when all marks exist. */
  protected lay({
    title,
    picture,
    head = [],
    foot = [this.readout],
    footClass = "foot",
    controls = [],
    controlsClass = "knobs",
  }: Layout): void {
    const { container, point } = this.parts;
    setText(this.heading, title);
    container.append(html("header", { class: "head" }, this.heading, ...head), picture);
    if (foot.length > 0) container.append(html("footer", { class: footClass }, ...foot));
    if (controls.length > 0) container.append(html("div", { class: controlsClass }, ...controls));
    for (const mark of container.querySelectorAll("[data-term]")) {
      mark.addEventListener("pointerenter", () => point(mark.getAttribute("data-term")!));
      mark.addEventListener("pointerleave", () => point(undefined));
    }
  }

  /** A list of options for a member of the state. */
  protected choice<Name extends NamesOf<State, string>>(
    name: Name,
    label: string,
    options: readonly State[Name][],
    labelOf: (option: State[Name]) => string,
  ): HTMLElement {
    const texts = options.map((option) => [option as string, labelOf(option)] as const);
    const control = new Choice<string>(label, texts, (value) => this.set(name, value));
    this.#bind(name, (value) => {
      control.value = value as string;
    });
    return control.element;
  }

  /** A few options for a member of the state. @param term the term that highlights it */
  protected segment<Name extends NamesOf<State, string>>(
    name: Name,
    label: string,
    options: readonly State[Name][],
    labelOf: (option: State[Name]) => string,
    term?: string,
  ): Segment<State[Name] & string> {
    const texts = options.map((value) => ({ value: value as State[Name] & string, label: labelOf(value) }));
    const control = new Segment(label, texts, (value) => this.set(name, value));
    this.#bind(name, (value) => {
      control.value = value as State[Name] & string;
    });
    if (term) this.#lights.push([control.element, term]);
    return control;
  }

  /** A switch for a member of the state. @param also what changes with it */
  protected toggle(name: NamesOf<State, boolean>, label: string, also: Partial<State> = {}): HTMLElement {
    const control = new Toggle(label, (on) => this.change({ [name]: on, ...also } as Partial<State>));
    this.#bind(name, (value) => {
      control.on = value as boolean;
    });
    return control.element;
  }

  /** Knobs for members of the state. @param terms the terms that highlight them */
  protected knobs<Name extends NamesOf<State, number>>(
    names: readonly Name[],
    texts: Readonly<Record<Name, KnobText>>,
    ranges: Readonly<Record<Name, DialRange>>,
    terms: Partial<Readonly<Record<Name, string>>> = {},
  ): HTMLElement[] {
    const settle = () => this.settle();
    return names.map((name) => {
      const onInput = (value: number) => this.set(name, value, false);
      const initial = this.parts.fields[name].initial as number;
      const knob = new Knob(
        texts[name],
        ranges[name],
        initial,
        { onInput, onSettle: settle, onCancel: settle },
        this.words,
      );
      this.#bind(name, (value) => {
        knob.value = value as number;
      });
      const term = terms[name];
      if (term) this.#lights.push([knob.element, term]);
      return knob.element;
    });
  }

  /** A slider for the examined frame of a built-in input. @param first the first valid frame */
  protected instant(at: NamesOf<State, number>, first: number): HTMLElement {
    const slider = new Slider(this.words.playhead, { min: first, max: FRAMES - 1, digits: 0 }, INSTANT, {
      onInput: (frame) => this.set(at, frame, false),
      onSettle: () => this.settle(),
    });
    slider.words = (frame) => `${this.number(frame / RATE_HZ, 2)} s`;
    this.#bind(at, (value) => {
      slider.value = value as number;
    });
    return slider.element;
  }

  /** A field for a number that the learner computes. @param empty the value of an empty field */
  protected guess(
    name: NamesOf<State, number>,
    label: string,
    range: Pick<Range, "min" | "max">,
    empty: number,
    digits: number,
  ): HTMLElement {
    const control = new GuessField(label, range, empty, (guess) => this.set(name, guess), this.parts.signal);
    this.#bind(name, (value) => {
      control.text = value === empty ? "" : this.number(value as number, digits);
    });
    return control.element;
  }

  #bind<Name extends keyof State>(name: Name, set: (value: State[Name]) => void): void {
    this.#controls.push((state) => set(state[name]));
  }

  async #load(state: State): Promise<void> {
    const shown = await this.load(state);
    if (this.parts.signal.aborted) return;
    const isDrawn = this.drawsAhead && shown === this.shown;
    this.shown = shown;
    if (!isDrawn) this.redraw();
  }
}
