/** The base of views that draw with every display frame while they are shown. */
import type { UndoRedo } from "./state/history";
import type { View, ViewHost } from "./view";

export abstract class AnimatedView implements View {
  abstract readonly element: HTMLElement;
  protected readonly host: ViewHost;
  /** Aborts when the view is hidden; `undefined` while it is hidden. */
  #shown: AbortController | undefined;
  #request = 0;

  constructor(host: ViewHost) {
    this.host = host;
  }

  get history(): UndoRedo {
    return this.host.store;
  }

  /** Whether the view is shown. */
  protected get isShown(): boolean {
    return this.#shown !== undefined;
  }

  show(): void {
    this.#shown = new AbortController();
    this.appear(this.#shown.signal);
    this.#request = requestAnimationFrame(this.#tick);
  }

  hide(): void {
    if (!this.#shown) return;
    this.#shown.abort();
    this.#shown = undefined;
    cancelAnimationFrame(this.#request);
    this.disappear();
  }

  dispose(): void {
    this.hide();
  }

  /** Called when the view is shown; listeners that are added with the signal end when it is hidden. */
  protected abstract appear(signal: AbortSignal): void;

  /** Called when the view was hidden. */
  protected abstract disappear(): void;

  /** Draws a display frame. @param now milliseconds */
  protected abstract tick(now: number): void;

  readonly #tick = (now: number): void => {
    this.#request = requestAnimationFrame(this.#tick);
    this.tick(now);
  };
}
