/** The Crowd view: agents on open ground, each in the styles of the place where it walks. */
import "../synthesis/editor.css";
import "./crowd.css";
import type { Crowd, CrowdTick } from "../../../client/crowd/crowd_client";
import type { FieldVertex } from "../../../client/crowd/limits";
import { isCancellation, type RecordedMotion } from "../../../client/protocol";
import { engineOptions } from "../../../link/engine_options";
import { button, Segment } from "../../../ui/controls/buttons";
import { formatNumber, html, setText } from "../../../ui/dom";
import { isDark, onSystemTheme } from "../../../ui/theme";
import { graphics } from "../../../viewer";
import { AnimatedView } from "../../animated_view";
import { CROWD_CAMERAS, type CrowdCamera } from "../../state/crowd";
import { strings } from "../../strings/strings";
import { ProgressLine } from "../../ui/progress";
import { errorText, inputTitle } from "../../ui/words";
import type { KeyTable, View, ViewHost } from "../../view";
import { EmptyPanel } from "../synthesis/empty_panel";
import type { WalkSource } from "../synthesis/walk_models";
import { Census, COUNTS_HZ } from "./census";
import { ChosenWalker } from "./chosen_walker";
import { StyleColours } from "./colours";
import { Conductor } from "./conductor";
import { rendererName } from "./drawn_by";
import { FieldEditor } from "./field_editor";
import { FieldPanel } from "./field_panel";
import { Footer } from "./footer";
import { Gathering, type Performance } from "./gathering";
import { Handles } from "./handles";
import { Pace } from "./pace";
import { PeoplePanel } from "./people_panel";
import { CrowdPicture } from "./picture";
import { Settings, type Styles } from "./settings";
import { ShareChart } from "./share_chart";
import { crowdTitle, pictureOf } from "./titles";

export function createView(host: ViewHost): View {
  return new CrowdView(host);
}

const words = strings.crowd;

const BUILT_IN: WalkSource = { name: "", file: undefined, neutral: "neutral" };
/** Maximum number of agents if the CPU draws. */
const SOFTWARE_COUNT = 100;
/** Updates of the figures and the card per second of the crowd's time. */
const FIGURES_HZ = 5;

class CrowdView extends AnimatedView {
  readonly element: HTMLElement;
  readonly #progress = new ProgressLine();
  readonly #settings: Settings;
  readonly #gathering: Gathering;
  readonly #colours = new StyleColours();
  readonly #stage = html("div", { class: "editor-stage" });
  readonly #title = html("h1", { class: "stage-title" });
  readonly #caption = html("p", { class: "caption" });
  readonly #counted = html("p", { class: "crowd-counted caption" });
  readonly #cameras: Segment<CrowdCamera>;
  readonly #map: HTMLButtonElement;
  readonly #empty = new EmptyPanel();
  readonly #handles: Handles;
  readonly #chosen: ChosenWalker;
  readonly #fieldPanel: FieldPanel;
  readonly #peoplePanel: PeoplePanel;
  readonly #chart = new ShareChart(this.#colours);
  readonly #footer: Footer;
  readonly #conductor: Conductor;
  #picture: CrowdPicture | undefined;
  #crowd: Crowd | undefined;
  /** The motion that the crowd performs. */
  #performs: RecordedMotion | undefined;
  #styles: Styles | undefined;
  #replaced: WalkSource | undefined;
  /** The requested number of agents, and the number for which the worker is fast enough. */
  #asked = 0;
  #slowed: number | undefined;
  #tick: CrowdTick | undefined;
  #tickAt = 0;
  #ticks = 0;
  readonly #tickPace = new Pace();
  #fps: number | undefined;
  #census: Census | undefined;
  #drawsRoute = false;
  #films = false;

