/** Poses the body over time: by the handle while it is dragged, by the keys, or by a recorded drag. */
import type { Between, KeyStyleFrame } from "../../../client/models/key_style";
import { stepSecs } from "../../../player/clock";
import type { AppState } from "../../state/state";
import type { Store } from "../../state/store";
import type { KeyMotion } from "./key_motion";
import { lengthOf, valuesAt } from "./trail";

/** Time for which a replayed drag stays at its end, seconds: the body comes to rest. */
const REPLAY_REST_SECS = 0.5;

export interface PlayerListeners {
  /** Called before the motion is used, which must then have the keys of the state. */
  prepare: () => void;
  /** Called with a pose, its variables, and the values to which the model clamped them outside its data. */
  onFrame: (frame: KeyStyleFrame, values: readonly number[], reached: Float32Array | undefined) => void;
  /** Called when the keys' motion is at a time. */
  onTime: (secs: number, values: readonly number[]) => void;
  /** Called when the body was moved on the ground. */
  onJump: () => void;
}

export class Player {
  readonly #store: Store;
  readonly #listeners: PlayerListeners;
  /** Whether the handle was dragged and is no longer on the curve of the keys. */
  free = false;
  /** The playhead, seconds; the state has it only while paused. */
  secs = 0;
  #motion: KeyMotion | undefined;
  /** Whether a paused body must be redrawn. */
  #moved = true;
  /** When the replayed drag began, milliseconds. */
  #replayed: number | undefined;
  #last = 0;

  constructor(store: Store, listeners: PlayerListeners) {
    this.#store = store;
    this.#listeners = listeners;
  }

  /** Sets another model. */
  set motion(motion: KeyMotion | undefined) {
    this.#motion = motion;
    this.#replayed = undefined;
    this.#moved = true;
  }

  /**
   * Whether the model has the variables of the state. While a model with others is trained, the former one is shown and
   * nothing can be moved.
   */
  get ready(): boolean {
    const { keyHandle, keys } = this.#store.state;
    const axes = this.#motion?.rows.length;
    return keyHandle.length === axes && keys.every(({ values }) => values.length === axes);
  }

  /** Starts the clock. */
  start(now: number, secs: number): void {
    this.#last = now;
    this.secs = secs;
    this.#moved = true;
  }

  /** Requests a redraw while paused. */
  invalidate(): void {
    this.#moved = true;
  }

  /** Advances to a display frame. */
  tick(now: number): void {
    const { state } = this.#store;
    if (this.ready) {
      this.#listeners.prepare();
      if (this.#replayed !== undefined) this.#replayAt((now - this.#replayed) / 1000, now);
      else if (state.playing && state.keys.length > 0) this.#playOn(now, state);
      else if (this.free) this.follow(now, state.keyHandle);
      else if (this.#moved) this.#showAt(this.secs);
    }
    this.#last = now;
  }

  /** Makes the body follow the handle up to now. */
  follow(now: number, values: readonly number[]): void {
    const frame = this.#motion!.follow(values, this.#stepOf(now));
    this.#last = now;
    this.#listeners.onFrame(frame, values, frame.reached);
  }

  /** Starts a drag of the handle: the body follows it from its current pose. */
  grab(): void {
    this.#replayed = undefined;
    if (this.free || !this.#motion || !this.ready) return;
    if (this.#store.state.playing) this.#store.edit({ playing: false, keyTime: Math.round(this.secs * 100) / 100 });
    this.free = true;
    this.#motion.follow(this.#valuesAt(this.secs), undefined);
    this.#listeners.onJump();
  }

  /** The pose of the keys by a method; `undefined` while the body follows the handle. */
  poseOf(between: Between): Float32Array | undefined {
    return this.free ? undefined : this.#motion?.at(this.secs, between).pose;
  }

  /** Plays the last drag again. */
  replay(): void {
    if (this.#store.state.keyTrail.length < 2 || !this.ready) return;
    this.grab();
    this.#replayed = performance.now();
    this.#store.edit({ playing: false });
  }

  seek(secs: number): void {
    this.letGo();
    this.#replayed = undefined;
    this.secs = secs;
    this.#moved = true;
    this.#motion?.goBack();
    this.#listeners.onJump();
    if (!this.#store.state.playing) this.#store.edit({ keyTime: secs, keyHandle: this.#valuesAt(secs) });
  }

  togglePlay(): void {
    const { playing, loop, keyLength, keys } = this.#store.state;
    if (!this.#motion || keys.length === 0) return;
    this.#replayed = undefined;
    if (playing) {
      this.#store.edit({ playing: false });
      this.seek(Math.round(this.secs * 100) / 100);
      return;
    }
    if (!loop && this.secs >= keyLength) this.secs = 0;
    this.#store.edit({ playing: true });
  }

  /** The keys control the body again. */
  letGo(): void {
    if (!this.free) return;
    this.free = false;
    this.#motion?.goBack();
    this.#listeners.onJump();
  }

  /** The variables of the keys' motion at a time. */
  #valuesAt(secs: number): readonly number[] {
    const { keys, keyHandle } = this.#store.state;
    if (!this.#motion || keys.length === 0 || !this.ready) return keyHandle;
    this.#listeners.prepare();
    return Array.from(this.#motion.at(secs, "style").reached);
  }

  #stepOf(now: number): number {
    return stepSecs(this.#last, now);
  }

  #playOn(now: number, { speed, loop, keyLength }: Readonly<AppState>): void {
    this.letGo();
    this.secs += this.#stepOf(now) * speed;
    if (this.secs >= keyLength) {
      if (loop) this.secs %= keyLength;
      else {
        this.secs = keyLength;
        this.#store.edit({ playing: false, keyTime: keyLength });
      }
    }
    this.#showAt(this.secs);
  }

  #replayAt(secs: number, now: number): void {
    const { keyTrail } = this.#store.state;
    const length = lengthOf(keyTrail);
    if (keyTrail.length === 0 || secs > length + REPLAY_REST_SECS) {
      this.#replayed = undefined;
      return;
    }
    const values = valuesAt(keyTrail, secs);
    this.follow(now, values);
    if (secs >= length) this.#store.edit({ keyHandle: values });
  }

  /** Shows the keys' motion at a time. */
  #showAt(secs: number): void {
    const { keys, keyHandle, keyMethod } = this.#store.state;
    const motion = this.#motion!;
    this.#moved = false;
    if (keys.length === 0) {
      this.#listeners.onFrame(motion.follow(keyHandle, undefined), keyHandle, undefined);
      return;
    }
    const frame = motion.at(secs, keyMethod === "all" ? "style" : keyMethod);
    const values = Array.from(frame.reached);
    this.#listeners.onTime(secs, values);
    this.#listeners.onFrame(frame, values, undefined);
  }
}
