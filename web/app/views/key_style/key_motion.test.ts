import { expect, it } from "vitest";
import type { TimedValue } from "../../state/key_style";
import { seamless } from "./key_motion";

/** Keys of a circle in `length` seconds. */
const turn = (length: number): TimedValue[] =>
  Array.from({ length: 9 }, (_, i) => ({ secs: (length * i) / 8, values: [10 * Math.cos((Math.PI * (i % 8)) / 4)] }));

it("goes through the seam of what ends as it begins", () => {
  const keys = turn(1.2);
  const round = seamless(keys, 1.2);
  expect(round).toHaveLength(keys.length + 2);
  expect(round[0]!.secs).toBeCloseTo(-0.15);
  expect(round[0]!.values).toEqual(keys[7]!.values);
  expect(round.at(-1)!.values).toEqual(keys[1]!.values);
});

it("leaves alone what does not", () => {
  const keys = turn(1.2);
  expect(seamless(keys, 2)).toBe(keys);
  expect(seamless(keys.slice(0, -1), 1.2)).toHaveLength(8);
  expect(seamless([], 1)).toEqual([]);
});
