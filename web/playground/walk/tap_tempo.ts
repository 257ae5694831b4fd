/** The tempo that a hand beats. */

/** Beats that count. */
const MOST_BEATS = 6;
/** After so long a pause somebody begins anew. */
const PAUSE_MS = 2500;

/** Hears beats and says how many there are in a minute. */
export class TapTempo {
  #beats: number[] = [];

  /**
   * Another beat.
   * @param now milliseconds of any clock
   * @returns beats a minute; `undefined` until there are two
   */
  tap(now: number): number | undefined {
    if (now - (this.#beats.at(-1) ?? now) > PAUSE_MS) this.#beats = [];
    this.#beats = [...this.#beats, now].slice(-MOST_BEATS);
    const intervals = this.#beats.length - 1;
    return intervals > 0 ? (60_000 * intervals) / (now - this.#beats[0]!) : undefined;
  }
}
