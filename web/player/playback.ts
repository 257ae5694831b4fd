/**
 * The loop that keeps the character moving: every animation frame it draws the newest frame and asks the engine for
 * the next, one request at a time. A change of style therefore acts with the next frame, also while paused.
 */

import type { LiveFrame, ShownFrame, StylizeOptions } from "../client/protocol";
import { isCancellation, WEIGHT_EPSILON } from "../client/protocol";
import { stepSecs } from "./clock";
import type { Prelude } from "./prelude";
import { approach, type Weights } from "./smoothing";

/** Marks on the browser's time line: when the first frame was drawn, and the first of the engine. */
export const MARKS = { shown: "strut: first frame", styled: "strut: first styled frame" } as const;

/** A first frame counts as seen after this time, though no picture was drawn, milliseconds. */
export const UNSEEN_MS = 3000;

/** Failures in a row after which playing stops. */
const MAX_FAILURES = 3;

/** What the loop asks of the engine. */
export interface PlaybackEngine {
  step(dtSecs: number): Promise<LiveFrame>;
  seek(inputFrame: number): Promise<LiveFrame>;
  configure(options: StylizeOptions): Promise<void>;
}

/** How the loop begins before the engine has an input. */
export interface Opening {
  prelude: Prelude;
  /** A new frame of the prelude. */
  onFrame(shown: ShownFrame): void;
  /** Has the engine go on from a frame, in the same place and at the same time. */
  continueFrom(shown: ShownFrame): Promise<unknown>;
}

export interface PlaybackListeners {
  /** A new frame came from the engine; `sought` where it does not follow the one before. */
  onFrame: (frame: LiveFrame, sought: boolean) => void;
  /** Before every repaint of the browser. */
  onTick: (now: number) => void;
  onError: (error: unknown, stopped: boolean) => void;
  /** The engine has the latest options, and the styles have been eased to them. */
  onSettled: () => void;
}

export class Playback {
  playing = false;
  speed = 1;
  readonly #client: PlaybackEngine;
  readonly #listeners: PlaybackListeners;
  #target: StylizeOptions | undefined;
  /**
   * Weights that the engine has now; they approach the target's with a half-life. While it plays, the engine eases them, and is told
   * of a change once. While it is paused, the engine applies weights at once, so the page sends every step.
   */
  #weights: Weights | undefined;
  /** The options that the engine is easing the styles to. */
  #told: StylizeOptions | undefined;
  #stale = false;
  #seek: number | undefined;
  #last = 0;
  #busy = false;
  #held = 0;
  #failures = 0;
  #request = 0;
  /** What is shown until the engine's first frame. */
  #opening: Opening | undefined;
  /** Whether the engine was told to go on from it. */
  #handedOver = false;
  readonly #marks = new Map<string, "to be drawn" | "drawn">();
  /** When the first frame of the prelude was given, milliseconds. */
  #firstAt: number | undefined;
  /** Time of the last repaint, milliseconds. */
  #ticked = 0;

  constructor(client: PlaybackEngine, listeners: PlaybackListeners) {
    this.#client = client;
    this.#listeners = listeners;
  }

