/** The playhead: play, pause, step and scrub. */
import type { Session } from "../../player/session";
import type { Store } from "./store";

export class Playhead {
  /** Called with the frame during scrubbing, and with `undefined` at its end. */
  onScrub: ((frame: number | undefined) => void) | undefined;
  readonly #store: Store;
  readonly #session: Session;
  #scrubbing = false;
  /** Frame that was requested from the engine and has not arrived yet. */
  #target: number | undefined;
  #previewing = false;

  constructor(store: Store, session: Session) {
    this.#store = store;
    this.#session = session;
    session.listen({
      onFrame: ({ ended }, sought) => {
        if (sought) this.#target = undefined;
        if (ended && store.state.playing) this.pause();
      },
    });
  }

  /** Whether the playhead is being dragged. */
  get scrubbing(): boolean {
    return this.#scrubbing;
  }

  /** The playhead's input frame, fractional. */
  get at(): number {
    const { frame } = this.#store.state;
    return this.#previewing ? frame : (this.#target ?? this.#session.frame?.inputFrame ?? frame);
  }

  /** Whether a frame under the pointer is shown instead of the playhead's. */
  get previewing(): boolean {
    return this.#previewing;
  }

  /** While paused, shows the frame under the pointer; `undefined` returns to the playhead. */
  preview(frame: number | undefined): void {
    const { playing, frame: at } = this.#store.state;
    if (playing || this.#scrubbing || !this.#session.input) return;
    if (frame === undefined && !this.#previewing) return;
    this.#previewing = frame !== undefined;
    this.#session.playback.seek(frame ?? at);
  }

  togglePlay(): void {
    const { playing, loop } = this.#store.state;
    if (playing) {
      this.pause();
      return;
    }
    if (this.#previewing) this.#session.playback.seek(this.#store.state.frame);
    this.#previewing = false;
    if (!loop && this.#session.frame?.ended) this.#session.playback.seek(this.#store.state.range?.first ?? 0);
    this.#store.edit({ playing: true, frame: 0 });
  }

  /** Pauses at the newest frame, which the engine may still have to deliver. */
  pause(): void {
    this.#store.edit({ playing: false, frame: this.at });
    void this.#session.shown().then(() => {
      if (!this.#store.state.playing) this.#store.adopt({ frame: this.at });
    });
  }

  /** Jumps to an input frame, clamped to the input. */
  goTo(frame: number): void {
    const input = this.#session.input;
    if (!input) return;
    const at = Math.min(Math.max(0, frame), input.frames - 1);
    this.takeOver(at);
    if (!this.#store.state.playing) this.#store.edit({ frame: at });
  }

  /** Sets the frame before its input is open, so that {@link goTo} cannot show it yet. */
  awaitFrame(frame: number): void {
    this.#previewing = false;
    this.#target = frame;
  }

  /** Shows a frame that another view chose; while paused it is already in the state. */
  takeOver(frame: number): void {
    this.awaitFrame(frame);
    this.#session.playback.seek(frame);
  }

  step(by: number): void {
    const input = this.#session.input;
    if (!input || !this.#session.frame) return;
    const { loop, range } = this.#store.state;
    const [first, last] = [range?.first ?? 0, Math.min(range?.last ?? input.frames - 1, input.frames - 1)];
    const at = Math.round(this.at) + by;
    this.#store.edit({ playing: false });
    this.goTo(loop && at > last ? first : loop && at < first ? last : at);
  }

  scrub(frame: number): void {
    this.#scrubbing = true;
    this.#previewing = false;
    this.#session.playback.playing = false;
    this.#target = frame;
    this.onScrub?.(frame);
    this.#session.playback.seek(frame);
  }

  endScrub(): void {
    this.#scrubbing = false;
    if (!this.#store.state.playing) this.#store.edit({ frame: this.at });
    this.onScrub?.(undefined);
  }
}
