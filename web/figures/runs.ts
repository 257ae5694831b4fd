/** First and last indices of the runs of consecutive items that belong to something, such as the stances of a foot. */
export function runsOf(from: number, to: number, belongs: (index: number) => boolean): [first: number, last: number][] {
  const found: [number, number][] = [];
  for (let i = from; i < to; i++) {
    if (!belongs(i)) continue;
    const run = found.at(-1);
    if (run?.[1] === i - 1) run[1] = i;
    else found.push([i, i]);
  }
  return found;
}
