/**
 * When the players of a page draw: they share one context and one animation frame. The one with the focus goes first, then
 * those that have waited longest, until the frame's time is used.
 */

/** Time that players may take of an animation frame, milliseconds. */
const BUDGET_MS = 6;

/** Something that draws. */
export interface Drawing {
  readonly hasFocus: boolean;
  /** Draws if there is something to draw; says whether it did. `now` in milliseconds. */
  draw(now: number): boolean;
}

export class Schedule {
  /** Since when each one waits. */
  readonly #waiting = new Map<Drawing, number>();
  #request = 0;

  /** Lets something draw. */
  add(drawing: Drawing): void {
    this.#waiting.set(drawing, 0);
    if (this.#request === 0) this.#request = requestAnimationFrame(this.#tick);
  }

  /** Lets it draw no longer. */
  remove(drawing: Drawing): void {
    this.#waiting.delete(drawing);
    if (this.#waiting.size > 0) return;
    cancelAnimationFrame(this.#request);
    this.#request = 0;
  }

  readonly #tick = (now: number): void => {
    this.#request = requestAnimationFrame(this.#tick);
    const begun = performance.now();
    for (const drawing of this.#inOrder()) {
      if (drawing.draw(now)) this.#waiting.set(drawing, now);
      if (performance.now() - begun > BUDGET_MS) return;
    }
  };

  #inOrder(): Drawing[] {
    return [...this.#waiting]
      .sort(([a, since], [b, sinceB]) => Number(b.hasFocus) - Number(a.hasFocus) || since - sinceB)
      .map(([drawing]) => drawing);
  }
}
