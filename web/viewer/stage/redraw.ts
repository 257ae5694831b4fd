/** When a picture is drawn: as long as it changes, and once more, finer, when it has not changed for a while. */

/** Time after the last change in which glides and fades end, seconds; then the picture is still. */
const SETTLING = 0.8;

export class Redraw {
  #changedAt = 0;
  #pending = true;

  /** Whether a change has not been drawn yet. */
  get pending(): boolean {
    return this.#pending;
  }

  /** Something in the picture has changed. */
  request(): void {
    this.#pending = true;
  }

  /**
   * Whether nothing has changed for a while; `timeSecs` is any clock. A change that has not been drawn is a present one,
   * however long the graphics processor is busy.
   */
  settled(timeSecs: number): boolean {
    if (this.#pending) this.#changedAt = timeSecs;
    return timeSecs - this.#changedAt > SETTLING;
  }

  /** The picture is on screen as it is now. */
  drawn(): void {
    this.#pending = false;
  }
}
