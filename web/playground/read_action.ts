/** What the character is said to do: the action of the input, as the engine reads it. */
import type { Reading } from "../worker/protocol";

/** Another action is named only when the engine is this sure, and no more often than this. */
const SURE = 0.5;
const LEAST_MS = 600;

export class ReadAction {
  name = "walk";
  #since = 0;

  /** Takes the classes of a new frame, heaviest first; whether the name has changed. */
  take([heaviest]: readonly Reading[]): boolean {
    const now = performance.now();
    if (!heaviest || heaviest.weight < SURE || heaviest.action === this.name || now - this.#since <= LEAST_MS)
      return false;
    this.name = heaviest.action;
    this.#since = now;
    return true;
  }
}
