/** Where the motion stands: plays, pauses, steps and scrubs. */
import type { LiveFrame } from "../worker/protocol";
import type { Session } from "./session";
import type { Store } from "./store";

export class Playhead {
  /** The newest frame of the engine. */
  frame: LiveFrame | undefined;
  session: Session | undefined;
  readonly #store: Store;
  readonly #onScrub: (frame: number | undefined) => void;
  #scrubbing = false;
  /** Where the playhead was put; the engine's answer comes later. */
  #target: number | undefined;
  #previewing = false;

  /** `onScrub` hears where the playhead is dragged to, and `undefined` when it is let go. */
  constructor(store: Store, onScrub: (frame: number | undefined) => void) {
    this.#store = store;
    this.#onScrub = onScrub;
  }

  /** Whether the playhead is in somebody's hand. */
  get scrubbing(): boolean {
    return this.#scrubbing;
  }

  /** Takes a new frame of the engine; `sought` where it was asked for by its number. */
  take(frame: LiveFrame, sought: boolean): void {
    this.frame = frame;
    if (sought) this.#target = undefined;
  }

  /** Fractional input frame at which the playhead stands. */
  get at(): number {
    const { frame } = this.#store.state;
    return this.#previewing ? frame : (this.#target ?? this.frame?.inputFrame ?? frame);
  }

  /** Whether another frame than the playhead's is looked at. */
  get previewing(): boolean {
    return this.#previewing;
  }

  /** Shows a resting character at the frame under the pointer; `undefined` brings it back to the playhead. */
  preview(frame: number | undefined): void {
    const { playing, frame: at } = this.#store.state;
    if (playing || this.#scrubbing || !this.session?.input) return;
    if (frame === undefined && !this.#previewing) return;
    this.#previewing = frame !== undefined;
    this.session.playback.seek(frame ?? at);
  }

  togglePlay(): void {
    const { playing, loop } = this.#store.state;
    if (playing) {
      this.pause();
      return;
    }
    if (this.#previewing) this.session?.playback.seek(this.#store.state.frame);
    this.#previewing = false;
    if (!loop && this.frame?.ended) this.session?.playback.seek(this.#store.state.range?.first ?? 0);
    this.#store.edit({ playing: true, frame: 0 });
  }

  /** Stops where the motion is: at the frame that the engine was asked for before, if one is on its way. */
  pause(): void {
    this.#store.edit({ playing: false, frame: this.at });
    void this.session?.shown().then(() => {
      if (!this.#store.state.playing) this.#store.adopt({ frame: this.at });
    });
  }

  /** Goes to an input frame, or as near as there is one. */
  goTo(frame: number): void {
    const input = this.session?.input;
    if (!input) return;
    const at = Math.min(Math.max(0, frame), input.frames - 1);
    this.#previewing = false;
    this.#target = at;
    this.session?.playback.seek(at);
    if (!this.#store.state.playing) this.#store.edit({ frame: at });
  }

  step(by: number): void {
    const input = this.session?.input;
    if (!input || !this.frame) return;
    const { loop, range } = this.#store.state;
    const [first, last] = [range?.first ?? 0, Math.min(range?.last ?? input.frames - 1, input.frames - 1)];
    const at = Math.round(this.at) + by;
    this.#store.edit({ playing: false });
    this.goTo(loop && at > last ? first : loop && at < first ? last : at);
  }

  scrub(frame: number): void {
    this.#scrubbing = true;
    this.#previewing = false;
    if (this.session) this.session.playback.playing = false;
    this.#target = frame;
    this.#onScrub(frame);
    this.session?.playback.seek(frame);
  }

  endScrub(): void {
    this.#scrubbing = false;
    if (!this.#store.state.playing) this.#store.edit({ frame: this.at });
    this.#onScrub(undefined);
  }
}