  constructor(host: ViewHost) {
    super(host);
    const { store } = host;
    this.#conductor = new Conductor((error) => host.toasts.error(errorText(error)));
    this.#settings = new Settings(store, (sentence) => host.toasts.error(sentence));
    this.#gathering = new Gathering(this.#progress, {
      start: () => this.#start(),
      performance: () => this.#performance(),
      fieldOf: (styles, source) => this.#fieldOf(styles, source),
      onReady: (crowd, performs) => this.#present(crowd, performs),
      onFailed: (source, why) => this.#refuse(source, why),
    });
    const editor = new FieldEditor(store, () => ({
      field: this.#read().field,
      radius: this.#radius,
      styles: this.#styles,
    }));
    this.#handles = new Handles(editor);
    this.#chosen = new ChosenWalker(store, (saving) => this.#say(saving));
    this.#fieldPanel = new FieldPanel(this.#colours, editor);
    this.#peoplePanel = new PeoplePanel(
      store,
      () => this.#read().people,
      () => this.#drawRoute(!this.#drawsRoute),
    );
    this.#cameras = new Segment(
      words.cameras,
      CROWD_CAMERAS.map((value) => ({ value, label: words.camera[value] })),
      (crowdCamera) => store.edit({ crowdCamera, crowdFollow: false }),
    );
    this.#map = button(words.map, () => store.edit({ crowdMap: !store.state.crowdMap }), {
      icon: "field",
      label: true,
      class: "chip",
    });
    this.#map.title = words.mapWhy;
    this.#footer = new Footer(store, this.#chart, {
      onPlay: () => this.#togglePlay(),
      onStep: () => this.#step(),
      onPoster: () => void this.#export("poster"),
      onVideo: () => void this.#export("video"),
    });
    this.element = html(
      "main",
      { class: "view crowd" },
      html(
        "div",
        { class: "editor-picture" },
        this.#stage,
        html("div", { class: "stage-heading" }, this.#title, this.#caption),
        html("div", { class: "crowd-controls" }, this.#cameras.element, this.#map),
        this.#counted,
        this.#chosen.card,
        this.#progress.element,
        this.#empty.element,
      ),
      this.#footer.element,
      html("div", { class: "crowd-panel" }, this.#fieldPanel.element, this.#peoplePanel.element),
    );
  }

  protected appear(signal: AbortSignal): void {
    const { store } = this.host;
    this.#colours.theme = isDark(store.state.theme) ? "dark" : "light";
    this.#picture = new CrowdPicture(
      this.#stage,
      { colours: this.#colours, handles: this.#handles, card: this.#chosen.card },
      {
        onWalker: (walker) => this.#chosen.choose(walker),
        onTurn: () => store.edit({ crowdCamera: "orbit" }),
        onFps: (fps) => {
          this.#fps = fps;
        },
        onRoute: (route) => {
          this.#drawRoute(false);
          if (route.length > 0) store.edit({ route });
        },
      },
      signal,
    );
    store.subscribe(() => this.#showState(), signal);
    onSystemTheme(() => this.#showState(), signal);
    document.addEventListener("keydown", (event) => this.#onKey(event), { signal });
    this.#chart.attach(signal);
    this.refresh();
  }

  protected disappear(): void {
    this.#gathering.cancel();
    this.#close();
    this.#picture = undefined;
    // The next model may have other styles.
    this.#styles = undefined;
    this.#tick = undefined;
    this.#chosen.take(undefined);
    this.#drawsRoute = false;
  }

  /** Shows walkers of the open database, or agents that perform the input on it. */
  refresh(): void {
    if (!this.isShown) return;
    const { state } = this.host.store;
    const { database } = this.host.session;
    this.#showState();
    // A database stored on this device is opened first; the page calls again when it is open.
    if (state.database !== "" && !database) return;
    if (!this.#canBegin) return;
    const { name, file } = this.host.databaseFile();
    if (this.#replaced?.file !== file) this.#replaced = undefined;
    const source = this.#replaced || !file ? BUILT_IN : { name, file, neutral: database?.neutral ?? "" };
    const { gathered } = this.#gathering;
    const performs = this.#performance()?.key ?? "";
    if (!gathered || gathered.source.file !== source.file || gathered.performs !== performs) this.#open(source);
  }

  // --- the crowd ---

  /** Creates a new crowd by the model of a database. */
  #open(source: WalkSource): void {
    this.#empty.hide();
    void this.#gathering.open(source);
  }

  /** Initial settings of a crowd that is being created. */
  #start() {
    const { people, route } = this.#read();
    this.#asked = people.count;
    return { count: this.#fitting(people.count), seed: people.seed, route };
  }

  /** Whether all requirements are met: agents that perform need an input. */
  get #canBegin(): boolean {
    return this.#read().kind === "walkers" || this.host.session.input !== undefined;
  }

  /** The motion to perform: the input of Play with its options. */
  #performance(): Performance | undefined {
    const { session, store } = this.host;
    const { state } = store;
    const { name } = this.host.databaseFile();
    if (this.#read().kind !== "performers") return undefined;
    const options = { ...engineOptions(state, session.database?.neutral ?? ""), styles: {}, parts: {}, track: [] };
    const key = JSON.stringify([name, session.inputName, session.input?.frames, state.range, options]);
    return { key, record: (call) => session.record(options, state.range, call) };
  }

  #fieldOf(all: readonly string[], { neutral }: WalkSource): readonly FieldVertex[] {
    this.#styles = { all, neutral: all.includes(neutral) ? neutral : "" };
    if (all.length === 1) this.host.toasts.note(words.of[this.#read().kind].oneStyle);
    return this.#read().field;
  }

  /** Shows a crowd instead of the previous one. */
  #present(crowd: Crowd, performs: RecordedMotion | undefined): void {
    this.#close();
    this.#crowd = crowd;
    this.#performs = performs;
    this.#census = new Census(crowd.styles.length);
    this.#chosen.take(undefined);
    this.#tick = undefined;
    this.#ticks = 0;
    this.#conductor.crowd = crowd;
    this.#picture!.setProportions(crowd.proportions);
    this.#fieldPanel.setStyles(crowd.styles);
    crowd.onTick = (tick) => this.#onTick(tick);
    crowd.onHalved = (count) => this.#onHalved(count);
    crowd.onError = (error) => {
      this.#close();
      this.#refuse(this.#gathering.gathered?.source ?? BUILT_IN, errorText(error));
    };
    this.#showState();
    // A crowd that starts paused is shown once.
    if (!crowd.playing) void crowd.step();
  }

  #close(): void {
    this.#conductor.crowd = undefined;
    this.#crowd?.dispose();
    this.#crowd = undefined;
  }

  /** Shows why there is no crowd, and what can be done. An existing crowd continues. */
  #refuse(source: WalkSource, why: string): void {
    if (this.#crowd) {
      if (why !== "") this.host.toasts.error(why);
      return;
    }
    const again = { label: words.startAgain, onChoose: () => this.#open(source) };
    const builtIn = {
      label: words.useBuiltIn,
      onChoose: () => {
        this.#replaced = source;
        this.#open(BUILT_IN);
      },
    };
    const { kind } = this.#read();
    const walk = {
      label: words.letWalk,
      onChoose: () => this.host.store.edit({ crowdKind: "walkers" }),
    };
    const [none, instead] =
      kind === "performers"
        ? [words.noMotion(why), [walk]]
        : [words.noModel(source.name || words.builtInDatabase, why), source.file ? [builtIn] : []];
    this.#empty.show(why === "" ? words.stopped : none, [...instead, again]);
    this.#showState();
  }

  #read() {
    return this.#settings.read(this.#styles);
  }

  /** The number of agents that can run here, at most `count`. */
  #fitting(count: number): number {
    const most = graphics() === "software" ? SOFTWARE_COUNT : Number.POSITIVE_INFINITY;
    return Math.min(count, most, this.#slowed ?? count);
  }

  // --- the state ---

  #showState(): void {
    const picture = this.#picture;
    if (!this.isShown || !picture) return;
    const { store } = this.host;
    const { kind, people, field, route } = this.#read();
    const { state } = store;
    const crowd = this.#crowd;
    if (people.count !== this.#asked) {
      this.#asked = people.count;
      this.#slowed = undefined;
    }
    const { gathered, asked } = this.#gathering;
    const isOthers = asked && (this.#performance()?.key ?? "") !== asked.performs;
    if (asked && this.#canBegin && (isOthers || (gathered && people.seed !== gathered.seed))) {
      this.#open(asked.source);
      return;
    }
    const theme = isDark(state.theme) ? "dark" : "light";
    const isOther = theme !== this.#colours.theme;
    this.#colours.theme = theme;
    if (isOther) this.#chart.draw();
    picture.theme = theme;
    this.#colours.take([...new Set(field.map(({ style }) => style))]);
    const count = this.#fitting(people.count);
    const chosen = Math.min(state.crowdVertex, field.length - 1);
    this.#conductor.conduct({ playing: state.playing && !this.#films, speed: state.speed, count, field, route });
    picture.setField(field, chosen, state.crowdMap, this.#radius);
    picture.setRoute(route);
    picture.camera = state.crowdCamera;
    picture.description = pictureOf(kind, count, field);
    this.#fieldPanel.show(kind, field, chosen);
    const { does, count: counted, caption } = words.of[kind];
    const limit =
      this.#slowed !== undefined
        ? words.slowed(count, does)
        : count < people.count
          ? words.software(SOFTWARE_COUNT, does)
          : "";
    this.#peoplePanel.showPeople(kind, people, limit);
    this.#peoplePanel.showRoute(route.length > 0, this.#drawsRoute);
    picture.drawing = this.#drawsRoute;
    this.#cameras.value = state.crowdCamera;
    this.#map.setAttribute("aria-pressed", String(state.crowdMap));
    this.#footer.show(state.playing, state.speed, crowd !== undefined && !this.#films);
    setText(this.#title, crowd ? crowdTitle(kind, count, field) : words.opening);
    const { session } = this.host;
    const motion = inputTitle(session.library, session.inputName);
    setText(this.#caption, this.#performs ? words.performed(motion, formatNumber(this.#performs.secs, 1)) : caption);
    this.#chart.kind = kind;
    this.element.classList.toggle("without-crowd", !crowd);
    setText(this.#counted, `${counted(count)} · ${words.grid}`);
    picture.choose(this.#chosen.number, state.crowdFollow);
    this.#chosen.show();
    this.#recolour();
  }

  get #radius(): number {
    return this.#tick?.radius ?? radiusOf(this.#fitting(this.#asked));
  }

  #drawRoute(draws: boolean): void {
    this.#drawsRoute = draws;
    this.#showState();
  }

  // --- time ---

  #onTick(tick: CrowdTick): void {
    const other = tick.count !== this.#tick?.count;
    const radius = this.#tick?.radius;
    this.#tick = tick;
    this.#tickAt = performance.now();
    this.#tickPace.add(tick.tickMs);
    this.#picture!.setTick(tick, this.#crowd!.styles, other);
    const { kind, field } = this.#read();
    this.#chosen.take({ kind, crowd: this.#crowd!, tick, field });
    if (radius !== tick.radius) this.#showState();
    const { rateHz } = this.#crowd!;
    this.#footer.secs = this.#ticks / rateHz;
    if (this.#ticks % (rateHz / COUNTS_HZ) === 0) {
      this.#census!.add(tick.weights);
      this.#chart.show(this.#census, this.#crowd!.styles);
    }
    if (this.#ticks % (rateHz / FIGURES_HZ) === 0) this.#showFigures();
    this.#ticks += 1;
  }

  #onHalved(count: number): void {
    this.#slowed = count;
    this.#conductor.count = count;
    this.host.toasts.note(words.slowed(count, words.of[this.#read().kind].does));
    this.#showState();
  }

  /** The agents' colours follow those of the styles, without waiting for a tick. */
  #recolour(): void {
    if (this.#crowd && this.#tick && !this.#crowd.playing) this.#picture?.setTick(this.#tick, this.#crowd.styles, true);
  }

  protected tick(now: number): void {
    if (this.#films) return;
    const crowd = this.#crowd;
    const share = crowd?.playing ? Math.min(1, Math.max(0, (performance.now() - this.#tickAt) / crowd.periodMs)) : 1;
    this.#picture!.draw(now, share);
  }

  #togglePlay(): void {
    const { store } = this.host;
    if (this.#crowd) store.edit({ playing: !store.state.playing });
  }

  #step(): void {
    this.host.store.edit({ playing: false });
    void this.#crowd?.step();
  }

  #showFigures(): void {
    this.#chosen.show();
    this.#peoplePanel.showFigures({
      fps: this.#fps,
      tickMs: this.#tickPace.ms,
      frameMs: this.#picture?.frameMs,
      drawnBy: rendererName(this.#picture?.drawnBy ?? ""),
    });
  }

  #onKey(event: KeyboardEvent): void {
    if (event.key !== "Escape" || event.defaultPrevented) return;
    if (this.#drawsRoute) this.#drawRoute(false);
    else if (this.#chosen.number !== undefined) this.#chosen.choose(undefined);
  }

  readonly keys: KeyTable = {
    " ": () => this.#togglePlay(),
    ArrowRight: () => this.#step(),
    n: () => this.#chosen.chooseNext(1),
    p: () => this.#chosen.chooseNext(-1),
    f: () => this.#chosen.toggleFollow(),
  };

  // --- exports ---

  /** Saves the picture, or a video of its next seconds. */
  async #export(what: "poster" | "video"): Promise<void> {
    const [crowd, picture] = [this.#crowd, this.#picture];
    if (!crowd || !picture || this.#films) return;
    this.#films = true;
    this.#showState();
    await this.#say(
      this.#progress.run(words.filming, async (call) => {
        const { outputsOf } = await import("./crowd_outputs");
        return outputsOf[what](picture, crowd, call);
      }),
    );
    this.#films = false;
    this.#showState();
  }

  /** Shows what was saved, or the error, unless it was cancelled. */
  async #say(saving: Promise<string>): Promise<void> {
    try {
      this.host.toasts.note(strings.page.outputs.saved(await saving));
    } catch (error) {
      if (!isCancellation(error)) this.host.toasts.error(errorText(error));
    }
  }
}

/** Estimated radius of the ground until the crowd reports it, metres: four square metres per agent. */
const radiusOf = (count: number): number => Math.max(8, Math.sqrt((4 * count) / Math.PI));
