/** The Compare view: the same instant of one motion by several methods, side by side. */

import "./compare.css";
import type { InputInfo } from "../../../client/protocol";
import { stepSecs } from "../../../player/clock";
import { clipIn, clipValue, MOST_CLIPS } from "../../../player/input_library";
import { measure, poseAt } from "../../../player/measured";
import type { Session } from "../../../player/session";
import { button } from "../../../ui/controls/buttons";
import { icon } from "../../../ui/controls/icons";
import { html, setText } from "../../../ui/dom";
import { isNarrow, NARROW } from "../../../ui/media";
import { allOf } from "../../../ui/polygon/selection";
import { isDark, onSystemTheme } from "../../../ui/theme";
import { SideBySideViewer } from "../../../viewer/side_by_side_viewer";
import { AnimatedView } from "../../animated_view";
import { candidatesOf, MAX_COLUMNS } from "../../state/compare";
import type { AppState } from "../../state/state";
import { strings } from "../../strings/strings";
import { ProgressLine } from "../../ui/progress";
import { inputTitle, manner, spoken } from "../../ui/words";
import type { KeyTable, View, ViewHost } from "../../view";
import { BaselineClient } from "./baseline_client";
import { type Choice, showChoices } from "./choices";
import { advanced } from "./clock";
import { CompareColumn } from "./column";
import { ColumnMotions } from "./column_motions";
import {
  COLUMN_NAMES,
  type ColumnName,
  columnCaption,
  isTrained,
  MIN_COLUMNS,
  type MotionRequest,
  motionRequest,
  shownOrder,
} from "./columns";
import { type ColumnMotion, figuresAt, type MeasuredMotion } from "./figures";
import { SearchMeasurement } from "./search_measurement";
import { SearchStrip } from "./search_strip";
import { type Comparison, pictureOf, summaryOf, titleOf } from "./sentences";
import { CompareTransport } from "./transport";

export function createView(host: ViewHost): View {
  return new CompareView(host);
}

/** Time between two updates of the measurements, so that they are readable. */
const FIGURES_MS = 120;

