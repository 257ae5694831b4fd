/** Chooses the body of each walker of a crowd: the nearer, the finer. */

/** Names of the bodies, from the finest. */
export const BODIES = ["near", "middle", "far"] as const;
export type Body = (typeof BODIES)[number];

/** Walkers that have the finer bodies: at least this tall on screen, pixels, and at most this many. */
export interface BodyLimits {
  near: { height: number; count: number };
  middle: { height: number; count: number };
}

export const BODY_LIMITS: BodyLimits = { near: { height: 220, count: 4 }, middle: { height: 60, count: 48 } };

/** A walker keeps a finer body until its height falls below the limit by this factor, which avoids flicker between bodies. */
const KEEPING = 0.88;

/** The bodies of a crowd. Nothing is allocated while the number of walkers does not change. */
export class BodyLevels {
  /** Indices of the walkers with each body; {@link counts} has their numbers. */
  readonly walkers: Record<Body, Uint16Array>;
  readonly counts: Record<Body, number> = { near: 0, middle: 0, far: 0 };
  /** Index into {@link BODIES} of each walker's body. */
  readonly #worn: Uint8Array;
  /** The visible walkers, the tallest first. */
  readonly #order: Uint16Array;
  readonly #ranks: Float32Array;

  constructor(count: number) {
    const numbers = () => new Uint16Array(count);
    this.walkers = { near: numbers(), middle: numbers(), far: numbers() };
    this.#worn = new Uint8Array(count).fill(BODIES.indexOf("far"));
    this.#order = numbers().map((_, i) => i);
    this.#ranks = new Float32Array(count);
  }

  /** Chooses bodies by the heights on screen, pixels; 0 means not visible. */
  choose(heights: ArrayLike<number>, limits: BodyLimits): void {
    const { counts } = this;
    for (const body of BODIES) counts[body] = 0;
    this.#sort(heights);
    for (const walker of this.#order) {
      if (heights[walker] === 0) break;
      const rank = this.#ranks[walker]!;
      const body = BODIES.find(
        (name) => name === "far" || (counts[name] < limits[name].count && rank >= limits[name].height),
      )!;
      this.#worn[walker] = BODIES.indexOf(body);
      this.walkers[body][counts[body]++] = walker;
    }
  }

  /** Sorts the walkers; those that keep a finer body come first. The order is nearly that of the last picture. */
  #sort(heights: ArrayLike<number>): void {
    const order = this.#order;
    const ranks = this.#ranks;
    for (let walker = 0; walker < ranks.length; walker++)
      ranks[walker] = heights[walker]! / KEEPING ** (BODIES.length - 1 - this.#worn[walker]!);
    for (let i = 1; i < order.length; i++) {
      const walker = order[i]!;
      let at = i;
      for (; at > 0 && ranks[order[at - 1]!]! < ranks[walker]!; at--) order[at] = order[at - 1]!;
      order[at] = walker;
    }
  }
}
