/** The Key-style view: a handle on a plane of style variables poses the character, and keys at its positions make a motion. */
import { MAX_KEYS } from "../../state/key_style";
import "./key_style.css";
import "../synthesis/editor.css";
import type { DroppedFile } from "../../../client/build/protocol";
import type { Between, KeyStyleFrame } from "../../../client/models/key_style";
import { html, setAttributes } from "../../../ui/dom";
import { onSystemTheme } from "../../../ui/theme";
import { AnimatedView } from "../../animated_view";
import { saveBvh, saveGlb } from "../../outputs/save_motion";
import type { AppState } from "../../state/state";
import { strings } from "../../strings/strings";
import type { KeyTable, View, ViewHost } from "../../view";
import { completed, hasHandle } from "./completion";
import { Footer } from "./footer";
import { KeyEditor } from "./key_editor";
import type { KeyMotion } from "./key_motion";
import { withValues } from "./keys";
import { anotherSet, MODEL_FIELDS, ModelTrainer, type OpenModel } from "./model_trainer";
import { PadPanel } from "./pad_panel";
import { PicturePanel } from "./picture_panel";
import { Player } from "./player";
import { Recordings } from "./recordings";
import { parseSet } from "./sets";
import { Timeline } from "./timeline";
import { Recorder } from "./trail";

export function createView(host: ViewHost): View {
  return new KeyStyleView(host);
}

const words = strings.keyStyle;

/** A model with other settings is trained once these have not changed for this time. */
const TRAIN_DELAY_MS = 250;

/** Fields on which the motion of the keys depends. */
const MOTION_FIELDS = ["keys", "keyChosen", "keyLength", "keyCurve", "keyHard", "loop"] as const;

class KeyStyleView extends AnimatedView {
  readonly element: HTMLElement;
  readonly #trainer: ModelTrainer;
  readonly #picture: PicturePanel;
  readonly #pad: PadPanel;
  readonly #timeline: Timeline;
  readonly #recordings: Recordings;
  readonly #footer: Footer;
  readonly #editor: KeyEditor;
  readonly #recorder = new Recorder();
  #open: OpenModel | undefined;
  #dirty = false;
  readonly #player: Player;
  #trainingTimer: ReturnType<typeof setTimeout> | undefined;

