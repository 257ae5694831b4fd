/**
 * Cost of a frame in the engine: the mean of the last measurements. Some browsers' clocks have a resolution of whole
 * milliseconds, which is longer than a frame; the mean is still correct, the median would be 0.
 */

/** Number of measurements in the mean. */
const MEASURED = 120;

export class FrameCost {
  readonly #costsMs: number[] = [];

  /** @param nowMs a clock */
  constructor(private readonly nowMs: () => number = () => performance.now()) {}

  /** Measures work on some frames. */
  measure<T>(frames: number, work: () => T): T {
    const started = this.nowMs();
    const done = work();
    this.#costsMs.push((this.nowMs() - started) / frames);
    if (this.#costsMs.length > MEASURED) this.#costsMs.shift();
    return done;
  }

  get ms(): number {
    const costs = this.#costsMs;
    return costs.reduce((sum, cost) => sum + cost, 0) / (costs.length || 1);
  }
}
