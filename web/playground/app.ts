/** The playground: builds the page from its panels and keeps engine, state, URL and picture in step. */
import type { DroppedFile } from "../worker/build/protocol";
import type { Analysis, DatabaseInfo, DatabaseSource, InputInfo, LiveFrame, StrutClient } from "../worker/protocol";
import { commandsOf } from "./commands";
import { Databases } from "./databases";
import { html } from "./dom";
import { DropZone } from "./drop";
import { Heading } from "./heading";
import { type KeyActions, listenToKeys } from "./keys";
import { Links, linkedFile } from "./links";
import { Notices } from "./notices";
import type { OutputFormat, VideoSize } from "./outputs/formats";
import { launchOutput } from "./outputs/launch";
import { Help } from "./panels/help";
import { InputPanel } from "./panels/input_panel";
import { ModelPanel } from "./panels/model_panel";
import { StylePanel } from "./panels/style_panel";
import { Tabs } from "./panels/tabs";
import { TopBar } from "./panels/top_bar";
import { Transport } from "./panels/transport";
import { Playhead } from "./playhead";
import { firstSelection } from "./polygon/selection";
import { ProgressLine } from "./progress";
import { Session } from "./session";
import { Stage } from "./stage";
import { ENGINE_FIELDS, fromHash, type PlayState } from "./state";
import { type History, Store } from "./store";
import { strings } from "./strings/strings";
import {
  chooseKey,
  chosenKey,
  engineOptions,
  moveKey,
  partOf,
  removeKey,
  withKnownLabels,
  withKnownStyles,
} from "./style_settings";
import { applyTheme, isDark, onSystemTheme, opposite } from "./theme";
import { plantedStretches } from "./timeline/curves";
import { Timeline } from "./timeline/timeline";
import { TrackKeys } from "./timeline/track_keys";
import { Views } from "./views";
import { manner } from "./words";

/** What the Style panel and the title show. */
const STYLE_FIELDS = ["styles", "parts", "part", "track", "key", "wholePolygon", "intensity", "side"] as const;

type Changed = ReadonlySet<keyof PlayState>;
const any = (changed: Changed, ...names: (keyof PlayState)[]): boolean => names.some((name) => changed.has(name));

export class App {
  /** The link that the page was opened with. */
  readonly #hash = location.hash;
  readonly #store = new Store(fromHash(this.#hash));
  readonly #notices = new Notices();
  readonly #progress = { database: new ProgressLine(), input: new ProgressLine(), analysis: new ProgressLine() };
  readonly #help = new Help();
  readonly #drop: DropZone;
  readonly #topBar: TopBar;
  readonly #stage: Stage;
  readonly #heading: Heading;
  readonly #style: StylePanel;
  readonly #input: InputPanel;
  readonly #model: ModelPanel;
  readonly #tabs: Tabs;
  readonly #transport: Transport;
  readonly #timeline: Timeline;
  readonly #keys: TrackKeys;
  readonly #views: Views;
  readonly #playhead: Playhead;
  readonly #commands: KeyActions;
  readonly #links: Links;
  readonly #databases: Databases;
  readonly #root: HTMLElement;
  readonly #listening = new AbortController();
  #session: Session | undefined;
  #analysed = false;
  /** Styled poses of the whole input, whose path the picture shows. */
  #path: Float32Array | undefined;
  /** The file that a link was made with and does not hold, and the frame that it shows of it. */
  #awaited: { input: string; frame: number } | undefined;

