import { expect, test } from "vitest";
import { LatestOnly } from "./latest_only";

/** Work that ends when the test says so. */
function paced() {
  const [seen, ends]: [number[], (() => void)[]] = [[], []];
  const latest = new LatestOnly<number>((state) => {
    seen.push(state);
    return new Promise((resolve) => ends.push(resolve));
  });
  return { latest, seen, end: () => ends.shift()!() };
}

test("of the states that arrive while it is busy only the last is worked for", async () => {
  const { latest, seen, end } = paced();
  const first = latest.take(1);
  const rest = [2, 3, 4].map((state) => latest.take(state));
  end();
  await first;
  await Promise.resolve();
  expect(seen).toEqual([1, 4]);
  end();
  await Promise.all(rest);
  expect(seen).toEqual([1, 4]);
});

test("a failure is that of its state alone", async () => {
  const latest = new LatestOnly<number>(async (state) => {
    if (state === 1) throw new Error("one");
  });
  const first = latest.take(1);
  const second = latest.take(2);
  await expect(first).rejects.toThrow("one");
  await expect(second).resolves.toBeUndefined();
});