  constructor(host: ViewHost) {
    super(host);
    const { store } = host;
    this.#trainer = new ModelTrainer(
      host,
      (model) => this.#present(model),
      () => this.#showState(),
    );
    this.#pad = new PadPanel(store, {
      onGrab: () => this.#grab(),
      onMove: (values) => this.#moveTo(values),
      onDrop: () => this.#drop(),
      onChooseKey: (key) => this.#editor.choose(key),
      onMoveKey: (key, x, y) => {
        const { keys } = this.#editor;
        const values = keys[key]?.values.with(0, x).with(1, y);
        if (values) store.edit({ keys: withValues(keys, key, values) }, `key-style pad ${key}`);
      },
    });
    this.#player = new Player(store, {
      prepare: () => this.#prepare(),
      onFrame: (frame, values, reached) => this.#showFrame(frame, values, reached),
      onTime: (secs, values) => this.#showTime(secs, values),
      onJump: () => this.#picture.jump(),
    });
    this.#editor = new KeyEditor(store, this.#player, () => host.toasts.error(words.tooManyKeys(MAX_KEYS)));
    this.#timeline = new Timeline(store, this.#editor, (secs) => this.#player.seek(secs));
    this.#recordings = new Recordings((frame) => this.#pick(frame));
    this.#picture = new PicturePanel(this.#trainer, store);
    this.#footer = new Footer(store, {
      onPlay: () => this.#player.togglePlay(),
      onPrevious: () => this.#editor.chooseNext(-1),
      onNext: () => this.#editor.chooseNext(1),
      onReplay: () => this.#player.replay(),
      onTrailToKeys: () => this.#editor.takeTrail(),
      onAddKey: () => this.#editor.add(),
      onRemoveKey: () => this.#editor.remove(),
      onBvh: () => void this.#export(bvhOf),
      onGlb: () => void this.#export(glbOf),
    });
    this.element = html(
      "main",
      { class: "view key-style" },
      this.#pad.element,
      this.#picture.element,
      html("div", { class: "key-style-pane" }, this.#timeline.element, this.#recordings.element),
      this.#footer.element,
    );
  }

  protected appear(signal: AbortSignal): void {
    const { store } = this.host;
    const { state } = store;
    store.subscribe((state, changed) => this.#onChange(state, changed), signal);
    for (const part of [this.#pad, this.#timeline, this.#recordings]) part.attach(signal);
    onSystemTheme(() => this.#showState(), signal);
    this.#picture.take((container) => this.host.borrowViewer(container));
    if (this.#open) this.#picture.present(this.#open);
    // A link followed meanwhile omits defaults.
    if (this.#motion && this.#trainer.has(state)) store.adopt(completed(state, this.#motion));
    this.#player.start(performance.now(), state.keyTime);
    this.#dirty = true;
    this.#adoptSet();
    this.#showState();
    this.#trainer.request(this.host.store.state);
  }

  protected disappear(): void {
    this.#trainer.cancel();
    clearTimeout(this.#trainingTimer);
    this.#picture.give();
  }

  refresh(): void {
    if (!this.isShown) return;
    this.#adoptSet();
    this.#showState();
    this.#trainer.request(this.host.store.state);
  }

  takeFiles(files: DroppedFile[]): void {
    this.#trainer.files = files;
    this.host.workChanged();
    const { store } = this.host;
    store.edit({ ...anotherSet("files"), playing: true });
    this.#trainer.request(store.state);
  }

  /** Dropped files exist only here. */
  get holdsWork(): boolean {
    return this.#trainer.files.length > 0;
  }

  get holdsUnkept(): boolean {
    return this.holdsWork;
  }

  override dispose(): void {
    super.dispose();
    this.#trainer.dispose();
  }

  // --- the model ---

  /** A link may name files or a database that do not exist here. */
  #adoptSet(): void {
    const { store, toasts } = this.host;
    const { source, action } = parseSet(store.state.keySet);
    if (source === "files" && this.#trainer.files.length === 0) {
      toasts.note(words.filesMissing);
      store.adopt(anotherSet("walk"));
    } else if (source === "open" && this.host.session.database && !this.host.databaseFile().file)
      store.adopt({ keySet: action || "walk" });
  }

  #present(open: OpenModel): void {
    const { store } = this.host;
    const former = this.#open;
    this.#open = open;
    this.#player.motion = open.motion;
    // The handle's position has no meaning for other variables.
    const others = former !== undefined && former.axes.join() !== open.axes.join();
    const { model, rows, ranges } = open.motion;
    const handled = hasHandle(store.state, open.motion) && !others;
    store.adopt(completed(store.state, open.motion, others));
    this.#picture.present(open);
    const { values, clips, rateHz } = model;
    this.#recordings.show({ rows, ranges, clips, values, rateHz });
    this.#pad.present(open.motion);
    this.#dirty = true;
    // A link may have placed the handle off the curve of the keys.
    if (handled && !store.state.playing && !this.#isOnCurve(store.state)) this.#player.grab();
    this.#showState();
  }

  /** Whether the handle is on the curve of the keys, at the playhead. */
  #isOnCurve({ keyHandle, keyTime }: Readonly<AppState>): boolean {
    this.#prepare();
    const { reached } = this.#motion!.at(keyTime, "style");
    return keyHandle.every((value, axis) => Math.abs(value - reached[axis]!) < 0.02);
  }

  get #motion(): KeyMotion | undefined {
    return this.#open?.motion;
  }

  // --- the handle ---

  #recording = false;

  #grab(): void {
    this.#recording = true;
    this.#player.grab();
    this.#recorder.begin();
  }

  /** Moves the handle. The pose follows at once, in the same display frame. */
  #moveTo(values: readonly number[]): void {
    if (!this.#player.ready) return;
    const now = performance.now();
    this.#player.grab();
    if (this.#recording) this.#recorder.add(now / 1000, values);
    this.#player.follow(now, values);
    const moved = this.#recording ? { keyTrail: this.#recorder.trail } : {};
    this.host.store.edit({ keyHandle: values, playing: false, ...moved });
  }

  #drop(): void {
    this.#recording = false;
    this.host.store.endGesture();
  }

  /** Moves the handle to a recorded pose. */
  #pick(frame: number): void {
    const { values, axes } = this.#motion!.model;
    this.#recording = false;
    this.#moveTo(Array.from(values.subarray(frame * axes.length, (frame + 1) * axes.length)));
  }

  // --- time ---

  protected tick(now: number): void {
    this.#player.tick(now);
    this.#picture.draw(now);
  }

  #showTime(secs: number, values: readonly number[]): void {
    this.#timeline.setPlayhead(secs, values);
    this.#pad.played = secs / this.host.store.state.keyLength;
    this.#footer.secs = secs;
  }

  #showFrame(frame: KeyStyleFrame, values: readonly number[], reached: Float32Array | undefined): void {
    const motion = this.#motion!;
    this.#pad.showFrame(frame, values, reached, motion);
    const nearest = motion.model.nearest(values);
    this.#recordings.frame = nearest;
    this.#picture.showFrame(frame, values, nearest, motion, this.#player);
  }

  /** Sets the keys of the state on the motion, if they have changed. */
  #prepare(): void {
    const motion = this.#motion;
    const { state } = this.host.store;
    if (!this.#dirty || !motion || state.keys.some(({ values }) => values.length !== motion.rows.length)) return;
    this.#dirty = false;
    const { keys, keyChosen, keyLength, keyCurve, keyHard, loop } = state;
    motion.set({ keys, length: keyLength, curve: keyCurve, loop, hard: keyHard });
    const { rows, ranges, curve } = motion;
    this.#timeline.show({ rows, ranges, keys, chosen: keyChosen, length: keyLength, curve });
    this.#pad.showKeys(keys, keyChosen, motion);
    this.#player.secs = Math.min(this.#player.secs, keyLength);
    this.#player.invalidate();
  }

  // --- the state ---

  #onChange(state: Readonly<AppState>, changed: ReadonlySet<keyof AppState>): void {
    if (MODEL_FIELDS.some((name) => changed.has(name))) {
      clearTimeout(this.#trainingTimer);
      this.#trainingTimer = setTimeout(() => this.#trainer.request(this.host.store.state), TRAIN_DELAY_MS);
    }
    // A link omits defaults.
    const left = changed.has("keyHandle") && state.keyHandle.length === 0;
    if (left && this.#motion && this.#trainer.has(state)) this.host.store.adopt(completed(state, this.#motion));
    if (MOTION_FIELDS.some((name) => changed.has(name))) {
      this.#dirty = true;
      // An edit of the keys is shown on their curve.
      if (changed.has("keys") && !this.#recording) this.#player.letGo();
    }
    if (changed.has("keyTime") && !state.playing) this.#player.secs = state.keyTime;
    if (changed.has("keyTime") || changed.has("keyMethod") || changed.has("keyGhost")) this.#player.invalidate();
    this.#showState();
  }

  #showState(): void {
    const { store } = this.host;
    const { state } = store;
    const { name, file } = this.host.databaseFile();
    const open = file ? { name, actions: this.host.session.database?.actions ?? [] } : undefined;
    const trained = this.#open?.trained;
    const set = {
      set: state.keySet,
      open,
      files: this.#trainer.files.length,
      clips: trained?.clips ?? [],
      trainedOn: trained?.trainedOn ?? [],
      chosen: state.keyClips.length > 0,
    };
    this.#pad.show(set, this.#trainer.axesOf(state), state.keyTrail);
    const ready = this.#open !== undefined && !this.#trainer.refused;
    this.element.classList.toggle("without-model", !ready);
    setAttributes(this.element, { "aria-busy": String(this.#trainer.isTraining(state)) });
    this.#footer.show(state, ready);
    this.element.dataset.pane = state.keyPane;
    this.#picture.show(state, ready ? this.#open : undefined, this.#trainer.refused);
  }

  readonly keys: KeyTable = {
    " ": () => this.#player.togglePlay(),
    ArrowLeft: () => this.#editor.chooseNext(-1),
    ArrowRight: () => this.#editor.chooseNext(1),
    Home: () => this.#player.seek(0),
    k: () => this.#editor.add(),
    Delete: () => this.#editor.remove(),
    l: () => this.host.store.edit({ loop: !this.host.store.state.loop }),
    r: () => this.#player.replay(),
    g: () => this.host.store.edit({ keyGhost: !this.host.store.state.keyGhost }),
  };

  /** Saves a file of the keys' motion. */
  async #export(
    save: (motion: KeyMotion, length: number, between: Between) => string | Promise<string>,
  ): Promise<void> {
    const motion = this.#motion;
    const { keyLength, keyMethod } = this.host.store.state;
    if (!motion) return;
    // Changes since the last display frame are saved as well.
    this.#prepare();
    try {
      const name = await save(motion, keyLength, keyMethod === "all" ? "style" : keyMethod);
      this.host.toasts.note(strings.synthesis.saved(name));
    } catch (error) {
      this.host.toasts.failure(error);
    }
  }
}

const bvhOf = (motion: KeyMotion, length: number, between: Between) =>
  saveBvh(words.fileName, motion.toBvh(length, between));
const glbOf = (motion: KeyMotion, length: number, between: Between) =>
  saveGlb(words.fileName, motion.model, motion.perform(length, between));
