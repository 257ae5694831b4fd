// Cycles in a graph.

/**
 * Returns the shortest cycles that together contain every node on a cycle.
 * @param next for each node a map of its successors, each with the edge that leads there
 * @returns the edges of each cycle
 */
export function circles(next) {
  const told = new Set();
  return [...next.keys()].flatMap((start) => {
    const circle = told.has(start) ? undefined : shortestCircle(start, next);
    if (!circle) return [];
    for (const { node } of circle) told.add(node);
    return [circle.map(({ edge }) => edge)];
  });
}

/** Returns the edges of the shortest cycle through a node, each with its start node. */
function shortestCircle(start, next) {
  const leave = (node, before) =>
    [...(next.get(node) ?? [])].map(([to, edge]) => ({ to, steps: [...before, { node, edge }] }));
  const ways = leave(start, []);
  const seen = new Set();
  for (let i = 0; i < ways.length; i++) {
    const { to, steps } = ways[i];
    if (to === start) return steps;
    if (seen.has(to)) continue;
    seen.add(to);
    ways.push(...leave(to, steps));
  }
  return undefined;
}
