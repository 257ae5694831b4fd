/** The Crowd view: people on open ground, each in the styles of the place where they walk. */
import "../synthesis/editor.css";
import "./crowd.css";
import { type Crowd, type CrowdTick, createCrowd } from "../../../client/crowd/crowd_client";
import type { FieldVertex } from "../../../client/crowd/limits";
import { type CallOptions, isCancellation } from "../../../client/protocol";
import { button, Segment } from "../../../ui/controls/buttons";
import { html, setText } from "../../../ui/dom";
import { isDark, onSystemTheme } from "../../../ui/theme";
import { graphics } from "../../../viewer";
import { drawnBones } from "../../../viewer/crowd/crowd_viewer";
import { saveBvh } from "../../outputs/save_motion";
import { CROWD_CAMERAS, type CrowdCamera } from "../../state/crowd";
import { strings } from "../../strings/strings";
import { ProgressLine } from "../../ui/progress";
import { errorText } from "../../ui/words";
import type { KeyTable, View, ViewHost } from "../../view";
import { EmptyPanel } from "../synthesis/empty_panel";
import { WalkModels, type WalkSource } from "../synthesis/walk_models";
import { Census, COUNTS_HZ } from "./census";
import { StyleColours } from "./colours";
import { outputsOf } from "./crowd_outputs";
import { rendererName } from "./drawn_by";
import { firstField, withoutVertex, withStyle, withVertex } from "./field";
import { FieldPanel } from "./field_panel";
import { Footer } from "./footer";
import { Handles } from "./handles";
import { Latest } from "./latest";
import { PeoplePanel } from "./people_panel";
import { CrowdPicture } from "./picture";
import { Settings, type Styles } from "./settings";
import { ShareChart } from "./share_chart";
import { crowdTitle, pictureOf } from "./titles";
import { WalkerCard } from "./walker_card";
import { asWalkBlock, Strides, sharesOf } from "./walker_facts";

export function createView(host: ViewHost): View {
  return new CrowdView(host);
}

const words = strings.crowd;

const BUILT_IN: WalkSource = { name: "", file: undefined, neutral: "neutral" };
/** Most who walk where the processor draws. */
const SOFTWARE_COUNT = 100;
/** How often figures and the card are shown, a second of the crowd's time. */
const FIGURES_HZ = 5;
/** Length of the motion that is saved of a walker, seconds. */
const BVH_SECS = 10;

class CrowdView implements View {
  readonly element: HTMLElement;
  readonly #host: ViewHost;
  readonly #models = new WalkModels();
  readonly #progress = new ProgressLine();
  readonly #settings: Settings;
  readonly #colours = new StyleColours();
  readonly #stage = html("div", { class: "editor-stage" });
  readonly #title = html("h1", { class: "stage-title" });
  readonly #caption = html("p", { class: "caption" }, words.generated);
  readonly #counted = html("p", { class: "crowd-counted caption" });
  readonly #cameras: Segment<CrowdCamera>;
  readonly #map: HTMLButtonElement;
  readonly #empty = new EmptyPanel();
  readonly #handles: Handles;
  readonly #card: WalkerCard;
  readonly #fieldPanel: FieldPanel;
  readonly #peoplePanel: PeoplePanel;
  readonly #chart = new ShareChart(this.#colours);
  readonly #footer: Footer;
  readonly #send = new Latest<readonly FieldVertex[]>((field) => this.#trySending(field));
  #picture: CrowdPicture | undefined;
  #crowd: Crowd | undefined;
  /** What the crowd was opened with, or is being. */
  #opened: { source: WalkSource; seed: number } | undefined;
  #opening: AbortController | undefined;
  #styles: Styles | undefined;
  #replaced: WalkSource | undefined;
  /** The count that was asked for, and how many the worker is fast enough for. */
  #asked = 0;
  #slowed: number | undefined;
  #tick: CrowdTick | undefined;
  #tickAt = 0;
  #ticks = 0;
  #tickMs: number | undefined;
  #fps: number | undefined;
  #census: Census | undefined;
  readonly #strides = new Strides();
  #drawsRoute = false;
  #films = false;
  #request = 0;
  /** Ends when the view is hidden, with everything that listens; `undefined` while it is hidden. */
  #shown: AbortController | undefined;

