// Circles in a graph.

/**
 * The shortest circles that together lead through every node that lies on one.
 * @param next for each node a map of the nodes that it leads to, each with the edge that leads there
 * @returns the edges of each circle
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

/** The edges that lead from a node back to it by the shortest way, each with the node that it starts from. */
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
