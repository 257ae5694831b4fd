/** Decides when a picture is drawn: while it changes, and once more in finer quality when it has not changed for a while. */

/** Time after the last change in which glides and fades end, seconds; after it the picture is still. */
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
   * Whether nothing has changed for a while; `timeSecs` is any clock. A change that has not been drawn counts as
   * current, however long the GPU is busy.
   */
  settled(timeSecs: number): boolean {
    if (this.#pending) this.#changedAt = timeSecs;
    return timeSecs - this.#changedAt > SETTLING;
  }

  /** Called when the current picture has been drawn. */
  drawn(): void {
    this.#pending = false;
  }
}

/** Copies a pose, and requests a redraw if any of its numbers differs. */
export function setPose(to: Float32Array, pose: ArrayLike<number>, redraw: Redraw): void {
  for (let i = 0; i < pose.length; i++)
    if (Math.fround(pose[i]!) !== to[i]) {
      redraw.request();
      break;
    }
  to.set(pose);
}
