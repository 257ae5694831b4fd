/**
 * Decides when the players of a page draw: they share one context and one animation frame. The focused player goes
 * first, then those that have waited longest, until the frame's time is used.
 */

/** Time budget of players per animation frame, milliseconds. */
const BUDGET_MS = 6;

/** An object that draws. */
export interface Drawing {
  readonly hasFocus: boolean;
  /** Draws if there is something to draw. Returns whether it did. `now` in milliseconds. */
  draw(now: number): boolean;
}

export class Schedule {
  /** When each one started to wait. */
  readonly #waiting = new Map<Drawing, number>();
  #request = 0;

  /** Registers an object that draws. */
  add(drawing: Drawing): void {
    this.#waiting.set(drawing, 0);
    if (this.#request === 0) this.#request = requestAnimationFrame(this.#tick);
  }

  /** Unregisters it. */
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
