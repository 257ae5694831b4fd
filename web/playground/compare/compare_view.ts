/** The Compare view: the same instant of one motion in several ways, side by side. */
import "../styles/compare.css";
import { RowViewer } from "../../viewer/row_viewer";
import { type InputInfo, POSE_FLOATS } from "../../worker/protocol";
import { button } from "../controls/buttons";
import { icon } from "../controls/icons";
import { html, setText } from "../dom";
import { allOf } from "../polygon/selection";
import { ProgressLine } from "../progress";
import type { Session } from "../session";
import { type PlayState, SPEEDS } from "../state";
import { strings } from "../strings/strings";
import { isDark, onSystemTheme } from "../theme";
import type { View, ViewHost } from "../views";
import { capitalised, errorText, isCancellation, manner, numberWord, spoken } from "../words";
import { CompareColumn } from "./column";
import {
  COLUMN_NAMES,
  type ColumnName,
  columnCaption,
  columnOptions,
  counterpartStyles,
  isTrained,
  LEAST_COLUMNS,
  MOST_COLUMNS,
} from "./columns";
import { figuresAt, type Measured, measure, type Performance } from "./figures";
import { CompareTransport } from "./transport";
import { Yardsticks } from "./yardsticks";

export function createView(host: ViewHost): View {
  return new Compare(host);
}

/** Figures change this often, so that they can be read. */
const FIGURES_MS = 120;
/** Styling waits until nothing has changed for so long. */
const SETTLE_MS = 150;
/** Longest step of the clock: a hidden tab does not catch up. */
const LONGEST_STEP_SECS = 0.1;

/** Under which the motion of a column is found. */
function keyOf(name: ColumnName, state: PlayState, neutral: string): string {
  const asked = name === "real" ? counterpartStyles(state, neutral) : columnOptions(name, state, neutral);
  return name === "input" ? "" : `${name === "real" ? "real " : ""}${JSON.stringify(asked)}`;
}

class Compare implements View {
  readonly element: HTMLElement;
  readonly #host: ViewHost;
  readonly #title = html("h1", { class: "page-title" });
  readonly #summary = html("p", { class: "compare-summary" });
  readonly #input = html("select", { "aria-label": strings.play.input.motion });
  readonly #style = html("select", { "aria-label": strings.compare.style });
  readonly #behind = html("select", { "aria-label": strings.compare.behind });
  readonly #add: HTMLButtonElement;
  readonly #picture = html("div", { class: "compare-picture" });
  readonly #heads = html("div", { class: "compare-heads" });
  readonly #tables = html("div", { class: "compare-tables" });
  readonly #progress = new ProgressLine();
  readonly #transport: CompareTransport;
  readonly #yardsticks = new Yardsticks();
  #columns: CompareColumn[] = [];
  #viewer: RowViewer | undefined;
  /** Motions by what they were asked of; those of another input are forgotten. `undefined` where there is none. */
  #motions = new Map<string, Measured | undefined>();
  /** What each column, and the figure behind, asks of the present state. */
  #keys = new Map<ColumnName, string>();
  #measuredInput: Measured | undefined;
  #of: InputInfo | undefined;
  #frame = 0;
  #last = 0;
  #figuresAt = 0;
  #request = 0;
  #settle: ReturnType<typeof setTimeout> | undefined;
  #listening = new AbortController();
  #shown = false;
  #seekedFrame = -1;