class CompareView extends AnimatedView {
  readonly element: HTMLElement;
  readonly keys: KeyTable = {
    " ": () => this.#togglePlay(),
    ArrowLeft: () => this.#step(-1),
    ArrowRight: () => this.#step(1),
    Home: () => this.#goTo(0),
    End: () => this.#goTo(Number.MAX_SAFE_INTEGER),
  };
  readonly #title = html("h1", { class: "page-title" });
  readonly #summary = html("p", { class: "compare-summary" });
  readonly #input = html("select", { "aria-label": strings.play.input.motion });
  readonly #style = html("select", { "aria-label": strings.compare.style });
  readonly #behind = html("select");
  readonly #add: HTMLButtonElement;
  readonly #picture = html("div", { class: "compare-picture" });
  readonly #heads = html("div", { class: "compare-heads" });
  readonly #tables = html("div", { class: "compare-tables" });
  readonly #progress = new ProgressLine();
  readonly #transport: CompareTransport;
  readonly #baselines = new BaselineClient();
  readonly #motions = new ColumnMotions({
    make: (request) => this.#make(request),
    cancel: () => this.#progress.cancel(),
    onMade: () => this.#showMade(),
    onError: (error) => this.host.toasts.failure(error),
  });
  readonly #search: SearchStrip;
  readonly #searched = new SearchMeasurement({
    measure: ({ neighbours, candidates }, call) =>
      this.#baselines.compareSearch(this.host.session, neighbours, candidates, call),
    onChange: () => this.#showSearch(),
    onError: (error) => this.host.toasts.failure(error),
  });
  #columns: CompareColumn[] = [];
  #viewer: SideBySideViewer | undefined;
  /** The requests of each column, and of the figure behind, in the current state. */
  #requests = new Map<ColumnName, MotionRequest>();
  #comparison: Comparison | undefined;
  #measuredInput: MeasuredMotion | undefined;
  /** The input whose motions are displayed. */
  #openInput: InputInfo | undefined;
  #frame = 0;
  #lastTick = 0;
  #figuresShownAt = 0;
  /** The last state of the playhead. */
  #followed: Pick<AppState, "playing" | "frame">;
  /** The frame whose poses are set in the viewer; `undefined` if they must be set again. */
  #drawnFrame: number | undefined;

  constructor(host: ViewHost) {
    super(host);
    const { store } = host;
    this.#followed = store.state;
    this.#input.addEventListener("change", () => void this.#choose(this.#input.value));
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
    this.#add.setAttribute("aria-label", strings.compare.addMethod);
    this.#transport = new CompareTransport({
      onPlay: () => this.#togglePlay(),
      onFrame: (by) => this.#step(by),
      onScrub: (frame) => this.#goTo(frame),
      onSpeed: (speed) => store.edit({ speed }),
    });
    this.#search = new SearchStrip((search) => store.edit({ search }));
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
      this.#search.element,
      html(
        "footer",
        { class: "compare-foot" },
        this.#transport.element,
        html("label", { class: "compare-behind" }, strings.compare.behind, select(this.#behind)),
      ),
    );
  }

  protected appear(signal: AbortSignal): void {
    onSystemTheme(() => this.refresh(), signal);
    matchMedia(NARROW).addEventListener("change", () => this.refresh(), { signal });
    this.host.store.subscribe(() => this.refresh(), signal);
    this.#motions.resume();
    this.#frame = this.host.playhead.at;
    this.#followed = this.host.store.state;
    this.#beginWithRecording();
    this.refresh();
    this.#lastTick = performance.now();
  }

  /** Opens an input of the library, or a clip of the open database. */
  async #choose(value: string): Promise<void> {
    const clip = clipIn(value);
    await (clip === undefined ? this.host.chooseInput(value) : this.host.chooseClip(clip));
  }

  /**
   * If the user has not chosen an input and the database is recorded, a clip of it is compared. Generated motions are
   * so similar to each other that copying a frame would be the best method.
   */
  #beginWithRecording(): void {
    const { store, session } = this.host;
    const { databaseSource, library } = session;
    if (store.state.input !== "" || databaseSource?.kind !== "strutdb") return;
    const first = library.clips.find(({ name }) => /walk/i.test(name)) ?? library.clips[0];
    if (first) void this.host.chooseClip(first.clip);
  }

  protected disappear(): void {
    if (this.#openInput) this.host.playhead.takeOver(this.#frame);
    this.#motions.pause();
    this.#searched.stop();
  }

  override dispose(): void {
    super.dispose();
    this.#viewer?.dispose();
    this.#viewer = undefined;
    this.#baselines.dispose();
  }

  /** Shows the open objects and the state. */
  refresh(): void {
    const { session } = this.host;
    const { database, input } = session;
    const { state } = this.host.store;
    if (this.#viewer) this.#viewer.theme = isDark(state.theme) ? "dark" : "light";
    const columns = this.#columnNames();
    this.#showColumns(columns, state);
    this.#transport.show({ playing: state.playing, speed: state.speed });
    this.#followPlayhead(state);
    if (!database || !input) {
      this.#showSearch();
      return;
    }
    if (this.#openInput !== input) {
      this.#openInput = input;
      this.#frame = Math.min(this.#frame, input.frames - 1);
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
    this.#drawnFrame = undefined;
    const { library, inputName } = session;
    const names = [...library.builtIn, ...library.dropped];
    const ofDatabase = library.clips
      .slice(0, MOST_CLIPS)
      .map(({ clip, name }): Choice => [clipValue(clip), strings.compare.clip(spoken(name), database.name)]);
    const inputs = [...names.map((name): Choice => [name, inputTitle(library, name)]), ...ofDatabase];
    showChoices(this.#input, inputs, inputName);
    const { neutral, proportions } = database;
    this.#requests = new Map(
      [...columns, ...(this.#behindName ? [this.#behindName] : [])].flatMap((name) => {
        const request = motionRequest(name, state, neutral);
        return request ? [[name, request] as const] : [];
      }),
    );
    this.#motions.request({ input, proportions }, [...this.#requests.values()]);
    const candidates = candidatesOf(state.search);
    this.#searched.request(candidates === undefined ? undefined : { input, neighbours: state.k, candidates });
    this.#showSearch();
    this.#showStyles(state, database.styles, neutral);
    this.#showWords(state, session);
  }

  #columnNames(): ColumnName[] {
    return this.host.store.state.columns.filter((name): name is ColumnName =>
      COLUMN_NAMES.some((known) => known === name),
    );
  }

  #showColumns(names: readonly ColumnName[], state: Readonly<AppState>): void {
    const { store } = this.host;
    const order = shownOrder(names, isNarrow());
    if (order.map((i) => names[i]).join() !== this.#columns.map((column) => column.name).join()) {
      this.#columns = order.map(
        (i, place) =>
          new CompareColumn(names[i]!, place + 1, names.length > MIN_COLUMNS, {
            onChange: (to) => store.edit({ columns: names.map((n, k) => (k === i ? to : n)) }),
            onRemove: () => store.edit({ columns: names.filter((_, k) => k !== i) }),
          }),
      );
      this.#heads.replaceChildren(...this.#columns.map((column) => column.head));
      this.#tables.replaceChildren(...this.#columns.map((column) => column.table));
      this.element.style.setProperty("--columns", String(names.length));
      this.#viewer?.settle();
    }
    this.#add.disabled = names.length >= MAX_COLUMNS;
    const offered = [...new Set<ColumnName>(["real", ...names])];
    const choices = offered.map((name): Choice => [name, strings.compare.columns[name]]);
    const chosen = offered.find((name) => name === state.behind) ?? "none";
    showChoices(this.#behind, [["none", strings.compare.nothing], ...choices], chosen);
  }

  #showSearch(): void {
    const { search, k } = this.host.store.state;
    const { figures, fraction } = this.#searched;
    this.#search.show({ search, neighbours: k, figures, fraction });
  }

  #showStyles(state: Readonly<AppState>, styles: readonly string[], neutral: string): void {
    const all = state.styles.find((s) => Math.abs(s.weight - 1) < 0.005);
    const plain = all && state.intensity === 1 && state.track.length === 0 && Object.keys(state.parts).length === 0;
    const mixed: Choice[] = plain ? [] : [["", manner(state.styles, state.intensity, neutral)]];
    const choices = [...mixed, ...styles.map((name): Choice => [name, spoken(name)])];
    showChoices(this.#style, choices, plain ? all.name : "");
  }

  #showWords(state: Readonly<AppState>, { library, inputName, database }: Session): void {
    const input = inputTitle(library, inputName);
    this.#comparison = {
      columns: this.#columns.map(({ name }) => name),
      behind: this.#behindName,
      input,
      manner: manner(state.styles, state.intensity, database?.neutral ?? ""),
      isMissing: (name) => this.#isMissing(name),
    };
    setText(this.#title, titleOf(this.#comparison));
    setText(this.#summary, summaryOf(this.#comparison));
    for (const column of this.#columns)
      column.caption = this.#isMissing(column.name)
        ? strings.compare.captions.missing
        : columnCaption(column.name, input, state);
    if (this.#viewer) this.#viewer.description = pictureOf(this.#comparison);
  }

  /** The column drawn behind the others; `undefined` for none. */
  get #behindName(): ColumnName | undefined {
    return COLUMN_NAMES.find((name) => name === this.#behind.value);
  }

  async #make(request: MotionRequest): Promise<ColumnMotion | undefined> {
    const { session } = this.host;
    if (request.kind === "counterpart") {
      const { styles } = request;
      if (!styles) return undefined;
      const real = await this.#progress.run(strings.compare.performing, (call) =>
        this.#baselines.counterpart(session, styles, call),
      );
      return real && { ...real, frameMs: undefined };
    }
    const { column, options } = request;
    const label = strings.compare[isTrained(column) ? "training" : "styling"](strings.compare.columns[column]);
    return this.#progress.run(label, (call) =>
      isTrained(column) ? this.#baselines.style(session, options, call) : session.style(options, call),
    );
  }

  /** The motion of a column; `undefined` until it is made, and if there is none. */
  #motionOf(name: ColumnName | undefined): MeasuredMotion | undefined {
    if (!name) return undefined;
    return name === "input" ? this.#measuredInput : this.#motions.get(this.#requests.get(name)?.key ?? "");
  }

  /** Whether a column is known to have no motion. */
  #isMissing(name: ColumnName): boolean {
    const request = this.#requests.get(name);
    return request !== undefined && this.#motions.isMissing(request.key);
  }

  /** Updates texts and measurements after a motion was made. */
  #showMade(): void {
    this.#drawnFrame = undefined;
    this.#showWords(this.host.store.state, this.host.session);
  }

  /** Moves the clock to the playhead set by a link, undo or a pause; during playback the state has no frame. */
  #followPlayhead(state: AppState): void {
    const { playing, frame } = this.#followed;
    if (!state.playing && (playing || state.frame !== frame)) this.#frame = state.frame;
    this.#followed = state;
  }

  protected tick(now: number): void {
    const input = this.#openInput;
    const { state } = this.host.store;
    if (!input) return;
    const dt = stepSecs(this.#lastTick, now);
    this.#lastTick = now;
    if (state.playing) {
      const { frame, event } = advanced(this.#frame, dt, { ...state, rateHz: input.rateHz, frames: input.frames });
      this.#frame = frame;
      if (event === "restarted") this.#viewer?.settle();
      if (event === "ended") this.host.store.edit({ playing: false, frame });
    }
    this.#draw(now);
  }

  #draw(now: number): void {
    this.#viewer ??= this.#makeViewer();
    if (this.#drawnFrame !== this.#frame) {
      this.#drawnFrame = this.#frame;
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
    if (now - this.#figuresShownAt < FIGURES_MS) return;
    this.#figuresShownAt = now;
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

  #makeViewer(): SideBySideViewer {
    const viewer = new SideBySideViewer(
      this.#picture,
      isDark(this.host.store.state.theme) ? "dark" : "light",
      this.#comparison ? pictureOf(this.#comparison) : "",
    );
    const { database } = this.host.session;
    if (database) viewer.setProportions(database.proportions);
    return viewer;
  }

  #addColumn(): void {
    const names = this.#columnNames();
    const next = COLUMN_NAMES.find((name) => !names.includes(name));
    if (next) this.host.store.edit({ columns: [...names, next] });
  }

  #togglePlay(): void {
    const { store } = this.host;
    store.edit({ playing: !store.state.playing, frame: Math.round(this.#frame) });
  }

  #goTo(frame: number): void {
    const input = this.#openInput;
    if (!input) return;
    const far = Math.abs(frame - this.#frame) > input.rateHz / 2;
    this.#frame = Math.min(Math.max(0, frame), input.frames - 1);
    if (far) this.#viewer?.settle();
    if (!this.host.store.state.playing) this.host.store.edit({ frame: Math.round(this.#frame) });
  }

  #step(by: number): void {
    const frame = Math.round(this.#frame);
    this.host.store.edit({ playing: false, frame });
    this.#goTo(frame + by);
  }
}
