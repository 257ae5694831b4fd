/** The Key-style view: a point that is dragged over a plane of style variables is a pose, and keys of it are a motion. */
import "../styles/key_style.css";
import "../styles/maker.css";
import type { DroppedFile } from "../../worker/build/protocol";
import type { Between, PuppetFrame } from "../../worker/key_style/key_style";
import { html, setAttributes } from "../dom";
import { saveBvh, saveGlb } from "../outputs/save_motion";
import type { PlayState } from "../state";
import { strings } from "../strings/strings";
import { onSystemTheme } from "../theme";
import type { View, ViewHost } from "../views";
import { errorText } from "../words";
import { Foot } from "./foot";
import { fitted, LENGTH_RANGE, MOST_KEYS, removeKey, setKey, type TimedValue, withValues } from "./keys";
import { anotherSet, type Learned, Learner, MODEL_FIELDS, otherAxes } from "./learner";
import { PadPanel } from "./pad_panel";
import type { Performance } from "./performance";
import { PicturePanel } from "./picture_panel";
import { Player } from "./player";
import { Recordings } from "./recordings";
import { parseSet } from "./sets";
import { Timeline } from "./timeline";
import { keysOf, lengthOf, Recorder } from "./trail";

export function createView(host: ViewHost): View {
  return new KeyStyle(host);
}

const words = strings.keyStyle;

/** Other settings of the model are learned when nothing has changed for so long. */
const LEARN_MS = 250;
/** Keys that a drag becomes are so far apart, seconds: ten frames of the training data. */
const TRAIL_KEYS_SECS = 1 / 3;

/** What the keys' motion depends on. */
const MOTION_FIELDS = ["keys", "keyChosen", "keyLength", "keyCurve", "keyHard", "loop"] as const;

class KeyStyle implements View {
  readonly element: HTMLElement;
  readonly #host: ViewHost;
  readonly #learner: Learner;
  readonly #picture: PicturePanel;
  readonly #pad: PadPanel;
  readonly #timeline: Timeline;
  readonly #recordings: Recordings;
  readonly #foot: Foot;
  readonly #recorder = new Recorder();
  #learned: Learned | undefined;
  #shown = false;
  #dirty = false;
  readonly #player: Player;
  #request = 0;
  #learning: ReturnType<typeof setTimeout> | undefined;
  #listening = new AbortController();

