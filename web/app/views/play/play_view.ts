/** The Play view: the styled character, with panels for style, input and model, transport and timeline. */

import "./play_view.css";
import type { DriveFrame, DriveInfo } from "../../../client/drive/protocol";
import type { Analysis, DatabaseInfo, Examples, InputInfo, LiveFrame } from "../../../client/protocol";
import { createWorldPose, headingOf, POSE_FLOATS, worldFromLocal } from "../../../humanoid";
import { isLive } from "../../../player/input_library";
import type { LivePerformer } from "../../../player/session";
import { html } from "../../../ui/dom";
import { onSystemTheme } from "../../../ui/theme";
import type { AppState } from "../../state/state";
import { chooseKey, chosenKey, keyUnder, moveKey, partOf, removeKey } from "../../state/style_settings";
import { strings } from "../../strings/strings";
import { showScrollCue } from "../../ui/scroll_cue";
import { manner } from "../../ui/words";
import type { View, ViewHost } from "../../view";
import type { AtlasPane } from "./atlas/atlas_pane";
import { AtlasGhosts } from "./atlas_ghosts";
import type { Driving } from "./drive/driving";
import { InputFile } from "./file/input_file";
import { Heading } from "./heading";
import { InputPanel } from "./input_panel";
import { keysOf, keysWithoutTime } from "./keys";
import { likenessOf } from "./likeness";
import type { Performance } from "./live/performance";
import { ModelPanel } from "./model_panel";
import { StylePanel } from "./style_panel";
import { Tabs } from "./tabs";
import { plantedStretches } from "./timeline/curves";
import { Timeline } from "./timeline/timeline";
import { TrackKeys } from "./timeline/track_keys";
import type { TrimListeners } from "./timeline/trim_handles";
import { Transport } from "./transport";
import { ViewportPanel } from "./viewport_panel";

export function createView(host: ViewHost): View {
  return new PlayView(host);
}

/** Fields on which the Style panel and the title depend. */
const STYLE_FIELDS = ["styles", "parts", "part", "track", "key", "wholePolygon", "intensity", "side"] as const;

type Changed = ReadonlySet<keyof AppState>;
const any = (changed: Changed, ...names: (keyof AppState)[]): boolean => names.some((name) => changed.has(name));

/** Initial heading of an input, radians about +Y. */
function headingOfInput({ poses }: InputInfo, database: DatabaseInfo | undefined): number | undefined {
  if (!database || poses.length < POSE_FLOATS) return undefined;
  const world = createWorldPose();
  worldFromLocal(database.proportions, poses.subarray(0, POSE_FLOATS), world);
  return headingOf(world, 0);
}

class PlayView implements View {
  readonly element: HTMLElement;
  readonly #keys: ReturnType<typeof keysOf>;
  readonly #host: ViewHost;
  readonly #viewport: ViewportPanel;
  readonly #heading: Heading;
  readonly #style: StylePanel;
  readonly #input: InputPanel;
  readonly #model: ModelPanel;
  readonly #tabs: Tabs;
  readonly #transport: Transport;
  readonly #timeline: Timeline;
  readonly #trackKeys: TrackKeys;
  readonly #transportElement = html("section", { class: "transport", "aria-label": strings.play.transport.name });
  readonly #ghosts: AtlasGhosts;
  /** The atlas, once it was opened. */
  #atlas: Promise<AtlasPane> | undefined;
  #atlasPane: AtlasPane | undefined;
  #shown = false;
  /** Driving, while a character is driven, and its code is loaded. */
  #driving: Driving | undefined;
  /** The live performance, while there is one, and its code is loaded. */
  #performance: Performance | undefined;
  readonly #file: InputFile;
  /** Initial heading of an opened input, until its first frame arrives and the camera is aimed. */
  #aim: number | undefined;
  /** The database shown in the panels. */
  #database: DatabaseInfo | undefined;

