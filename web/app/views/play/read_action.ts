/** The recognised action of the input, with hysteresis. */
import type { Reading } from "../../../client/protocol";
import { isFaint, isUnlike, type Likeness } from "./likeness";

/** Minimum class weight for a change of the action, and minimum time between changes. */
const SURE = 0.5;
const MIN_MS = 600;

export class ReadAction {
  /** Undefined where the input is unlike all actions, or not read yet. */
  name: string | undefined = "walk";
  #since = 0;
  /** Whether another input is open, of which no frame was read yet: until then the name stays, so that it changes once. */
  #isNew = false;
  /** What the input is like as a whole, once that is known. */
  #whole: Likeness | undefined;

  /** Another input is open: the action of the one before does not count. */
  forget(): void {
    this.#isNew = true;
    this.#whole = undefined;
  }

  /** Takes what the input is like as a whole; whether the name has changed. */
  takeWhole(likeness: Likeness): boolean {
    this.#whole = likeness;
    if (isUnlike(likeness)) return this.#rename(undefined);
    return this.name === undefined && this.#rename(likeness.read.action);
  }

  /** Takes the classes of a new frame, heaviest first; whether the name has changed. */
  take([heaviest]: readonly Reading[], now = performance.now()): boolean {
    if (!heaviest || (this.#whole && isUnlike(this.#whole))) return false;
    if (this.#isNew) {
      this.#isNew = false;
      this.#since = now;
      return this.#rename(isFaint(heaviest) ? undefined : heaviest.action);
    }
    if (heaviest.weight < SURE || heaviest.action === this.name || now - this.#since <= MIN_MS) return false;
    this.#since = now;
    return this.#rename(heaviest.action);
  }

  #rename(name: string | undefined): boolean {
    const changed = name !== this.name;
    this.name = name;
    return changed;
  }
}
