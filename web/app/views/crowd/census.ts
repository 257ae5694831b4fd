/** Counts agents by style, now and over the last minute. */

/** Seconds that are kept, and how often agents are counted in them. */
export const REMEMBERED_SECS = 60;
export const COUNTS_HZ = 2;

/** Full weight of a style in the crowd's data. */
const FULL = 255;

/**
 * Counts agents by style. An agent with two half weights counts half for each style; weight missing to 1 counts for the
 * average. Writes one number per style, then that of the average; they sum to the number of agents.
 */
export function countPeople(weights: Uint8Array, styles: number, into: Float32Array): void {
  into.fill(0);
  for (let at = 0; at < weights.length; at += styles) {
    let sum = 0;
    for (let i = 0; i < styles; i++) sum += weights[at + i]!;
    // Overlapping exaggerated styles may sum to more than one agent.
    const share = 1 / Math.max(FULL, sum);
    for (let i = 0; i < styles; i++) into[i]! += share * weights[at + i]!;
    into[styles]! += 1 - share * sum;
  }
}

/** The counts of the last minute. */
export class Census {
  /** Categories: the styles, then the average. */
  readonly kinds: number;
  readonly #samples: Float32Array[] = [];

  constructor(styles: number) {
    this.kinds = styles + 1;
  }

  /** Counts, the oldest first; the last one is current, and they are {@link COUNTS_HZ} per second. */
  get samples(): readonly Float32Array[] {
    return this.#samples;
  }

  /** Adds the current count. */
  add(weights: Uint8Array): void {
    const full = this.#samples.length > REMEMBERED_SECS * COUNTS_HZ;
    const sample = (full ? this.#samples.shift() : undefined) ?? new Float32Array(this.kinds);
    countPeople(weights, this.kinds - 1, sample);
    this.#samples.push(sample);
  }

  /** Categories with at least half an agent within the minute; the average is the first. */
  get present(): number[] {
    const average = this.kinds - 1;
    const order = [average, ...Array.from({ length: average }, (_, i) => i)];
    return order.filter((kind) => kind === average || this.#samples.some((sample) => sample[kind]! >= 0.5));
  }
}

/** Boundaries between stacked layers, as shares of 1: the first is 0, the last 1. */
export function stacked(sample: ArrayLike<number>, order: readonly number[]): number[] {
  const total = order.reduce((sum, kind) => sum + sample[kind]!, 0);
  const edges = [0];
  for (const kind of order) edges.push(edges.at(-1)! + (total > 0 ? sample[kind]! / total : 1 / order.length));
  return edges;
}

/** Positions of labels near `wanted`, in this order, at least `gap` apart and within `from`…`to`. */
export function spread(wanted: readonly number[], gap: number, from: number, to: number): number[] {
  const at = [...wanted];
  for (let i = 0; i < at.length; i++) at[i] = Math.max(at[i]!, i === 0 ? from : at[i - 1]! + gap);
  for (let i = at.length - 1; i >= 0; i--) at[i] = Math.min(at[i]!, i === at.length - 1 ? to : at[i + 1]! - gap);
  return at;
}
