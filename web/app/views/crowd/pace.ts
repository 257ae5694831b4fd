/** Time for drawing and for ticks, smoothed, since jumping numbers are not readable. */

/** Weight of a new measurement. */
const SHARE = 0.06;

export class Pace {
  #ms: number | undefined;

  /** Adds a measurement, milliseconds. */
  add(ms: number): void {
    this.#ms = this.#ms === undefined ? ms : this.#ms + SHARE * (ms - this.#ms);
  }

  /** Milliseconds; `undefined` until there is a measurement. */
  get ms(): number | undefined {
    return this.#ms;
  }
}
