/**
 * What a frame costs in the engine: the mean of the last ones. Clocks of some browsers tell whole milliseconds only, of which a
 * frame takes a part; their mean is right all the same, their median is 0.
 */

/** Measurements of which the mean is taken. */
const MEASURED = 120;

export class FrameCost {
  readonly #costsMs: number[] = [];

  /** @param nowMs a clock */
  constructor(private readonly nowMs: () => number = () => performance.now()) {}

  /** Does the work of some frames. */
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