  constructor(host: ViewHost) {
    this.#host = host;
    const { store, session, playhead, progress, signal } = host;
    const frame = () => (session.endless || !session.input ? undefined : playhead.at);
    this.#style = new StylePanel(store, frame, () => host.chooseStyle(), progress.database.element);
    this.#keys = keysOf(store, session, playhead, this.#style);
    this.#viewport = new ViewportPanel({
      onCamera: (camera) => store.edit({ camera }),
      onFollow: () => this.#keys.f(),
      onGhost: () => this.#keys.g(),
      onTrace: () => this.#keys.t(),
      onLeave: () => host.leaveCharacter(),
      onCheck: () => host.checkJoints(),
      onJoint: (role) => store.edit({ part: partOf(role), tab: "style" }),
    });
    this.#heading = new Heading(store, session, playhead, this.#viewport);
    this.#input = new InputPanel(
      {
        onChoose: (name) => void this.#choose(name),
        onClip: (clip) => void this.#chooseClip(clip),
        onFile: () => host.chooseFile(),
        onRecorded: () => void host.tryRecorded(),
      },
      [progress.input.element, progress.character.element],
    );
    this.#model = new ModelPanel(store);
    this.#tabs = new Tabs((tab) => store.edit({ tab }));
    const time: TrimListeners = {
      onScrub: (frame) => playhead.scrub(frame),
      onScrubEnd: () => playhead.endScrub(),
      onRange: (range) => store.edit({ range }, "range"),
      ...store.gestureListeners,
    };
    this.#transport = new Transport(store, {
      onPlay: () => playhead.togglePlay(),
      onFrame: (by) => playhead.step(by),
      onKey: () => this.#keys.k(),
      ...time,
    });
    this.#trackKeys = new TrackKeys({
      onChoose: (key) => {
        // While the playhead is at the key, the polygon shows its styles, and edits change it.
        store.edit({ ...chooseKey(store.state, key), playing: false });
        playhead.goTo(store.state.track[key]?.frame ?? 0);
      },
      onMove: (key, frame) => {
        store.edit(moveKey(store.state, key, frame), `key ${key}`);
        playhead.goTo(store.state.track[key]?.frame ?? 0);
      },
      ...store.gestureListeners,
      onRemove: (key) => store.edit(removeKey(store.state, key)),
    });
    this.#timeline = new Timeline(
      {
        ...time,
        onHover: (frame) => playhead.preview(frame),
        onCurve: (curve) => store.edit({ curve }),
        onAtlas: () => this.keys.a(),
      },
      this.#trackKeys.element,
    );
    this.#ghosts = new AtlasGhosts(store, playhead, this.#viewport);
    this.#timeline.onLayout = () => this.#trackKeys.layOut();
    this.#trackKeys.places = this.#timeline;
    this.element = this.#compose();
    const [transport, input] = [this.#transport.element, this.#input.element];
    this.#file = new InputFile(host, { view: this.element, transport, input });
    playhead.onScrub = (frame) => this.#onScrub(frame);
    session.listen(
      {
        onDatabase: () => this.#show(store.state),
        onInput: (input) => this.#onInput(input),
        onDrive: (drive) => void this.#onDrive(drive),
        onLive: (live) => void this.#onLive(live),
        onLiveAsked: (name) => void this.#askForLive(name),
        onAnalysis: (analysis) => this.#onAnalysis(analysis),
        onExamples: (examples) => this.#onExamples(examples),
        onPrelude: (shown) => this.#viewport.drawPrelude(shown),
        onFrame: (frame, sought) => this.#onFrame(frame, sought),
      },
      signal,
    );
    store.subscribe((state, changed) => this.#onChange(state, changed), signal);
    onSystemTheme(() => this.#recolour(), signal);
    document.addEventListener("keydown", (event) => this.#onEscape(event), { signal });
    this.#show(store.state);
    this.#catchUp();
  }

  get history() {
    return this.#host.store;
  }

  get keys() {
    const driving = this.#driving;
    if (this.#performance) return keysWithoutTime(this.#keys);
    return driving ? { ...keysWithoutTime(this.#keys), "?": () => driving.toggleHelp() } : this.#keys;
  }

  get styleTarget(): Element | undefined {
    return this.#database && this.#style.polygon.element;
  }

  show(): void {
    const { session, store } = this.#host;
    this.#shown = true;
    this.#viewport.take(this.#host.borrowViewer(this.#viewport.picture));
    if (this.#database) this.#viewport.proportions = this.#database.proportions;
    this.#viewport.performing = this.#host.performing();
    this.#viewport.path = session.endless ? undefined : session.analysis?.poses;
    this.#viewport.show(store.state);
    if (this.#driving) this.#driving.lease = this.#viewport.lease;
    if (session.frame) this.#viewport.draw(session.frame);
    this.#play();
  }

  refresh(): void {
    const { session } = this.#host;
    this.#viewport.performing = this.#host.performing();
    if (session.database) this.#listInputs();
  }

  hide(): void {
    this.#shown = false;
    if (this.#driving) this.#driving.lease = undefined;
    this.#viewport.give();
    this.#play();
  }

  dispose(): void {
    if (this.#shown) this.hide();
    this.#driving?.dispose();
    this.#performance?.dispose();
    this.#host.playhead.onScrub = undefined;
    this.#timeline.dispose();
    this.#atlasPane?.dispose();
    this.#style.polygon.dispose();
  }

  #compose(): HTMLElement {
    this.#transportElement.append(
      this.#host.progress.analysis.element,
      this.#transport.element,
      this.#timeline.element,
    );
    const panels = html(
      "aside",
      { class: "panels", "aria-label": strings.play.controls },
      this.#style.element,
      this.#input.element,
      this.#model.element,
    );
    showScrollCue(panels, this.#host.signal);
    return html(
      "div",
      { class: "play-view" },
      this.#viewport.element,
      this.#tabs.element,
      panels,
      this.#transportElement,
    );
  }

  /** Applies the session's state from before the view was created. */
  #catchUp(): void {
    const { input, drive, live, liveAsked, analysis, examples, frame } = this.#host.session;
    if (input) this.#onInput(input);
    if (analysis) this.#onAnalysis(analysis);
    if (examples) this.#onExamples(examples);
    if (drive) void this.#onDrive(drive);
    if (live) void this.#onLive(live);
    if (liveAsked !== undefined) void this.#askForLive(liveAsked);
    if (frame) this.#onFrame(frame, true);
  }

  // --- from the engine ---

  #takeDatabase(): void {
    const { database } = this.#host.session;
    if (!database || database === this.#database) return;
    this.#database = database;
    this.#style.database = database;
    this.#model.database = database;
    this.#timeline.classes = database.classes;
    this.#viewport.proportions = database.proportions;
    if (this.#host.session.input) this.#listInputs();
  }

  #onInput(input: InputInfo): void {
    this.#viewport.path = undefined;
    this.#viewport.forgetTrail();
    this.#listInputs();
    this.#aim = headingOfInput(input, this.#database);
    this.#heading.forget();
    this.#input.input = input;
    this.#file.input = input;
    this.#transport.input = input;
    this.#timeline.input = input;
    this.#trackKeys.input = input;
    this.#heading.show();
  }

  /** Sets up driving, or removes it. */
  async #onDrive(drive: DriveInfo | undefined): Promise<void> {
    const { session } = this.#host;
    this.#driving?.dispose();
    this.#driving = undefined;
    this.element.classList.toggle("driving", drive !== undefined);
    if (drive) this.#file.close();
    this.#viewport.path = session.endless ? undefined : session.analysis?.poses;
    this.#viewport.forgetTrail();
    this.#listInputs();
    this.#heading.show();
    if (!drive) return;
    const { Driving } = await import("./drive/driving");
    if (session.drive !== drive || this.#host.signal.aborted) return;
    const { element: stage, picture, controls } = this.#viewport;
    const places = { stage, picture, controls, input: this.#input.element, transport: this.#transportElement };
    this.#driving = new Driving(this.#host, drive, places, {
      pause: () => this.#host.playhead.togglePlay(),
      corner: (by) => this.#style.corner(by),
      movePoint: (key) => this.#style.movePoint(key),
    });
    if (this.#shown) this.#driving.lease = this.#viewport.lease;
  }

  /** Sets up a live performance, or removes it. */
  async #onLive(live: LivePerformer | undefined): Promise<void> {
    const { session } = this.#host;
    this.#performance?.dispose();
    this.#performance = undefined;
    this.element.classList.toggle("live", live !== undefined);
    if (live) this.#file.close();
    this.#viewport.path = session.endless ? undefined : session.analysis?.poses;
    this.#viewport.forgetTrail();
    this.#listInputs();
    this.#heading.show();
    if (!live) return;
    const { Performance } = await import("./live/performance");
    if (session.live !== live || this.#host.signal.aborted) return;
    const places = { input: this.#input.element, transport: this.#transportElement };
    this.#performance = new Performance(this.#host, live, places);
  }

  /** Asks for a sender, with that of a name as the default. */
  async #askForLive(name: string): Promise<boolean> {
    this.#host.session.liveAsked = undefined;
    const { askForPerformer } = await import("./live/performance");
    return askForPerformer(this.#host, name);
  }

  /** See {@link View.keep}. */
  async keep(): Promise<boolean> {
    return (await (this.#driving ?? this.#performance)?.keep()) ?? true;
  }

  #onAnalysis(analysis: Analysis): void {
    this.#timeline.analysis = analysis;
    this.#input.styledNotes = analysis.notes;
    this.#file.styledNotes = analysis.notes;
    this.#takeLikeness(analysis);
    this.#transport.contacts = [plantedStretches(analysis.planted, 0), plantedStretches(analysis.planted, 1)];
    this.#viewport.path = analysis.poses;
  }

  #takeLikeness(analysis: Analysis): void {
    const { input, database, databaseSource, endless } = this.#host.session;
    if (!input || !database || endless) return;
    // All built-in clips contain movement.
    const likeness = likenessOf(input, analysis, database, databaseSource?.kind === "demo");
    this.#input.likeness = likeness;
    this.#file.likeness = likeness;
    if (likeness) this.#heading.takeWhole(likeness);
  }

  #onExamples(examples: Examples | undefined): void {
    this.#timeline.examples = examples;
  }

  #onFrame(frame: LiveFrame | DriveFrame, sought: boolean): void {
    const { playhead } = this.#host;
    if (sought) this.#viewport.forgetTrail();
    this.#viewport.draw(frame);
    if (this.#aim !== undefined) {
      this.#viewport.aim(this.#aim);
      this.#aim = undefined;
    }
    if (this.#host.session.drive && "root" in frame) this.#driving?.show(frame);
    this.#input.read(frame.reads);
    if (!playhead.previewing) {
      this.#transport.frame = frame.inputFrame;
      if (!playhead.scrubbing) this.#moveTo(frame.inputFrame);
    }
    this.#ghosts.follow(frame);
    this.#heading.take(frame.reads);
  }

  // --- from the state ---

  #onChange(state: Readonly<AppState>, changed: Changed): void {
    if (changed.has("theme")) this.#recolour();
    this.#show(state, changed);
  }

  #show(state: Readonly<AppState>, changed?: Changed): void {
    this.#takeDatabase();
    if (!changed || any(changed, "camera", "follow", "ghost", "trace", "part")) this.#viewport.show(state);
    const alongTrack = state.track.length > 0 && changed && any(changed, "frame", "playing");
    if (!changed || any(changed, ...STYLE_FIELDS) || alongTrack) {
      this.#style.show(state, changed !== undefined);
      this.#showTrack(state);
      this.#heading.show();
    }
    if (!changed || changed.has("range")) {
      this.#timeline.range = state.range;
      this.#file.range = state.range;
    }
    if (!changed || changed.has("curve")) {
      this.#timeline.curve = state.curve;
      this.#host.session.curve = this.#timeline.subject;
    }
    this.#model.show(state);
    if (changed && any(changed, "action", "inputStyle")) this.#file.showLikeness();
    this.#transport.show(state);
    if (!changed || changed.has("atlas") || changed.has("atlasWindows")) this.#showAtlas(state.atlas);
    this.#tabs.show(state.tab);
    this.element.dataset.tab = state.tab;
    this.element.classList.toggle("bare", !state.panels);
    this.#play();
  }

  #recolour(): void {
    this.#timeline.recolour();
    this.#driving?.recolour();
    this.#atlasPane?.recolour();
  }

  #moveTo(frame: number): void {
    this.#timeline.frame = frame;
    if (this.#atlasPane) this.#atlasPane.frame = frame;
  }

  /** Opens the atlas for a part of the body, or closes it. */
  #showAtlas(part: AppState["atlas"]): void {
    this.element.classList.toggle("with-atlas", part !== "");
    this.#timeline.atlas = part !== "";
    if (part === "") {
      this.#atlasPane?.hide();
      return;
    }
    this.#atlas ??= this.#loadAtlas();
    this.#atlas.then(
      (pane) => {
        const { atlas, atlasWindows } = this.#host.store.state;
        if (atlas !== "") pane.show(atlas, atlasWindows);
      },
      (error: Error) => this.#host.toasts.error(error.message),
    );
  }

  async #loadAtlas(): Promise<AtlasPane> {
    const { AtlasPane } = await import("./atlas/atlas_pane");
    const { session, store, toasts, playhead } = this.#host;
    const pane = new AtlasPane({
      session,
      onPart: (atlas) => store.edit({ atlas }),
      onWindows: (atlasWindows) => store.edit({ atlasWindows }),
      onClose: () => store.edit({ atlas: "" }),
      onGhost: (ghost) => this.#ghosts.show(ghost),
      onError: (error) => toasts.error((error as Error).message),
    });
    this.#atlasPane = pane;
    this.#transportElement.append(pane.element);
    pane.frame = playhead.at;
    return pane;
  }

  #showTrack(state: Readonly<AppState>): void {
    const neutral = this.#database?.neutral ?? "";
    const chosen = state.playing ? chosenKey(state) : keyUnder(state, this.#host.playhead.at);
    this.#trackKeys.show(state.track, chosen, (key) => manner(key.styles, state.intensity, neutral));
  }

  /** Plays while the view is shown and the playhead is not being dragged. */
  #play(): void {
    const { session, store, playhead } = this.#host;
    session.playback.playing = this.#shown && store.state.playing && !playhead.scrubbing;
  }

  // --- from the user ---

  #onScrub(frame: number | undefined): void {
    if (frame !== undefined) this.#moveTo(frame);
    else this.#show(this.#host.store.state, new Set());
  }

  #onEscape({ key, defaultPrevented }: KeyboardEvent): void {
    if (key !== "Escape" || defaultPrevented || !this.#shown || document.querySelector("dialog[open], :popover-open"))
      return;
    this.#file.close();
  }

  async #choose(name: string): Promise<void> {
    const choosing = isLive(name) ? this.#askForLive(name) : this.#host.chooseInput(name);
    if (!(await choosing)) this.#listInputs();
  }

  async #chooseClip(clip: number): Promise<void> {
    if (!(await this.#host.chooseClip(clip))) this.#listInputs();
  }

  #listInputs(): void {
    const { library, chosen, databaseSource } = this.#host.session;
    this.#file.show();
    this.#input.list(library, chosen, databaseSource?.kind === "strutdb" ? databaseSource.name : "");
  }
}
