/** What moves the body: a hand that drags the variables, keys that are played, or a drag that is played again. */
import type { Between, PuppetFrame } from "../../worker/key_style/key_style";
import type { PlayState } from "../state";
import type { Store } from "../store";
import type { Performance } from "./performance";
import { lengthOf, valuesAt } from "./trail";

/** Longest step of the clock: a hidden tab does not catch up. */
const LONGEST_STEP_SECS = 0.1;
/** The handle stays where a replayed drag has ended for so long, seconds: the body swings in. */
const REPLAY_REST_SECS = 0.5;

export interface PlayerListeners {
  /** The performance must have the keys of the state now. */
  prepare: () => void;
  /** A pose, the variables that it was made of, and where the model had to stay if it may not be there. */
  onFrame: (frame: PuppetFrame, values: readonly number[], reached: Float32Array | undefined) => void;
  /** The keys' motion is at a time. */
  onTime: (secs: number, values: readonly number[]) => void;
  /** The body is put elsewhere on the floor. */
  onJump: () => void;
}

export class Player {
  readonly #store: Store;
  readonly #listeners: PlayerListeners;
  /** Whether the handle is where a hand has put it, and not on the way between keys. */
  free = false;
  /** The playhead, seconds: the state has it only while nothing plays. */
  secs = 0;
  #acting: Performance | undefined;
  /** Whether what stands still has to be shown once more. */
  #moved = true;
  /** When the drag that is replayed began, milliseconds. */
  #replayed: number | undefined;
  #last = 0;

  constructor(store: Store, listeners: PlayerListeners) {
    this.#store = store;
    this.#listeners = listeners;
  }

  /** Takes another model. */
  set acting(acting: Performance | undefined) {
    this.#acting = acting;
    this.#replayed = undefined;
    this.#moved = true;
  }

  /**
   * Whether the model at work is of the variables that the state has: while another one is learned, the former is shown and
   * nothing can be moved.
   */
  get ready(): boolean {
    const { keyHandle, keys } = this.#store.state;
    const axes = this.#acting?.rows.length;
    return keyHandle.length === axes && keys.every(({ values }) => values.length === axes);
  }

  /** Begins to count time. */
  start(now: number, secs: number): void {
    this.#last = now;
    this.secs = secs;
    this.#moved = true;
  }

  /** Asks for what stands still to be shown once more. */
  invalidate(): void {
    this.#moved = true;
  }

  /** Goes on to a frame of the screen. */
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

  /** Lets the body follow the hand up to now. */
  follow(now: number, values: readonly number[]): void {
    const frame = this.#acting!.follow(values, this.#stepOf(now));
    this.#last = now;
    this.#listeners.onFrame(frame, values, frame.reached);
  }

  /** A hand takes the handle: the body begins to follow it from where it is. */
  grab(): void {
    this.#replayed = undefined;
    if (this.free || !this.#acting || !this.ready) return;
    if (this.#store.state.playing) this.#store.edit({ playing: false, keyTime: Math.round(this.secs * 100) / 100 });
    this.free = true;
    this.#acting.follow(this.#valuesAt(this.secs), undefined);
    this.#listeners.onJump();
  }

  /** The pose of the keys' motion made another way; none while a hand has the handle. */
  poseOf(between: Between): Float32Array | undefined {
    return this.free ? undefined : this.#acting?.at(this.secs, between).pose;
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
    this.#acting?.goBack();
    this.#listeners.onJump();
    if (!this.#store.state.playing) this.#store.edit({ keyTime: secs, keyHandle: this.#valuesAt(secs) });
  }

  togglePlay(): void {
    const { playing, loop, keyLength, keys } = this.#store.state;
    if (!this.#acting || keys.length === 0) return;
    this.#replayed = undefined;
    if (playing) {
      this.#store.edit({ playing: false });
      this.seek(Math.round(this.secs * 100) / 100);
      return;
    }
    if (!loop && this.secs >= keyLength) this.secs = 0;
    this.#store.edit({ playing: true });
  }

  /** The keys move the body again. */
  letGo(): void {
    if (!this.free) return;
    this.free = false;
    this.#acting?.goBack();
    this.#listeners.onJump();
  }

  /** The variables of the keys' motion at a time. */
  #valuesAt(secs: number): readonly number[] {
    const { keys, keyHandle } = this.#store.state;
    if (!this.#acting || keys.length === 0 || !this.ready) return keyHandle;
    this.#listeners.prepare();
    return Array.from(this.#acting.at(secs, "style").reached);
  }

  #stepOf(now: number): number {
    return Math.max(0, Math.min((now - this.#last) / 1000, LONGEST_STEP_SECS));
  }

  #playOn(now: number, { speed, loop, keyLength }: Readonly<PlayState>): void {
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
    const acting = this.#acting!;
    this.#moved = false;
    if (keys.length === 0) {
      this.#listeners.onFrame(acting.follow(keyHandle, undefined), keyHandle, undefined);
      return;
    }
    const frame = acting.at(secs, keyMethod === "all" ? "style" : keyMethod);
    const values = Array.from(frame.reached);
    this.#listeners.onTime(secs, values);
    this.#listeners.onFrame(frame, values, undefined);
  }
}
