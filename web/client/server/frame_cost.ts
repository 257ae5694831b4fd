/** What a frame costs in the engine: the median of the last ones. */
import { median } from "./time_slices";

/** Frames over which it is measured. */
const FRAMES = 61;

export class FrameCost {
  readonly #costsMs: number[] = [];

  /** @param nowMs a clock */
  constructor(private readonly nowMs: () => number = () => performance.now()) {}

  /** Does the work of some frames. */
  measure<T>(frames: number, work: () => T): T {
    const started = this.nowMs();
    const done = work();
    this.#costsMs.push((this.nowMs() - started) / frames);
    if (this.#costsMs.length > FRAMES) this.#costsMs.shift();
    return done;
  }

  get ms(): number {
    return median(this.#costsMs);
  }
}
