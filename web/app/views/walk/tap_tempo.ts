/** Tap tempo: a cadence from tapped beats. */

/** Number of latest beats whose mean is the tempo. */
const MAX_BEATS = 6;
/** A longer pause begins a new tempo. */
const PAUSE_MS = 2500;

export class TapTempo {
  #beats: number[] = [];

  /**
   * Adds a beat.
   * @param now milliseconds of any clock
   * @returns beats per minute; `undefined` until there are two
   */
  tap(now: number): number | undefined {
    if (now - (this.#beats.at(-1) ?? now) > PAUSE_MS) this.#beats = [];
    this.#beats = [...this.#beats, now].slice(-MAX_BEATS);
    const intervals = this.#beats.length - 1;
    return intervals > 0 ? (60_000 * intervals) / (now - this.#beats[0]!) : undefined;
  }
}
