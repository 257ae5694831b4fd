/** Types of `random.mjs` for its tests. */
export function generator(seed: number): () => number;
export function shuffled<T>(items: readonly T[], random: () => number): T[];
