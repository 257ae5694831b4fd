/**
 * The loop that keeps the character moving: every animation frame it draws the newest frame and requests the next one
 * from the engine, one request at a time. A change of style therefore acts on the next frame, also while paused.
 */

import type { LiveFrame, ShownFrame, StylizeOptions } from "../client/protocol";
import { isCancellation, WEIGHT_EPSILON } from "../client/protocol";
import { stepSecs } from "./clock";
import type { Prelude } from "./prelude";
import { approach, type Weights } from "./smoothing";

/** Marks on the browser's performance timeline: when the first frame was drawn, and the first one from the engine. */
export const MARKS = { shown: "strut: first frame", styled: "strut: first styled frame" } as const;

/** After this time a first frame counts as seen, even if nothing was drawn, milliseconds. */
export const UNSEEN_MS = 3000;

/** Consecutive failures after which playback stops. */
const MAX_FAILURES = 3;

/** The engine's interface for the loop. */
export interface PlaybackEngine {
  step(dtSecs: number): Promise<LiveFrame>;
  seek(inputFrame: number): Promise<LiveFrame>;
  configure(options: StylizeOptions): Promise<void>;
}

/** The prelude that plays before the engine has an input. */
export interface Opening {
  prelude: Prelude;
  /** A new frame of the prelude. */
  onFrame(shown: ShownFrame): void;
  /** Makes the engine continue from a frame, at the same position and time. */
  continueFrom(shown: ShownFrame): Promise<unknown>;
}

interface PlaybackListeners {
  /** A new frame arrived from the engine; `sought` if it does not follow the previous one. */
  onFrame: (frame: LiveFrame, sought: boolean) => void;
  /** Called before every repaint of the browser. */
  onTick: (now: number) => void;
  onError: (error: unknown, stopped: boolean) => void;
  /** The engine has the latest options, and the easing of the styles has ended. */
  onSettled: () => void;
}

export class Playback {
  playing = false;
  speed = 1;
  readonly #client: PlaybackEngine;
  readonly #listeners: PlaybackListeners;
  #target: StylizeOptions | undefined;
  /**
   * The engine's current weights, which approach the target's with a half-life. While it plays, the engine eases them,
   * and a change is sent once. While paused, the engine applies weights at once, so the page sends every step.
   */
  #weights: Weights | undefined;
  /** The options to which the engine is easing the styles. */
  #told: StylizeOptions | undefined;
  #stale = false;
  #seek: number | undefined;
  #last = 0;
  #busy = false;
  #held = 0;
  #failures = 0;
  #request = 0;
  /** The prelude, which is shown until the engine's first frame. */
  #opening: Opening | undefined;
  /** Whether the engine was asked to continue from it. */
  #handedOver = false;
  readonly #marks = new Map<string, "to be drawn" | "drawn">();
  /** Time of the first frame of the prelude, milliseconds. */
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

  /** Whether the displayed pose answers the latest request. While playing, a new request follows at once. */
  get upToDate(): boolean {
    return this.settled && !this.#busy && this.#seek === undefined;
  }

  /** Options from the next frame on. Styles are eased; all other options act at once. */
  set options(options: StylizeOptions) {
    this.#target = options;
    this.#told = undefined;
    this.#weights ??= options.styles;
    this.#stale = true;
  }

  /** Jumps to an input frame; only the last request before a repaint counts. */
  seek(frame: number): void {
    this.#seek = frame;
  }

  /** Requests the current pose again, after something other than the options changed it. */
  refresh(): void {
    this.#told = undefined;
    this.#stale = true;
  }

  /** Forgets the current styles, which another database does not have. The next ones act without easing. */
  forgetStyle(): void {
    this.#weights = undefined;
  }

  /** Shows a prelude until the engine has an input, which continues from there, at the same position. Starts the loop. */
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

  /** Advances by a fixed time step, independent of the clock; to be used within {@link hold}. */
  async advance(secs: number): Promise<LiveFrame> {
    const frame = await this.#client.step(secs);
    this.#listeners.onFrame(frame, false);
    return frame;
  }

  /** Called when the displayed frames are drawn. The first frame counts from when it is seen, not from when it was computed. */
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
    // The prelude continues however long the engine takes to start.
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

  /** Records that the next image shows something for the first time. */
  #mark(name: string): void {
    if (!this.#marks.has(name)) this.#marks.set(name, "to be drawn");
  }

  /**
   * Whether the first frame of the prelude has not been drawn yet. The clock does not start before: a running clock and
   * timeline would take GPU time away from the first image.
   */
  #isUnseen(now: number): boolean {
    return (
      this.#firstAt !== undefined && now - this.#firstAt < UNSEEN_MS && this.#marks.get(MARKS.shown) === "to be drawn"
    );
  }

  #showPrelude({ prelude, onFrame }: Opening, now: number): void {
    const dt = stepSecs(this.#ticked, now);
    this.#ticked = now;
    // The engine's first frame shows the moment at which it was requested.
    if (!this.playing || (this.#handedOver && this.#busy)) return;
    if (this.#isUnseen(now)) return;
    if (this.#firstAt === undefined) this.#firstAt = now;
    else prelude.advance(dt * this.speed);
    this.#mark(MARKS.shown);
    onFrame(prelude.shown);
  }

  /** Makes the engine continue from the prelude, initially in its styles. The prelude is shown until the next frame arrives. */
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

  /** Sends changed options to the engine. Returns whether there were any. The step that follows is answered after it. */
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