  constructor(host: ViewHost) {
    this.#host = host;
    const { store } = host;
    this.#settings = new Settings(store, (sentence) => host.toasts.error(sentence));
    const gestures = store.gestureListeners;
    this.#handles = new Handles({
      ...gestures,
      onChoose: (crowdVertex) => store.edit({ crowdVertex }),
      onMove: (index, x, z) => this.#change(index, { x, z }, "crowd place"),
      onReach: (index, reach) => this.#change(index, { reach }, "crowd reach"),
      onRemove: (index) => this.#remove(index),
    });
    this.#card = new WalkerCard({
      onFollow: () => store.edit({ crowdFollow: !store.state.crowdFollow }),
      onExport: () => void this.#exportBvh(),
      onOpen: () => this.#openInWalk(),
      onClose: () => this.#choose(undefined),
    });
    this.#fieldPanel = new FieldPanel(this.#colours, {
      ...gestures,
      onChoose: (crowdVertex) => store.edit({ crowdVertex }),
      onChange: (index, patch) => this.#change(index, patch, `crowd ${Object.keys(patch).join()}`),
      onAdd: (style) => this.#add(style),
      onRemove: (index) => this.#remove(index),
      onReset: () => {
        if (this.#styles) store.edit({ field: firstField(this.#styles.all, this.#styles.neutral), crowdVertex: 0 });
      },
    });
    this.#peoplePanel = new PeoplePanel({
      onSettle: gestures.onSettle,
      onCount: (count) => store.edit({ crowd: { ...this.#read().people, count } }, "crowd count"),
      onSeed: (seed) => store.edit({ crowd: { ...this.#read().people, seed } }),
      onDraw: () => this.#drawRoute(!this.#drawsRoute),
      onClear: () => store.edit({ route: [] }),
    });
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
    this.#footer = new Footer(this.#chart, {
      onPlay: () => this.#togglePlay(),
      onStep: () => this.#step(),
      onSpeed: (speed) => store.edit({ speed }),
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
        this.#card.element,
        this.#progress.element,
        this.#empty.element,
      ),
      this.#footer.element,
      html("div", { class: "crowd-panel" }, this.#fieldPanel.element, this.#peoplePanel.element),
    );
  }

  get history() {
    return this.#host.store;
  }

  show(): void {
    this.#shown = new AbortController();
    const { signal } = this.#shown;
    const { store } = this.#host;
    this.#colours.theme = isDark(store.state.theme) ? "dark" : "light";
    this.#picture = new CrowdPicture(
      this.#stage,
      { colours: this.#colours, handles: this.#handles, card: this.#card.element },
      {
        onWalker: (walker) => this.#choose(walker),
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
    this.#request = requestAnimationFrame(this.#draw);
  }

  hide(): void {
    this.#shown?.abort();
    this.#shown = undefined;
    this.#opening?.abort();
    this.#progress.cancel();
    cancelAnimationFrame(this.#request);
    this.#close();
    this.#opened = undefined;
    this.#picture = undefined;
    this.#tick = undefined;
    this.#drawsRoute = false;
  }

  /** Shows walkers of the database that is open. */
  refresh(): void {
    if (!this.#shown) return;
    const { state } = this.#host.store;
    const { database } = this.#host.session;
    this.#showState();
    // A database that is kept on this device is opened first; the page asks again once it is.
    if (state.database !== "" && !database) return;
    const { name, file } = this.#host.databaseFile();
    if (this.#replaced?.file !== file) this.#replaced = undefined;
    const source = this.#replaced || !file ? BUILT_IN : { name, file, neutral: database?.neutral ?? "" };
    if (this.#opened?.source.file === source.file && this.#opened) return;
    void this.#open(source);
  }

  dispose(): void {
    this.hide();
  }

  // --- the crowd ---

  /** Gathers people anew, by the model of a database, which is trained unless it is known. */
  async #open(source: WalkSource): Promise<void> {
    this.#opening?.abort();
    const opening = new AbortController();
    this.#opening = opening;
    this.#empty.hide();
    const { people } = this.#read();
    this.#opened = { source, seed: people.seed };
    this.#asked = people.count;
    try {
      const label = source.file ? words.training : words.opening;
      const crowd = await this.#progress.run(label, (call) => this.#gather(source, people.seed, call));
      if (opening.signal.aborted) crowd.dispose();
      else this.#present(crowd);
    } catch (error) {
      if (!opening.signal.aborted) this.#refuse(source, isCancellation(error) ? "" : errorText(error));
    }
  }

  async #gather(source: WalkSource, seed: number, call: CallOptions): Promise<Crowd> {
    const model = source.file ? (await this.#models.of(source, call)).trained.file : undefined;
    call.signal?.throwIfAborted();
    const fieldOf = (all: readonly string[]) => {
      this.#styles = { all, neutral: all.includes(source.neutral) ? source.neutral : "" };
      if (all.length === 1) this.#host.toasts.note(words.oneStyle);
      return this.#read().field;
    };
    const { people, route } = this.#read();
    const start = { count: this.#fitting(people.count), seed, route, fieldOf, bonesOf: drawnBones };
    return createCrowd(
      { kind: "walkers", ...(model && { model }) },
      { ...start, ...(call.signal && { signal: call.signal }) },
    );
  }

  /** Shows a crowd in place of the one before. */
  #present(crowd: Crowd): void {
    this.#close();
    this.#crowd = crowd;
    this.#census = new Census(crowd.styles.length);
    this.#strides.forget();
    this.#tick = undefined;
    this.#ticks = 0;
    this.#sent = { count: 0, field: "", route: "" };
    this.#picture!.setProportions(crowd.proportions);
    this.#fieldPanel.setStyles(crowd.styles);
    crowd.onTick = (tick) => this.#onTick(tick);
    crowd.onHalved = (count) => this.#onHalved(count);
    crowd.onError = (error) => {
      this.#crowd = undefined;
      this.#refuse(this.#opened!.source, errorText(error));
    };
    this.#showState();
    // Who came paused is seen all the same.
    if (!crowd.playing) void crowd.step();
  }

  #close(): void {
    this.#crowd?.dispose();
    this.#crowd = undefined;
  }

  /** Says why nobody walks, and what can be done; a crowd that walks goes on. */
  #refuse(source: WalkSource, why: string): void {
    if (this.#crowd) {
      if (why !== "") this.#host.toasts.error(why);
      return;
    }
    this.#opened = undefined;
    const again = { label: words.startAgain, onChoose: () => void this.#open(source) };
    const builtIn = {
      label: words.useBuiltIn,
      onChoose: () => {
        this.#replaced = source;
        void this.#open(BUILT_IN);
      },
    };
    const message = why === "" ? words.stopped : words.noModel(source.name || words.builtInDatabase, why);
    this.#empty.show(message, source.file ? [builtIn, again] : [again]);
    this.#showState();
  }

  #read() {
    return this.#settings.read(this.#styles);
  }

  /** How many of those who are asked for can walk here. */
  #fitting(count: number): number {
    const most = graphics() === "software" ? SOFTWARE_COUNT : Number.POSITIVE_INFINITY;
    return Math.min(count, most, this.#slowed ?? count);
  }

  // --- the state ---

  #showState(): void {
    const picture = this.#picture;
    if (!this.#shown || !picture) return;
    const { store } = this.#host;
    const { people, field, route } = this.#read();
    const { state } = store;
    const crowd = this.#crowd;
    if (people.count !== this.#asked) {
      this.#asked = people.count;
      this.#slowed = undefined;
    }
    if (this.#opened && people.seed !== this.#opened.seed) {
      void this.#open(this.#opened.source);
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
    if (crowd) this.#apply(crowd, count, field, route);
    picture.setField(field, chosen, state.crowdMap, this.#radius);
    picture.setRoute(route);
    picture.camera = state.crowdCamera;
    picture.description = pictureOf(count, field);
    this.#fieldPanel.show(field, chosen);
    const limit =
      this.#slowed !== undefined ? words.slowed(count) : count < people.count ? words.software(SOFTWARE_COUNT) : "";
    this.#peoplePanel.showPeople(people, limit);
    this.#peoplePanel.showRoute(route.length > 0, this.#drawsRoute);
    picture.drawing = this.#drawsRoute;
    this.#cameras.value = state.crowdCamera;
    this.#map.setAttribute("aria-pressed", String(state.crowdMap));
    this.#footer.show(state.playing, state.speed, crowd !== undefined && !this.#films);
    setText(this.#title, crowd ? crowdTitle(count, field) : words.opening);
    setText(this.#counted, `${words.walkers(count)} · ${words.grid}`);
    this.#showWalker();
    this.#recolour();
  }

  #sent: { count: number; field: string; route: string } = { count: 0, field: "", route: "" };

  /** Has the crowd walk by the settings. */
  #apply(
    crowd: Crowd,
    count: number,
    field: readonly FieldVertex[],
    route: readonly (readonly [number, number])[],
  ): void {
    const { state } = this.#host.store;
    crowd.playing = state.playing && !this.#films;
    crowd.speed = state.speed;
    const [fieldText, routeText] = [JSON.stringify(field), JSON.stringify(route)];
    const fail = (error: unknown) => this.#fail(error);
    if (count !== this.#sent.count) crowd.setCount(count).catch(fail);
    if (fieldText !== this.#sent.field) this.#send.push(field);
    if (routeText !== this.#sent.route) crowd.setRoute(route).catch(fail);
    this.#sent = { count, field: fieldText, route: routeText };
  }

  async #trySending(field: readonly FieldVertex[]): Promise<void> {
    await this.#crowd?.setField(field).catch((error: unknown) => this.#fail(error));
  }

  /** Says what failed, unless the crowd was left meanwhile. */
  #fail(error: unknown): void {
    if (this.#crowd) this.#host.toasts.error(errorText(error));
  }

  get #radius(): number {
    return this.#tick?.radius ?? radiusOf(this.#fitting(this.#asked));
  }

  #change(index: number, patch: Partial<FieldVertex>, gesture: string): void {
    const { store } = this.#host;
    store.edit({ field: withVertex(this.#read().field, index, patch), crowdVertex: index }, gesture);
  }

  #add(style: string): void {
    const field = withStyle(this.#read().field, style, this.#radius);
    this.#host.store.edit({ field, crowdVertex: field.length - 1 });
  }

  #remove(index: number): void {
    const field = withoutVertex(this.#read().field, index);
    this.#host.store.edit({ field, crowdVertex: Math.max(0, index - 1) });
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
    this.#tickMs = this.#tickMs === undefined ? tick.tickMs : this.#tickMs + 0.05 * (tick.tickMs - this.#tickMs);
    this.#picture!.setTick(tick, this.#crowd!.styles, other);
    if (radius !== tick.radius) this.#showState();
    const { rateHz } = this.#crowd!;
    this.#footer.secs = this.#ticks / rateHz;
    if (this.#ticks % (rateHz / COUNTS_HZ) === 0) {
      this.#census!.add(tick.weights);
      this.#chart.show(this.#census, this.#crowd!.styles);
    }
    const walker = this.#walker;
    if (walker !== undefined) this.#strides.add(tick, walker);
    if (this.#ticks % (rateHz / FIGURES_HZ) === 0) this.#showFigures();
    this.#ticks += 1;
  }

  #onHalved(count: number): void {
    this.#slowed = count;
    this.#sent.count = count;
    this.#host.toasts.note(words.slowed(count));
    this.#showState();
  }

  /** The colours of everybody follow those of the styles, though no tick comes. */
  #recolour(): void {
    if (this.#crowd && this.#tick && !this.#crowd.playing) this.#picture?.setTick(this.#tick, this.#crowd.styles, true);
  }

  readonly #draw = (now: number): void => {
    this.#request = requestAnimationFrame(this.#draw);
    if (this.#films) return;
    const crowd = this.#crowd;
    const share = crowd?.playing ? Math.min(1, Math.max(0, (performance.now() - this.#tickAt) / crowd.periodMs)) : 1;
    this.#picture!.draw(now, share);
  };

  #togglePlay(): void {
    const { store } = this.#host;
    if (this.#crowd) store.edit({ playing: !store.state.playing });
  }

  #step(): void {
    this.#host.store.edit({ playing: false });
    void this.#crowd?.step();
  }

  // --- one of them ---

  get #walker(): number | undefined {
    const { crowdWalker } = this.#host.store.state;
    return crowdWalker >= 0 && crowdWalker < (this.#tick?.count ?? 0) ? crowdWalker : undefined;
  }

  #choose(walker: number | undefined): void {
    const { store } = this.#host;
    const same = walker === undefined || walker === store.state.crowdWalker;
    store.edit({ crowdWalker: walker ?? -1, ...(same && { crowdFollow: false }) });
  }

  #showWalker(): void {
    const walker = this.#walker;
    const { crowdFollow } = this.#host.store.state;
    this.#picture?.choose(walker, crowdFollow);
    const tick = this.#tick;
    const model =
      walker !== undefined && tick && this.#crowd ? { walker, tick, styles: this.#crowd.styles } : undefined;
    this.#card.show(
      model && {
        walker: model.walker,
        speed: this.#strides.speed(model.walker, this.#crowd!.rateHz),
        shares: sharesOf(model.tick, model.walker, model.styles, this.#read().field),
        follows: crowdFollow,
      },
    );
  }

  #showFigures(): void {
    this.#showWalker();
    this.#peoplePanel.showFigures({
      fps: this.#fps,
      tickMs: this.#tickMs,
      frameMs: this.#picture?.frameMs,
      drawnBy: rendererName(this.#picture?.drawnBy ?? ""),
    });
  }

  #onKey(event: KeyboardEvent): void {
    if (event.key !== "Escape" || event.defaultPrevented) return;
    if (this.#drawsRoute) this.#drawRoute(false);
    else if (this.#walker !== undefined) this.#choose(undefined);
  }

  /** Goes on to another walker. */
  #chooseNext(by: number): void {
    const count = this.#tick?.count ?? 0;
    if (count === 0) return;
    const from = this.#walker ?? (by > 0 ? -1 : count);
    this.#host.store.edit({ crowdWalker: (from + by + count) % count });
  }

  readonly keys: KeyTable = {
    " ": () => this.#togglePlay(),
    ArrowRight: () => this.#step(),
    n: () => this.#chooseNext(1),
    p: () => this.#chooseNext(-1),
    f: () => {
      const { store } = this.#host;
      if (this.#walker !== undefined) store.edit({ crowdFollow: !store.state.crowdFollow });
    },
  };

  // --- what leaves the view ---

  async #exportBvh(): Promise<void> {
    const walker = this.#walker;
    if (walker === undefined || !this.#crowd) return;
    this.#card.exporting = true;
    try {
      const text = await this.#crowd.exportBvh(walker, BVH_SECS);
      this.#host.toasts.note(strings.synthesis.saved(saveBvh(words.bvhName(walker + 1), text)));
    } catch (error) {
      this.#fail(error);
    }
    this.#card.exporting = false;
  }

  /** Goes to the Walk view, with a plan of the styles that somebody walks in. */
  #openInWalk(): void {
    const walker = this.#walker;
    if (walker === undefined || !this.#tick || !this.#crowd) return;
    const block = asWalkBlock(this.#tick, walker, this.#crowd.styles);
    this.#host.store.edit({ view: "walk", walk: [block], walkBlock: 0, walkWhole: true });
  }

  /** Saves the picture, or the next seconds of it as a video. */
  async #export(what: "poster" | "video"): Promise<void> {
    const [crowd, picture] = [this.#crowd, this.#picture];
    if (!crowd || !picture || this.#films) return;
    this.#films = true;
    this.#showState();
    try {
      const name = await this.#progress.run(words.recording, (call) => outputsOf[what](picture, crowd, call));
      this.#host.toasts.note(strings.page.outputs.saved(name));
    } catch (error) {
      if (!isCancellation(error)) this.#host.toasts.error(errorText(error));
    }
    this.#films = false;
    this.#showState();
  }
}

/** Radius of the ground of so many until the crowd says it, metres: four square metres for everybody. */
const radiusOf = (count: number): number => Math.max(8, Math.sqrt((4 * count) / Math.PI));
