/** What drawing and walking take, smoothed: figures that jump are not read. */

/** Share of a new measurement. */
const SHARE = 0.06;

export class Pace {
  #ms: number | undefined;

  /** Takes a measurement, milliseconds. */
  add(ms: number): void {
    this.#ms = this.#ms === undefined ? ms : this.#ms + SHARE * (ms - this.#ms);
  }

  /** Milliseconds; `undefined` until something is measured. */
  get ms(): number | undefined {
    return this.#ms;
  }
}