  constructor(host: ViewHost) {
    this.#host = host;
    const { store } = host;
    this.#input.addEventListener("change", () => host.chooseInput(this.#input.value));
    this.#style.addEventListener("change", () => {
      const name = this.#style.value;
      if (name) store.edit({ styles: allOf(store.state.styles, name), track: [], parts: {}, part: "" });
    });
    this.#behind.addEventListener("change", () => store.edit({ behind: this.#behind.value as ColumnName | "none" }));
    this.#add = button(strings.compare.method, () => this.#addColumn(), {
      icon: "add",
      label: true,
      class: "outlined",
    });
    this.#transport = new CompareTransport({
      onPlay: () => store.edit({ playing: !store.state.playing, frame: Math.round(this.#frame) }),
      onFrame: (by) => this.#step(by),
      onScrub: (frame) => this.#goTo(frame),
      onSpeed: (speed) => store.edit({ speed }),
      speeds: SPEEDS,
    });
    const select = (element: HTMLSelectElement) => html("div", { class: "select outlined" }, element, icon("chevron"));
    this.element = html(
      "main",
      { class: "view compare" },
      html(
        "header",
        { class: "compare-head" },
        this.#progress.element,
        html("div", {}, this.#title, this.#summary),
        html(
          "div",
          { class: "compare-choice" },
          select(this.#input),
          html("span", { class: "compare-to" }, strings.compare.to),
          select(this.#style),
          this.#add,
        ),
      ),
      html("div", { class: "compare-body" }, this.#heads, this.#picture, this.#tables),
      html(
        "footer",
        { class: "compare-foot" },
        this.#transport.element,
        html("label", { class: "compare-behind" }, strings.compare.behind, select(this.#behind)),
      ),
    );
    store.subscribe(() => {
      if (!this.#shown) return;
      this.refresh();
    });
  }

  get history() {
    return this.#host.store;
  }

  show(): void {
    this.#shown = true;
    this.#listening = new AbortController();
    const { signal } = this.#listening;
    addEventListener("keydown", (event) => this.#onKey(event), { signal });
    onSystemTheme(() => this.refresh(), signal);
    this.#frame = this.#host.playhead();
    this.refresh();
    this.#last = performance.now();
    this.#request = requestAnimationFrame(this.#tick);
  }

  hide(): void {
    if (this.#shown && this.#of) this.#host.goTo(this.#frame);
    this.#shown = false;
    this.#listening.abort();
    clearTimeout(this.#settle);
    this.#progress.cancel();
    cancelAnimationFrame(this.#request);
  }

  takeFiles(): void {
    // Files go to the page: a motion becomes the input, clips go to the Data view.
  }

  dispose(): void {
    this.hide();
    this.#viewer?.dispose();
    this.#yardsticks.dispose();
  }

  /** Shows what is open and what the state asks for. */
  refresh(): void {
    const session = this.#host.session();
    const { database, input } = session ?? {};
    const { state } = this.#host.store;
    if (this.#viewer) this.#viewer.theme = isDark(state.theme) ? "dark" : "light";
    const columns = this.#columnNames();
    this.#showColumns(columns, state);
    this.#transport.show({ playing: state.playing, speed: state.speed });
    if (!session || !database || !input) return;
    if (this.#of !== input) {
      this.#of = input;
      this.#motions.clear();
      this.#measuredInput = measure(
        {
          poses: input.poses,
          timeOut: Float32Array.from({ length: input.frames }, (_, f) => f / input.rateHz),
          planted: input.contacts,
          frameMs: undefined,
        },
        database.proportions,
      );
      this.#transport.input = input;
      this.#viewer?.setProportions(database.proportions);
      this.#viewer?.settle();
    }
    this.#frame = Math.min(this.#frame, input.frames - 1);
    const options = (library: typeof session.library) => [...library.builtIn, ...library.dropped];
    const { library, inputName } = session;
    this.#input.replaceChildren(
      ...options(library).map((name) => html("option", { value: name }, library.title(name))),
    );
    this.#input.value = inputName;
    this.#keys = new Map(
      [...columns, ...(this.#behindName ? [this.#behindName] : [])].map((name) => [
        name,
        keyOf(name, state, database.neutral),
      ]),
    );
    this.#showStyles(state, database.styles, database.neutral);
    this.#showWords(state, session);
    clearTimeout(this.#settle);
    this.#settle = setTimeout(() => void this.#makeAll(), SETTLE_MS);
  }

  #columnNames(): ColumnName[] {
    return this.#host.store.state.columns.filter((name): name is ColumnName =>
      COLUMN_NAMES.some((known) => known === name),
    );
  }

  #showColumns(names: readonly ColumnName[], state: Readonly<PlayState>): void {
    const { store } = this.#host;
    if (names.join() !== this.#columns.map((column) => column.name).join()) {
      this.#columns = names.map(
        (name, i) =>
          new CompareColumn(name, names.length > LEAST_COLUMNS, {
            onChange: (to) => store.edit({ columns: names.map((n, k) => (k === i ? to : n)) }),
            onRemove: () => store.edit({ columns: names.filter((_, k) => k !== i) }),
          }),
      );
      this.#heads.replaceChildren(...this.#columns.map((column) => column.head));
      this.#tables.replaceChildren(...this.#columns.map((column) => column.table));
      this.element.style.setProperty("--columns", String(names.length));
      this.#viewer?.settle();
    }
    this.#add.disabled = names.length >= MOST_COLUMNS;
    this.#behind.replaceChildren(
      html("option", { value: "none" }, strings.compare.nothing),
      ...[...new Set<ColumnName>(["real", ...names])].map((name) =>
        html("option", { value: name }, strings.compare.columns[name]),
      ),
    );
    const offered = [...this.#behind.options].some(({ value }) => value === state.behind);
    this.#behind.value = offered ? state.behind : "none";
  }

  #showStyles(state: Readonly<PlayState>, styles: readonly string[], neutral: string): void {
    const all = state.styles.find((s) => Math.abs(s.weight - 1) < 0.005);
    const plain = all && state.intensity === 1 && state.track.length === 0 && Object.keys(state.parts).length === 0;
    const mixed = plain ? [] : [html("option", { value: "" }, manner(state.styles, state.intensity, neutral))];
    this.#style.replaceChildren(...mixed, ...styles.map((name) => html("option", { value: name }, spoken(name))));
    this.#style.value = plain ? all.name : "";
  }

  #showWords(state: Readonly<PlayState>, { library, inputName, database }: Session): void {
    const count = this.#columns.length;
    setText(this.#title, count === 1 ? strings.compare.one : strings.compare.several(numberWord(count)));
    const input = library.title(inputName);
    const how = manner(state.styles, state.intensity, database?.neutral ?? "");
    const said = strings.compare.transfer(capitalised(input), how);
    setText(this.#summary, `${said} ${this.#wordsBehind()}`.trimEnd());
    for (const column of this.#columns)
      column.caption = this.#isMissing(column.name)
        ? strings.compare.captions.missing
        : columnCaption(column.name, input, state);
    if (this.#viewer) this.#viewer.description = this.#description();
  }

  /** What the tinted figure is. */
  #wordsBehind(): string {
    const behind = this.#behindName;
    if (!behind) return "";
    if (this.#isMissing(behind))
      return strings.compare.noReal(strings.compare.columns[behind], strings.compare.captions.missing);
    if (behind === "real") return strings.compare.tintedReal;
    return strings.compare.tinted(strings.compare.columns[behind]);
  }

  #description(): string {
    return strings.compare.picture(this.#columns.map(({ name }) => strings.compare.columns[name]).join(", "));
  }

  /** The column that is drawn behind the others; `undefined` for none. */
  get #behindName(): ColumnName | undefined {
    return COLUMN_NAMES.find((name) => name === this.#behind.value);
  }

  /** Makes the motion of every column, and of the figure behind, that has not been made yet. */
  async #makeAll(): Promise<void> {
    const session = this.#host.session();
    const { database, input } = session ?? {};
    if (!session || !database || !input) return;
    try {
      for (const [name, key] of this.#keys) {
        if (name === "input" || this.#motions.has(key)) continue;
        const performance = await this.#make(name, session, database.neutral);
        if (this.#of !== input) return;
        this.#motions.set(key, performance && measure(performance, database.proportions));
        this.#showAvailable();
      }
      // Nothing is kept that no column shows: long clips are large.
      const shown = new Set(this.#keys.values());
      for (const key of this.#motions.keys()) if (!shown.has(key)) this.#motions.delete(key);
    } catch (error) {
      if (!isCancellation(error)) this.#host.notices.error(errorText(error));
    }
    this.#seekedFrame = -1;
  }

  async #make(name: ColumnName, session: Session, neutral: string): Promise<Performance | undefined> {
    const { state } = this.#host.store;
    const styles = counterpartStyles(state, neutral);
    if (name === "real") {
      if (!styles) return undefined;
      const real = await this.#progress.run(strings.compare.performing, (call) =>
        this.#yardsticks.counterpart(session, styles, call),
      );
      return real && { ...real, frameMs: undefined };
    }
    const options = columnOptions(name, state, neutral)!;
    const label = strings.compare[isTrained(name) ? "training" : "styling"](strings.compare.columns[name]);
    return this.#progress.run(label, (call) =>
      isTrained(name) ? this.#yardsticks.style(session, options, call) : session.style(options, call),
    );
  }

  /** The motion of a column; `undefined` until it is made, and where there is none. */
  #motionOf(name: ColumnName | undefined): Measured | undefined {
    if (!name) return undefined;
    return name === "input" ? this.#measuredInput : this.#motions.get(this.#keys.get(name) ?? "");
  }

  /** Whether it is known that a column has no motion. */
  #isMissing(name: ColumnName): boolean {
    const key = this.#keys.get(name);
    return key !== undefined && this.#motions.has(key) && this.#motions.get(key) === undefined;
  }

  #showAvailable(): void {
    const session = this.#host.session();
    if (session) this.#showWords(this.#host.store.state, session);
  }

  readonly #tick = (now: number): void => {
    this.#request = requestAnimationFrame(this.#tick);
    const input = this.#of;
    const { state } = this.#host.store;
    if (!input) return;
    const dt = Math.min((now - this.#last) / 1000, LONGEST_STEP_SECS);
    this.#last = now;
    if (state.playing) {
      const [first, last] = [
        state.range?.first ?? 0,
        Math.min(state.range?.last ?? input.frames - 1, input.frames - 1),
      ];
      this.#frame += dt * state.speed * input.rateHz;
      if (this.#frame >= last) {
        this.#frame = state.loop ? first : last;
        if (state.loop) this.#viewer?.settle();
        else this.#host.store.edit({ playing: false, frame: last });
      }
    }
    this.#draw(now);
  };

  #draw(now: number): void {
    this.#viewer ??= this.#makeViewer();
    if (this.#seekedFrame !== this.#frame) {
      this.#seekedFrame = this.#frame;
      const behind = this.#motionOf(this.#behindName);
      this.#viewer.setFigures(
        this.#columns.map((column) => {
          // Until a column is styled it shows the input.
          const motion = this.#motionOf(column.name) ?? this.#measuredInput!;
          const reference = behind && behind !== motion ? poseAt(behind, this.#frame) : null;
          return { pose: poseAt(motion, this.#frame), reference };
        }),
      );
      this.#transport.frame = this.#frame;
    }
    if (!this.#viewer.still) this.#viewer.render(now / 1000);
    if (now - this.#figuresAt < FIGURES_MS) return;
    this.#figuresAt = now;
    this.#showFigures();
  }

  #showFigures(): void {
    const input = this.#measuredInput;
    if (!input) return;
    const behind = this.#motionOf(this.#behindName);
    const figures = this.#columns.map((column) => {
      const motion = this.#motionOf(column.name);
      return motion && figuresAt(motion, input, behind, this.#frame);
    });
    for (const [i, column] of this.#columns.entries())
      column.showFigures(figures[i], figures, this.#behindName === "real");
  }

  #makeViewer(): RowViewer {
    const viewer = new RowViewer(
      this.#picture,
      isDark(this.#host.store.state.theme) ? "dark" : "light",
      this.#description(),
    );
    const { database } = this.#host.session() ?? {};
    if (database) viewer.setProportions(database.proportions);
    return viewer;
  }

  #addColumn(): void {
    const names = this.#columnNames();
    const next = COLUMN_NAMES.find((name) => !names.includes(name));
    if (next) this.#host.store.edit({ columns: [...names, next] });
  }

  #goTo(frame: number): void {
    const input = this.#of;
    if (!input) return;
    const far = Math.abs(frame - this.#frame) > input.rateHz / 2;
    this.#frame = Math.min(Math.max(0, frame), input.frames - 1);
    if (far) this.#viewer?.settle();
    if (!this.#host.store.state.playing) this.#host.store.edit({ frame: Math.round(this.#frame) });
  }

  #step(by: number): void {
    this.#host.store.edit({ playing: false });
    this.#goTo(Math.round(this.#frame) + by);
  }

  #onKey(event: KeyboardEvent): void {
    if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey) return;
    if (document.activeElement?.matches("input, select, button, canvas") && event.key !== " ") return;
    if (document.activeElement?.matches("button, select") || document.querySelector("dialog[open]")) return;
    const { store } = this.#host;
    const act = {
      " ": () => store.edit({ playing: !store.state.playing, frame: Math.round(this.#frame) }),
      ArrowLeft: () => this.#step(-1),
      ArrowRight: () => this.#step(1),
      Home: () => this.#goTo(0),
      End: () => this.#goTo(Number.MAX_SAFE_INTEGER),
    }[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  }
}

const shownPoses = new WeakMap<Measured, Float32Array>();

/** A motion's pose at a fractional frame; the mannequin normalises what lies between two frames. */
function poseAt(motion: Measured, frame: number): Float32Array {
  const out = shownPoses.get(motion) ?? new Float32Array(POSE_FLOATS);
  shownPoses.set(motion, out);
  const i = Math.min(Math.floor(frame), motion.frames - 1);
  const j = Math.min(i + 1, motion.frames - 1);
  const t = frame - Math.floor(frame);
  const a = motion.poses.subarray(i * POSE_FLOATS, (i + 1) * POSE_FLOATS);
  const b = motion.poses.subarray(j * POSE_FLOATS, (j + 1) * POSE_FLOATS);
  for (let k = 0; k < 3; k++) out[k] = a[k]! + (b[k]! - a[k]!) * t;
  for (let q = 3; q < POSE_FLOATS; q += 4) {
    const dot = a[q]! * b[q]! + a[q + 1]! * b[q + 1]! + a[q + 2]! * b[q + 2]! + a[q + 3]! * b[q + 3]!;
    const sign = dot < 0 ? -1 : 1;
    for (let k = q; k < q + 4; k++) out[k] = a[k]! * (1 - t) + sign * b[k]! * t;
  }
  return out;
}