  constructor(root: HTMLElement) {
    const store = this.#store;
    applyTheme(store.state.theme);
    this.#root = root;
    this.#databases = new Databases(store, this.#notices);
    this.#links = new Links(store, this.#notices);
    this.#playhead = new Playhead(store, (frame) => this.#onScrub(frame));
    this.#topBar = new TopBar({
      onView: (view) => store.edit({ view }),
      onUndo: () => this.#history.undo(),
      onRedo: () => this.#history.redo(),
      onShare: () => void this.#links.share(this.#session),
      onExport: (format, size) => void this.#export(format, size),
      onTheme: () => store.edit({ theme: opposite(store.state.theme) }),
      onHelp: () => this.#help.open(),
    });
    this.#stage = new Stage(isDark(store.state.theme) ? "dark" : "light", {
      onCamera: (camera) => store.edit({ camera }),
      onFollow: () => store.edit({ follow: !store.state.follow }),
      onGhost: () => this.#commands.ghost(),
      onTrace: () => this.#commands.trace(),
      onJoint: (role) => store.edit({ part: partOf(role), tab: "style" }),
    });
    this.#heading = new Heading(store, this.#stage, this.#playhead);
    this.#style = new StylePanel(store, this.#progress.database.element);
    this.#commands = commandsOf(store, this.#playhead, this.#style, this.#help, () => this.#history);
    this.#input = new InputPanel(
      { onChoose: (name) => void this.#choose(name), onFile: () => this.#drop.choose() },
      this.#progress.input.element,
    );
    this.#model = new ModelPanel(store);
    this.#tabs = new Tabs((tab) => store.edit({ tab }));
    const playhead = this.#playhead;
    const scrub = { onScrub: (frame: number) => playhead.scrub(frame), onScrubEnd: () => playhead.endScrub() };
    this.#transport = new Transport(store, {
      onPlay: () => playhead.togglePlay(),
      onFrame: (by) => playhead.step(by),
      onKey: () => this.#commands.key(),
      ...scrub,
    });
    this.#keys = new TrackKeys({
      onChoose: (key) => {
        store.edit(chooseKey(store.state, key));
        this.#playhead.goTo(store.state.track[key]?.frame ?? 0);
      },
      onMove: (key, frame) => store.edit(moveKey(store.state, key, frame), `key ${key}`),
      onSettle: () => store.endGesture(),
      onRemove: (key) => store.edit(removeKey(store.state, key)),
    });
    this.#timeline = new Timeline(
      {
        ...scrub,
        onHover: (frame) => playhead.preview(frame),
        onRange: (range) => store.edit({ range }),
        onCurve: (curve) => store.edit({ curve }),
      },
      this.#keys.element,
    );
    this.#timeline.onLayout = () => this.#keys.layOut();
    this.#keys.places = this.#timeline;
    this.#drop = new DropZone({
      viewTakesAll: () => store.state.view === "data",
      onMotion: (name, bytes) =>
        void (store.state.view === "key-style"
          ? this.#takeClips([{ path: name, file: new File([bytes], name) }])
          : this.#takeMotion(name, bytes)),
      onDatabase: (name, file) => void this.#openDatabase({ kind: "strutdb", name, file }, ""),
      onStyle: (file) => void this.#takeStyle(file),
      styleTarget: () =>
        store.state.view === "play" && this.#session?.database ? this.#style.polygon.element : undefined,
      onClips: (files) => void this.#takeClips(files),
      onRefused: (sentence) => this.#notices.error(sentence),
    });
    const panels = html(
      "aside",
      { class: "panels", "aria-label": "Controls" },
      this.#style.element,
      this.#input.element,
      this.#model.element,
    );
    const transport = html(
      "section",
      { class: "transport", "aria-label": "Transport" },
      this.#progress.analysis.element,
      this.#transport.element,
      this.#timeline.element,
    );
    root.append(this.#topBar.element, this.#stage.element, this.#tabs.element, panels, transport);
    root.append(this.#notices.element, this.#drop.element, this.#help.element);
    this.#views = new Views(root, {
      store,
      notices: this.#notices,
      openDatabase: (name, file, kept) => this.#openDatabase({ kind: "strutdb", name, file }, kept ? name : ""),
      borrowPicture: (container) => ({
        viewer: this.#stage.lend(container),
        invalidate: () => this.#stage.invalidate(),
        freeze: (frozen) => {
          this.#stage.frozen = frozen;
        },
      }),
      historyChanged: () => this.#showTopBar(),
      session: () => this.#session,
      chooseInput: (name) => void this.#choose(name),
      playhead: () => this.#playhead.at,
      goTo: (frame) => this.#playhead.goTo(frame),
      databaseFile: () => this.#databases.file,
      playMotion: async (name, bytes) => {
        store.edit({ view: "play" });
        await this.#takeMotion(name, bytes);
      },
      openBuiltIn: () => this.#openDatabase({ kind: "demo" }, ""),
    });
    this.#topBar.canExport = false;
    store.subscribe((state, changed) => this.#onChange(state, changed));
    this.#show(store.state);
    this.#listen();
  }

  /** Takes the engine and opens what the link asks for. */
  async start(client: StrutClient): Promise<void> {
    const session = new Session(client, this.#progress, {
      onDatabase: (database) => this.#onDatabase(database),
      onInput: (input) => this.#onInput(input),
      onAnalysis: (analysis) => this.#onAnalysis(analysis),
      onExamples: (examples) => {
        this.#timeline.examples = examples;
      },
      onFrame: (frame, sought) => this.#onFrame(frame, sought),
      onTick: (now) => this.#stage.draw(now),
      onError: (sentence) => this.#notices.error(sentence),
      onStopped: () => this.#store.edit({ playing: false }),
      onNote: (sentence) => this.#notices.note(sentence),
    });
    this.#session = session;
    session.curve = this.#timeline.subject;
    this.#playhead.session = session;
    this.#heading.session = session;
    const wanted = this.#store.state.input;
    const carried = linkedFile(this.#hash);
    await session.openDatabase(await this.#databases.wanted(), wanted);
    const file = await carried;
    if (file) await this.#takeMotion(file.name, file.bytes);
    else if (wanted && session.input && session.inputName !== wanted) {
      this.#awaited = { input: wanted, frame: this.#store.state.frame };
      this.#store.adopt({ input: "" });
      this.#notices.note(strings.page.links.fileMissing(wanted));
    }
    const { loop, range, frame, playing } = this.#store.state;
    session.setLoop(loop, range);
    if (!playing && frame > 0) session.playback.seek(frame);
    session.playback.start();
  }

  /** Says why there is no engine; the page stays as it is. */
  fail(sentence: string): void {
    this.#notices.error(sentence);
  }

  /** What {@link StrutHook} shows. */
  get frame(): LiveFrame | undefined {
    return this.#playhead.frame;
  }

  get state(): Readonly<PlayState> {
    return this.#store.state;
  }

  get upToDate(): boolean {
    return this.#session?.playback.upToDate ?? false;
  }

  get analysed(): boolean {
    return this.#analysed;
  }

  get stage(): Stage {
    return this.#stage;
  }

  dispose(): void {
    this.#listening.abort();
    this.#links.dispose();
    this.#session?.dispose();
    this.#stage.dispose();
    this.#views.dispose();
    this.#root.replaceChildren();
  }

  // --- from the engine ---

  #onDatabase(database: DatabaseInfo): void {
    this.#style.database = database;
    this.#model.database = database;
    this.#timeline.classes = database.classes;
    if (this.#store.state.view === "play") this.#stage.viewer.setProportions(database.proportions);
    this.#completeStyles(database);
    this.#show(this.#store.state);
    this.#configure();
  }

  /** Drops styles that the database does not have, and chooses some where none is left; whether it had to. */
  #completeStyles(database: DatabaseInfo): boolean {
    const first = firstSelection(database.styles, database.neutral);
    const styles = withKnownStyles(this.#store.state, database.styles, first);
    const labels = withKnownLabels(this.#store.state, database.classes);
    if (styles || labels) this.#store.adopt({ ...styles, ...labels });
    return styles !== undefined || labels !== undefined;
  }

  #onInput(input: InputInfo): void {
    this.#analysed = false;
    this.#path = undefined;
    this.#stage.viewer.setPath(null);
    this.#stage.viewer.resetTrail();
    this.#input.list(this.#session!.library, this.#session!.inputName);
    this.#input.input = input;
    this.#transport.input = input;
    this.#timeline.input = input;
    this.#keys.input = input;
    this.#topBar.canExport = true;
    this.#notices.clearErrors();
    this.#heading.show();
    this.#views.shown?.refresh?.();
  }

  #onAnalysis(analysis: Analysis): void {
    this.#analysed = true;
    this.#timeline.analysis = analysis;
    this.#transport.contacts = [plantedStretches(analysis.planted, 0), plantedStretches(analysis.planted, 1)];
    this.#path = analysis.poses;
    if (this.#store.state.view === "play") this.#stage.viewer.setPath(analysis.poses);
    this.#stage.invalidate();
  }

  #onFrame(frame: LiveFrame, sought: boolean): void {
    this.#playhead.take(frame, sought);
    if (sought) this.#stage.viewer.resetTrail();
    this.#stage.take(frame);
    this.#input.read(frame.reads);
    if (!this.#playhead.previewing) {
      this.#transport.frame = frame.inputFrame;
      if (!this.#playhead.scrubbing) this.#timeline.frame = frame.inputFrame;
    }
    this.#heading.take(frame.reads);
    if (frame.ended && this.#store.state.playing) this.#playhead.pause();
  }

  // --- from the state ---

  #onChange(state: Readonly<PlayState>, changed: Changed): void {
    const session = this.#session;
    const moving = changed.has("database") && this.#databases.moving;
    // Adopting the missing styles is a change of its own, which shows the rest too. Another database has other styles.
    const restyled = !moving && any(changed, "styles", "parts", "track", "action", "inputStyle");
    if (session?.database && restyled && this.#completeStyles(session.database)) {
      this.#onChange(this.#store.state, changed);
      return;
    }
    if (changed.has("theme")) this.#applyTheme();
    if (session && any(changed, "loop", "range")) session.setLoop(state.loop, state.range);
    if (!moving && any(changed, ...ENGINE_FIELDS)) this.#configure();
    if (session?.input && changed.has("input")) this.#followInput(state.input);
    if (session?.database && moving) void this.#databases.follow(session);
    this.#show(state, changed);
    this.#links.writeSoon();
  }

  #configure(): void {
    const session = this.#session;
    if (!session?.database) return;
    session.playback.options = engineOptions(this.#store.state, session.database.neutral);
    this.#analysed = false;
    session.analyseSoon();
  }

  #show(state: Readonly<PlayState>, changed?: Changed): void {
    this.#showTopBar();
    if (!changed || changed.has("view")) {
      this.#root.dataset.view = state.view;
      void this.#views.show(state.view).then((view) => {
        if (changed && !view && this.#store.state.view === "play") this.#takePictureBack();
        this.#showTopBar();
      });
    }
    if (!changed || any(changed, "camera", "follow", "ghost", "trace", "part")) this.#stage.show(state);
    if (!changed || any(changed, ...STYLE_FIELDS)) {
      this.#style.show(state, changed !== undefined);
      this.#showTrack(state);
      this.#heading.show();
    }
    if (!changed || changed.has("range")) this.#timeline.range = state.range;
    if (!changed || changed.has("curve")) {
      this.#timeline.curve = state.curve;
      if (this.#session) this.#session.curve = this.#timeline.subject;
    }
    this.#model.show(state);
    this.#transport.show(state);
    this.#tabs.show(state.tab);
    this.#root.dataset.tab = state.tab;
    this.#root.classList.toggle("bare", !state.panels);
    if (this.#session) {
      this.#session.playback.playing = state.playing && state.view === "play" && !this.#playhead.scrubbing;
      this.#session.playback.speed = state.speed;
    }
  }

  #showTrack(state: Readonly<PlayState>): void {
    const neutral = this.#session?.database?.neutral ?? "";
    this.#keys.show(state.track, chosenKey(state), (key) => manner(key.styles, state.intensity, neutral));
  }

  #showTopBar(): void {
    const { view, theme } = this.#store.state;
    const { canUndo, canRedo } = this.#history;
    this.#topBar.show({ view, canUndo, canRedo, dark: isDark(theme) });
  }

  get #history(): History {
    return this.#views.shown?.history ?? this.#store;
  }

  /** Shows in the picture what it showed before another view borrowed it. */
  #takePictureBack(): void {
    const { database } = this.#session ?? {};
    this.#stage.takeBack();
    if (database) this.#stage.viewer.setProportions(database.proportions);
    if (this.#path) this.#stage.viewer.setPath(this.#path);
    this.#stage.show(this.#store.state);
    if (this.#playhead.frame) this.#stage.take(this.#playhead.frame);
  }

  #applyTheme(): void {
    const { theme } = this.#store.state;
    applyTheme(theme);
    this.#stage.viewer.theme = isDark(theme) ? "dark" : "light";
    this.#stage.invalidate();
    this.#timeline.recolour();
  }

  // --- from the person ---

  #listen(): void {
    const { signal } = this.#listening;
    const store = this.#store;
    onSystemTheme(() => {
      this.#applyTheme();
      this.#show(store.state);
    }, signal);
    addEventListener("hashchange", ({ newURL }) => this.#followLink(new URL(newURL).hash), { signal });
    listenToKeys(this.#commands, () => store.state.view === "play", signal);
  }

  #followLink(hash: string): void {
    this.#links.follow(hash);
    const { playing, frame } = this.#store.state;
    if (!playing) this.#playhead.goTo(frame);
  }

  #onScrub(frame: number | undefined): void {
    if (frame !== undefined) this.#timeline.frame = frame;
    else this.#show(this.#store.state, new Set());
  }

  async #choose(name: string): Promise<void> {
    const session = this.#session;
    if (!session) return;
    if ((await session.openInput(name)) === "done")
      this.#store.edit({ input: name === session.library.first ? "" : name });
    else this.#input.list(session.library, session.inputName);
  }

  /** Opens the input that undo, redo or a link brought; where that fails the state goes back to what is open. */
  #followInput(wanted: string): void {
    const session = this.#session!;
    const name = wanted || session.library.first;
    if (name === session.inputName) return;
    void session.openInput(name).then((outcome) => {
      if (outcome !== "done")
        this.#store.adopt({ input: session.inputName === session.library.first ? "" : session.inputName });
    });
  }

  async #takeMotion(fileName: string, bytes: ArrayBuffer): Promise<void> {
    const name = await this.#session?.openFile(fileName, bytes);
    if (name === undefined) return;
    this.#store.edit({ input: name });
    // The link is complete now: it shows its own instant.
    if (name === this.#awaited?.input && !this.#store.state.playing) this.#playhead.goTo(this.#awaited.frame);
    this.#awaited = undefined;
  }

  #openDatabase(source: DatabaseSource, kept: string): Promise<boolean> {
    const session = this.#session;
    return session ? this.#databases.open(session, source, kept) : Promise.resolve(false);
  }

  async #takeStyle(clip: File): Promise<void> {
    if (this.#session) await this.#databases.addStyle(this.#session, clip, this.#progress.database);
  }

  async #takeClips(files: DroppedFile[]): Promise<void> {
    // The Key-style view learns from clips as they are; elsewhere they are a database to be.
    const view = this.#store.state.view === "key-style" ? "key-style" : "data";
    this.#store.edit({ view });
    (await this.#views.show(view))?.takeFiles(files);
  }

  async #export(format: OutputFormat, size: VideoSize): Promise<void> {
    const session = this.#session;
    if (!session) return;
    this.#topBar.canExport = false;
    await launchOutput(format, size, {
      session,
      store: this.#store,
      stage: this.#stage,
      playhead: this.#playhead,
      notices: this.#notices,
      progress: this.#progress.database,
    });
    this.#topBar.canExport = true;
  }
}