  constructor(host: ViewHost) {
    this.#host = host;
    const { store } = host;
    this.#learner = new Learner(
      host,
      (learned) => this.#present(learned),
      () => this.#showState(),
    );
    this.#pad = new PadPanel({
      onSet: (set) => store.edit({ ...anotherSet(set), playing: true }),
      onClips: (keyClips) => store.edit({ ...otherAxes(store.state.keyAxes), keyClips }),
      onAxes: (axes) => store.edit(otherAxes(axes)),
      handle: () => store.state.keyHandle,
      onGrab: () => this.#grab(),
      onMove: (values) => this.#moveTo(values),
      onDrop: () => this.#drop(),
      onChooseKey: (key) => this.#choose(key),
      onMoveKey: (key, x, y) => {
        const keys = this.#keys;
        const values = keys[key]?.values.with(0, x).with(1, y);
        if (values) store.edit({ keys: withValues(keys, key, values) }, `key-style pad ${key}`);
      },
      onSettle: () => store.endGesture(),
    });
    this.#timeline = new Timeline({
      keys: () => this.#keys,
      onChoose: (key) => this.#choose(key),
      onEdit: (keys, gesture, keyChosen) => store.edit({ keys, keyChosen }, gesture),
      onSettle: () => store.endGesture(),
      onSeek: (secs) => this.#player.seek(secs),
    });
    this.#recordings = new Recordings((frame) => this.#pick(frame));
    this.#picture = new PicturePanel(this.#learner, {
      onMethod: (keyMethod) => store.edit({ keyMethod }),
      onGhost: () => store.edit({ keyGhost: !store.state.keyGhost }),
      onComponents: (keyComponents) => store.edit({ keyComponents }, "key-style components"),
      onLearning: (keyLearning) => store.edit({ keyLearning }),
      onHard: (keyHard) => store.edit({ keyHard }),
      onCurve: (keyCurve) => store.edit({ keyCurve }),
      onSettle: () => store.endGesture(),
    });
    this.#foot = new Foot({
      onPlay: () => this.#player.togglePlay(),
      onPrevious: () => this.#goToKey(-1),
      onNext: () => this.#goToKey(1),
      onLoop: () => store.edit({ loop: !store.state.loop }),
      onLength: (keyLength) => store.edit({ keyLength, keys: fitted(store.state.keys, keyLength) }),
      onPane: (keyPane) => store.edit({ keyPane }),
      onReplay: () => this.#player.replay(),
      onTrailToKeys: () => this.#trailToKeys(),
      onAddKey: () => this.#addKey(),
      onRemoveKey: () => this.#removeKey(),
      onBvh: () => void this.#export(bvhOf),
      onGlb: () => void this.#export(glbOf),
    });
    this.#player = new Player(store, {
      prepare: () => this.#prepare(),
      onFrame: (frame, values, reached) => this.#showFrame(frame, values, reached),
      onTime: (secs, values) => this.#showTime(secs, values),
      onJump: () => this.#picture.jump(),
    });
    this.element = this.#layOut();
    store.subscribe((state, changed) => {
      if (this.#shown) this.#onChange(state, changed);
    });
  }

  #layOut(): HTMLElement {
    return html(
      "main",
      { class: "view key-style" },
      this.#pad.element,
      this.#picture.element,
      html("div", { class: "key-style-pane" }, this.#timeline.element, this.#recordings.element),
      this.#foot.element,
    );
  }

  get history() {
    return this.#host.store;
  }

  show(): void {
    this.#shown = true;
    this.#listening = new AbortController();
    const { signal } = this.#listening;
    const { state } = this.#host.store;
    addEventListener("keydown", (event) => this.#onKey(event), { signal });
    onSystemTheme(() => this.#showState(), signal);
    this.#picture.take((container) => this.#host.borrowPicture(container));
    if (this.#learned) this.#picture.present(this.#learned);
    // A link that was followed meanwhile leaves out what is as it comes.
    if (this.#acting && this.#learner.has(state)) this.#complete(this.#acting);
    this.#player.start(performance.now(), state.keyTime);
    this.#dirty = true;
    this.#adoptSet();
    this.#showState();
    void this.#learner.learn(this.#host.store.state);
    this.#request = requestAnimationFrame(this.#tick);
  }

  hide(): void {
    this.#shown = false;
    this.#listening.abort();
    this.#learner.progress.cancel();
    clearTimeout(this.#learning);
    cancelAnimationFrame(this.#request);
    this.#picture.give();
  }

  refresh(): void {
    if (!this.#shown) return;
    this.#showState();
    void this.#learner.learn(this.#host.store.state);
  }

  takeFiles(files: DroppedFile[]): void {
    this.#learner.files = files;
    const { store } = this.#host;
    store.edit({ ...anotherSet("files"), playing: true });
    void this.#learner.learn(store.state);
  }

  dispose(): void {
    this.hide();
    this.#picture.dispose();
    this.#learned?.performance.dispose();
  }

  // --- the model ---

  /** A link may ask for files or for a database that are not here. */
  #adoptSet(): void {
    const { store, notices } = this.#host;
    const { source, action } = parseSet(store.state.keySet);
    if (source === "files" && this.#learner.files.length === 0) {
      notices.note(words.filesMissing);
      store.adopt(anotherSet("walk"));
    } else if (source === "open" && !this.#host.databaseFile().file) store.adopt({ keySet: action || "walk" });
  }

  #present(learned: Learned): void {
    const { store } = this.#host;
    const former = this.#learned;
    this.#learned = learned;
    this.#player.acting = learned.performance;
    former?.performance.dispose();
    // Where the handle was means nothing to other variables.
    const others = former !== undefined && former.axes.join() !== learned.axes.join();
    const { model, rows, ranges } = learned.performance;
    const handled = this.#complete(learned.performance, others);
    this.#picture.present(learned);
    const { values, clips, rateHz } = model;
    this.#recordings.show({ rows, ranges, clips, values, rateHz });
    this.#pad.present(learned.performance);
    this.#dirty = true;
    // A link may have left the handle beside the way between keys.
    if (handled && !store.state.playing && !this.#onWay(store.state)) this.#player.grab();
    this.#showState();
  }

  /** Fills in what the state leaves to the model; whether it had a place for the handle, which is not `stale`. */
  #complete({ model, middle, firstKeys }: Performance, stale = false): boolean {
    const { store } = this.#host;
    const axes = model.axes.length;
    const fits = ({ values }: TimedValue) => values.length === axes;
    if (!store.state.keys.every(fits)) store.adopt({ keys: [], keyChosen: -1 });
    if (!store.state.keyTrail.every(fits)) store.adopt({ keyTrail: [] });
    const { keys, keyLength, keyHandle } = store.state;
    const handled = keyHandle.length === axes;
    if (keys.length === 0 && !handled) {
      const first = firstKeys();
      store.adopt({ keys: first, keyLength: keyLength || Math.max(LENGTH_RANGE.min, first.at(-1)!.secs) });
    } else if (keyLength === 0) store.adopt({ keyLength: Math.max(LENGTH_RANGE.min, keys.at(-1)?.secs ?? 0) });
    if (!handled || stale) store.adopt({ keyHandle: middle });
    return handled && !stale;
  }

  /** Whether the handle is where the keys' motion is at the playhead. */
  #onWay({ keyHandle, keyTime }: Readonly<PlayState>): boolean {
    this.#prepare();
    const { reached } = this.#acting!.at(keyTime, "style");
    return keyHandle.every((value, axis) => Math.abs(value - reached[axis]!) < 0.02);
  }

  get #acting(): Performance | undefined {
    return this.#learned?.performance;
  }

  // --- the hand ---

  #recording = false;

  get #handle(): readonly number[] {
    return this.#host.store.state.keyHandle;
  }

  #grab(): void {
    this.#recording = true;
    this.#player.grab();
    this.#recorder.begin();
  }

  /** Brings the handle somewhere. The pose is that of this very moment: it is on screen in the same frame. */
  #moveTo(values: readonly number[]): void {
    if (!this.#player.ready) return;
    const now = performance.now();
    this.#player.grab();
    if (this.#recording) this.#recorder.add(now / 1000, values);
    this.#player.follow(now, values);
    const moved = this.#recording ? { keyTrail: this.#recorder.trail } : {};
    this.#host.store.edit({ keyHandle: values, playing: false, ...moved });
  }

  #drop(): void {
    this.#recording = false;
    this.#host.store.endGesture();
  }

  /** Puts the handle on a recorded pose. */
  #pick(frame: number): void {
    const { values, axes } = this.#acting!.model;
    this.#recording = false;
    this.#moveTo(Array.from(values.subarray(frame * axes.length, (frame + 1) * axes.length)));
  }

  // --- keys ---

  /** The keys that can be edited: none while other variables are learned. */
  get #keys(): readonly TimedValue[] {
    return this.#player.ready ? this.#host.store.state.keys : [];
  }

  #choose(keyChosen: number): void {
    const key = this.#keys[keyChosen];
    if (!key) return;
    this.#host.store.edit({ keyChosen, playing: false });
    this.#player.seek(key.secs);
  }

  #goToKey(by: number): void {
    const keys = this.#keys;
    if (keys.length === 0) return;
    const after = keys.findIndex((key) => key.secs > this.#player.secs + 1e-3);
    const before = keys.findLastIndex((key) => key.secs < this.#player.secs - 1e-3);
    this.#choose(by > 0 ? (after < 0 ? 0 : after) : before < 0 ? keys.length - 1 : before);
  }

  #addKey(): void {
    const { store, notices } = this.#host;
    if (!this.#player.ready) return;
    const secs = Math.min(store.state.keyLength, Math.round(this.#player.secs * 100) / 100);
    const { keys, key } = setKey(store.state.keys, secs, this.#handle);
    if (key < 0) {
      notices.error(words.tooManyKeys(MOST_KEYS));
      return;
    }
    store.edit({ keys, keyChosen: key, playing: false });
    this.#player.seek(keys[key]!.secs);
  }

  #removeKey(): void {
    const { store } = this.#host;
    const { keys, keyChosen } = store.state;
    if (keyChosen < 0 || keyChosen >= keys.length) return;
    store.edit({ keys: removeKey(keys, keyChosen), keyChosen: Math.min(keyChosen, keys.length - 2) });
  }

  #trailToKeys(): void {
    const { store } = this.#host;
    const { keyTrail } = store.state;
    const keys = keysOf(keyTrail, TRAIL_KEYS_SECS, MOST_KEYS);
    store.edit({ keys, keyChosen: -1, keyLength: Math.max(0.5, lengthOf(keyTrail)), playing: true });
    this.#player.seek(0);
  }

  // --- time ---

  readonly #tick = (now: number): void => {
    this.#request = requestAnimationFrame(this.#tick);
    this.#player.tick(now);
    this.#picture.draw(now);
  };

  #showTime(secs: number, values: readonly number[]): void {
    this.#timeline.setPlayhead(secs, values);
    this.#pad.played = secs / this.#host.store.state.keyLength;
    this.#foot.secs = secs;
  }

  #showFrame(frame: PuppetFrame, values: readonly number[], reached: Float32Array | undefined): void {
    const acting = this.#acting!;
    this.#pad.showFrame(frame, values, reached, acting);
    const nearest = acting.model.nearest(values);
    this.#recordings.frame = nearest;
    this.#picture.showFrame(frame, values, nearest, acting, this.#player);
  }

  /** Lets the performance have the keys of the state. */
  #prepare(): void {
    const acting = this.#acting;
    const { state } = this.#host.store;
    if (!this.#dirty || !acting || state.keys.some(({ values }) => values.length !== acting.rows.length)) return;
    this.#dirty = false;
    const { keys, keyChosen, keyLength, keyCurve, keyHard, loop } = state;
    acting.set({ keys, length: keyLength, curve: keyCurve, loop, hard: keyHard });
    const { rows, ranges, way } = acting;
    this.#timeline.show({ rows, ranges, keys, chosen: keyChosen, length: keyLength, way });
    this.#pad.showKeys(keys, keyChosen, acting);
    this.#player.secs = Math.min(this.#player.secs, keyLength);
    this.#player.invalidate();
  }

  // --- the state ---

  #onChange(state: Readonly<PlayState>, changed: ReadonlySet<keyof PlayState>): void {
    if (MODEL_FIELDS.some((name) => changed.has(name))) {
      clearTimeout(this.#learning);
      this.#learning = setTimeout(() => void this.#learner.learn(this.#host.store.state), LEARN_MS);
    }
    // A link leaves out what is as it comes.
    const left = changed.has("keyHandle") && state.keyHandle.length === 0;
    if (left && this.#acting && this.#learner.has(state)) this.#complete(this.#acting);
    if (MOTION_FIELDS.some((name) => changed.has(name))) {
      this.#dirty = true;
      // What is done to keys is shown on the way between them.
      if (changed.has("keys") && !this.#recording) this.#player.letGo();
    }
    if (changed.has("keyTime") && !state.playing) this.#player.secs = state.keyTime;
    if (changed.has("keyTime") || changed.has("keyMethod") || changed.has("keyGhost")) this.#player.invalidate();
    this.#showState();
  }

  #showState(): void {
    const { store } = this.#host;
    const { state } = store;
    const { name, file } = this.#host.databaseFile();
    const open = file ? { name, actions: this.#host.session()?.database?.actions ?? [] } : undefined;
    const trained = this.#learned?.trained;
    const set = {
      set: state.keySet,
      open,
      files: this.#learner.files.length,
      clips: trained?.clips ?? [],
      learned: trained?.learned ?? [],
      chosen: state.keyClips.length > 0,
    };
    this.#pad.show(set, this.#learner.axesOf(state), state.keyTrail);
    const ready = this.#learned !== undefined && !this.#learner.refused;
    this.element.classList.toggle("without-model", !ready);
    setAttributes(this.element, { "aria-busy": String(this.#learner.learning(state)) });
    this.#foot.show(state, ready);
    this.element.dataset.pane = state.keyPane;
    this.#picture.show(state, ready ? this.#learned : undefined, this.#learner.refused);
  }

  #onKey(event: KeyboardEvent): void {
    if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey) return;
    const active = document.activeElement;
    if (document.querySelector("dialog[open]") || active?.matches("button, select, input, summary, canvas")) return;
    const { store } = this.#host;
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const act = {
      " ": () => this.#player.togglePlay(),
      ArrowLeft: () => this.#goToKey(-1),
      ArrowRight: () => this.#goToKey(1),
      Home: () => this.#player.seek(0),
      k: () => this.#addKey(),
      Delete: () => this.#removeKey(),
      l: () => store.edit({ loop: !store.state.loop }),
      r: () => this.#player.replay(),
      g: () => store.edit({ keyGhost: !store.state.keyGhost }),
    }[key];
    if (!act) return;
    event.preventDefault();
    act();
  }

  /** Saves a file of the keys' motion. */
  async #export(
    save: (acting: Performance, length: number, between: Between) => string | Promise<string>,
  ): Promise<void> {
    const acting = this.#acting;
    const { keyLength, keyMethod } = this.#host.store.state;
    if (!acting) return;
    try {
      const name = await save(acting, keyLength, keyMethod === "all" ? "style" : keyMethod);
      this.#host.notices.note(words.saved(name));
    } catch (error) {
      this.#host.notices.error(errorText(error));
    }
  }
}

const bvhOf = (acting: Performance, length: number, between: Between) =>
  saveBvh(words.fileName, acting.toBvh(length, between));
const glbOf = (acting: Performance, length: number, between: Between) =>
  saveGlb(words.fileName, acting.model, acting.perform(length, between));
