/**
 * The loop that keeps the character moving: every animation frame it draws the newest frame and asks the engine for
 * the next, one question at a time. A change of style therefore acts with the next frame, also while paused.
 */
import type { LiveFrame, StrutClient, StylizeOptions } from "../worker/protocol";
import { approach, type Weights } from "./smoothing";
import { isCancellation } from "./words";

/** Longest time that one frame may advance: after a stall or a hidden tab the motion goes on, it does not leap. */
const LONGEST_STEP_SECS = 0.1;
/** Failures in a row after which playing stops. */
const MOST_FAILURES = 3;

export interface PlaybackListeners {
  /** A new frame came from the engine; `sought` where it does not follow the one before. */
  onFrame: (frame: LiveFrame, sought: boolean) => void;
  /** Before every repaint of the browser. */
  onTick: (now: number) => void;
  onError: (error: unknown, stopped: boolean) => void;
  /** The engine has the options that were set last, all the way. */
  onSettled: () => void;
}

export class Playback {
  playing = false;
  speed = 1;
  readonly #client: StrutClient;
  readonly #listeners: PlaybackListeners;
  #target: StylizeOptions | undefined;
  /** Weights that the engine has now; they follow the target's with a half-life. */
  #weights: Weights | undefined;
  #stale = false;
  #seek: number | undefined;
  #last = 0;
  #busy = false;
  #held = 0;
  #failures = 0;
  #request = 0;

  constructor(client: StrutClient, listeners: PlaybackListeners) {
    this.#client = client;
    this.#listeners = listeners;
  }

  start(): void {
    this.#last = performance.now();
    this.#request = requestAnimationFrame(this.#tick);
  }

  dispose(): void {
    cancelAnimationFrame(this.#request);
  }

  /** Whether the engine has the options that were set last; false while the style is on its way. */
  get settled(): boolean {
    return !this.#stale;
  }

  /** Whether the pose on screen is the one that was asked for last; while playing the next one always is. */
  get upToDate(): boolean {
    return this.settled && !this.#busy && this.#seek === undefined;
  }

  /** What the engine shall do from the next frame on. The styles get there smoothly, everything else at once. */
  set options(options: StylizeOptions) {
    this.#target = options;
    this.#weights ??= options.styles;
    this.#stale = true;
  }

  /** Goes to an input frame; of several before the next repaint the last counts. */
  seek(frame: number): void {
    this.#seek = frame;
  }

  /** Asks for the present pose again, after something else than the options changed it. */
  refresh(): void {
    this.#stale = true;
  }

  /** Forgets the style that the engine has now, which another database knows nothing of: the next one is there at once. */
  forgetStyle(): void {
    this.#weights = undefined;
  }

  /** Keeps the engine free of questions while `task` runs, such as opening another database. */
  async hold<T>(task: () => Promise<T>): Promise<T> {
    this.#held += 1;
    try {
      return await task();
    } finally {
      this.#held -= 1;
      this.#stale = true;
      this.#last = performance.now();
    }
  }

  /** Advances by a fixed time, whatever the clock says; while {@link hold} keeps the loop from asking. */
  async advance(secs: number): Promise<LiveFrame> {
    const frame = await this.#client.step(secs);
    this.#listeners.onFrame(frame, false);
    return frame;
  }

  readonly #tick = (now: number): void => {
    this.#request = requestAnimationFrame(this.#tick);
    this.#listeners.onTick(now);
    if (this.#busy || this.#held > 0 || !this.#target) return;
    const elapsed = Math.max(0, (now - this.#last) / 1000);
    const dt = Math.min(elapsed, LONGEST_STEP_SECS);
    this.#last = now;
    const restyled = this.#configure(this.#target, elapsed);
    const seek = this.#seek;
    if (seek === undefined && !this.playing && !restyled) return;
    this.#seek = undefined;
    this.#busy = true;
    const answer = seek === undefined ? this.#client.step(this.playing ? dt * this.speed : 0) : this.#client.seek(seek);
    answer
      .then((frame) => {
        this.#failures = 0;
        this.#listeners.onFrame(frame, seek !== undefined);
      })
      .catch((error: unknown) => this.#fail(error))
      .finally(() => {
        this.#busy = false;
      });
  };

  /** Tells the engine of changed options; whether there were any. The step that follows is answered after it. */
  #configure(target: StylizeOptions, dt: number): boolean {
    if (!this.#stale) return false;
    const weights = approach(this.#weights ?? target.styles, target.styles, dt);
    this.#weights = weights;
    this.#stale = weights !== target.styles;
    this.#client.configure({ ...target, styles: { ...weights } }).catch((error: unknown) => this.#fail(error));
    if (!this.#stale) this.#listeners.onSettled();
    return true;
  }

  #fail(error: unknown): void {
    if (isCancellation(error)) return;
    this.#failures += 1;
    const stopped = this.#failures >= MOST_FAILURES;
    if (stopped) this.playing = false;
    this.#listeners.onError(error, stopped);
  }
}
