/** The recognised action of the input, with hysteresis. */
import type { Reading } from "../../../client/protocol";
import { isFaint, isUnlike, type Likeness } from "./likeness";

/** Minimum class weight for a change of the action, and minimum time between changes. */
const SURE = 0.5;
const MIN_MS = 600;

export class ReadAction {
  /** `undefined` if the input is not similar to any action, or not recognised yet. */
  name: string | undefined = "walk";
  #since = 0;
  /** Whether another input is open without a recognised frame: until then the name is kept, so that it changes only once. */
  #isNew = false;
  /** The recognised class of the whole input, once it is known. */
  #whole: Likeness | undefined;

  /** Called when another input is open: the previous action no longer counts. */
  forget(): void {
    this.#isNew = true;
    this.#whole = undefined;
  }

  /** Sets the recognised class of the whole input. Returns whether the name has changed. */
  takeWhole(likeness: Likeness): boolean {
    this.#whole = likeness;
    if (isUnlike(likeness)) return this.#rename(undefined);
    return this.name === undefined && this.#rename(likeness.read.action);
  }

  /** Adds the classes of a new frame, heaviest first. Returns whether the name has changed. */
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
