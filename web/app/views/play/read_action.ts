/** The recognised action of the input, with hysteresis. */
import type { Reading } from "../../../client/protocol";

/** Minimum class weight for a change of the action, and minimum time between changes. */
const SURE = 0.5;
const MIN_MS = 600;

export class ReadAction {
  name = "walk";
  #since = 0;

  /** Takes the classes of a new frame, heaviest first; whether the name has changed. */
  take([heaviest]: readonly Reading[]): boolean {
    const now = performance.now();
    if (!heaviest || heaviest.weight < SURE || heaviest.action === this.name || now - this.#since <= MIN_MS)
      return false;
    this.name = heaviest.action;
    this.#since = now;
    return true;
  }
}