  start(): void {
    if (this.#request !== 0) return;
    this.#last = performance.now();
    this.#ticked = this.#last;
    this.#request = requestAnimationFrame(this.#tick);
  }

  dispose(): void {
    cancelAnimationFrame(this.#request);
    this.#request = 0;
  }

  /** Whether the engine has the latest options; false while styles are eased to them. */
  get settled(): boolean {
    return !this.#stale;
  }

  /** Whether the pose on screen answers the latest request. While playing, a new request follows at once. */
  get upToDate(): boolean {
    return this.settled && !this.#busy && this.#seek === undefined;
  }

  /** Options from the next frame on. Styles are eased to them; all other options act at once. */
  set options(options: StylizeOptions) {
    this.#target = options;
    this.#told = undefined;
    this.#weights ??= options.styles;
    this.#stale = true;
  }

  /** Goes to an input frame; only the last request before a repaint counts. */
  seek(frame: number): void {
    this.#seek = frame;
  }

  /** Requests the current pose again, after something other than the options changed it. */
  refresh(): void {
    this.#told = undefined;
    this.#stale = true;
  }

  /** Forgets the current styles, which another database does not have: the next ones act without easing. */
  forgetStyle(): void {
    this.#weights = undefined;
  }

  /** Shows something until the engine has an input, which it goes on with from there, in the same place; starts the loop. */
  startWith(opening: Opening): void {
    this.#opening = opening;
    this.start();
  }

  /** Sends no requests while `task` runs, such as opening another database. */
  async hold<T>(task: () => Promise<T>): Promise<T> {
    this.#held += 1;
    try {
      return await task();
    } finally {
      this.#held -= 1;
      this.refresh();
      this.#last = performance.now();
    }
  }

  /** Advances by a fixed time step, independent of the clock; for use within {@link hold}. */
  async advance(secs: number): Promise<LiveFrame> {
    const frame = await this.#client.step(secs);
    this.#listeners.onFrame(frame, false);
    return frame;
  }

  /** The frames that were given are drawn: a first one is when it is seen, not when it was computed. */
  drawn(): void {
    for (const [name, state] of this.#marks) {
      if (state === "drawn") continue;
      this.#marks.set(name, "drawn");
      performance.mark(name);
    }
  }

  readonly #tick = (now: number): void => {
    this.#request = requestAnimationFrame(this.#tick);
    this.#listeners.onTick(now);
    if (this.#opening) this.#showPrelude(this.#opening, now);
    if (this.#busy || this.#held > 0 || !this.#target) return;
    if (this.#opening && !this.#handedOver) {
      this.#handOver(this.#opening, this.#target, now);
      return;
    }
    if (this.#opening && this.#isUnseen(now)) {
      this.#last = now;
      return;
    }
    const elapsed = Math.max(0, (now - this.#last) / 1000);
    // However long the engine takes to begin: the prelude goes on meanwhile.
    const dt = this.#opening ? elapsed : stepSecs(this.#last, now);
    this.#last = now;
    const restyled = this.#configure(this.#target, this.playing ? dt * this.speed : elapsed);
    const seek = this.#seek;
    if (seek === undefined && !this.playing && !restyled) return;
    this.#seek = undefined;
    this.#busy = true;
    const answer = seek === undefined ? this.#client.step(this.playing ? dt * this.speed : 0) : this.#client.seek(seek);
    answer
      .then((frame) => {
        this.#failures = 0;
        this.#opening = undefined;
        this.#mark(MARKS.shown);
        this.#mark(MARKS.styled);
        this.#listeners.onFrame(frame, seek !== undefined);
      })
      .catch((error: unknown) => this.#fail(error))
      .finally(() => {
        this.#busy = false;
      });
  };

  /** Notes what the next picture shows for the first time. */
  #mark(name: string): void {
    if (!this.#marks.has(name)) this.#marks.set(name, "to be drawn");
  }

  /**
   * Whether the first frame of the prelude is still to be drawn. Nothing goes on before: a clock and a time line that run
   * would take from the graphics processor the time that the first picture needs.
   */
  #isUnseen(now: number): boolean {
    return (
      this.#firstAt !== undefined && now - this.#firstAt < UNSEEN_MS && this.#marks.get(MARKS.shown) === "to be drawn"
    );
  }

  #showPrelude({ prelude, onFrame }: Opening, now: number): void {
    const dt = stepSecs(this.#ticked, now);
    this.#ticked = now;
    // The engine's first frame is of the moment at which it was asked for.
    if (!this.playing || (this.#handedOver && this.#busy)) return;
    if (this.#isUnseen(now)) return;
    if (this.#firstAt === undefined) this.#firstAt = now;
    else prelude.advance(dt * this.speed);
    this.#mark(MARKS.shown);
    onFrame(prelude.shown);
  }

  /** Has the engine go on from the prelude, in its styles at first; the prelude is shown until the next frame is there. */
  #handOver({ prelude, continueFrom }: Opening, target: StylizeOptions, now: number): void {
    this.#weights = prelude.styles;
    this.#send({ ...target, styles: approach(prelude.styles, target.styles, 0) });
    this.#last = now;
    this.#busy = true;
    continueFrom(prelude.shown)
      .catch((error: unknown) => this.#fail(error))
      .finally(() => {
        this.#busy = false;
        this.#handedOver = true;
      });
  }

  /** Tells the engine of changed options; whether there were any. The step that follows is answered after it. */
  #configure(target: StylizeOptions, dt: number): boolean {
    if (!this.#stale) return false;
    // The engine is a frame or two behind.
    const near = this.playing ? 0.5 * WEIGHT_EPSILON : undefined;
    const weights = approach(this.#weights ?? target.styles, target.styles, dt, near);
    this.#weights = weights;
    this.#stale = weights !== target.styles;
    if (!this.playing) this.#told = undefined;
    if (!this.#told) this.#send({ ...target, styles: { ...(this.playing ? target.styles : weights) } });
    if (this.playing) this.#told = target;
    if (!this.#stale) this.#listeners.onSettled();
    return true;
  }

  #send(options: StylizeOptions): void {
    this.#client.configure(options).catch((error: unknown) => this.#fail(error));
  }

  #fail(error: unknown): void {
    if (isCancellation(error)) return;
    this.#failures += 1;
    const stopped = this.#failures >= MAX_FAILURES;
    if (stopped) this.playing = false;
    this.#listeners.onError(error, stopped);
  }
}
