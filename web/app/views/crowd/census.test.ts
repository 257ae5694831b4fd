import fc from "fast-check";
import { expect, test } from "vitest";
import { Census, countPeople, spread, stacked } from "./census";

test("people are counted by style, in parts, and all of them", () => {
  const counts = new Float32Array(3);
  countPeople(Uint8Array.of(255, 0, 0, 0, 51, 102), 2, counts);
  expect([...counts].map((n) => Number(n.toFixed(3)))).toEqual([1.2, 0.4, 1.4]);
  fc.assert(
    fc.property(fc.array(fc.tuple(fc.nat(255), fc.nat(255)), { maxLength: 50 }), (people) => {
      countPeople(Uint8Array.from(people.flat()), 2, counts);
      expect(counts[0]! + counts[1]! + counts[2]!).toBeCloseTo(people.length, 3);
      expect(Math.min(...counts)).toBeGreaterThanOrEqual(-1e-6);
    }),
  );
});

test("a minute is remembered", () => {
  const census = new Census(1);
  for (let i = 0; i < 200; i++) census.add(Uint8Array.of(i));
  expect(census.samples.length).toBe(121);
  expect(census.samples[0]![0]).toBeCloseTo(79 / 255);
  expect(census.samples.at(-1)![0]).toBeCloseTo(199 / 255);
});

test("styles that nobody walks in are left out, the average is not", () => {
  const census = new Census(3);
  census.add(Uint8Array.of(255, 0, 0));
  expect(census.present).toEqual([3, 0]);
});

test("layers are stacked to 1", () => {
  expect(stacked([1, 2, 1], [2, 0, 1])).toEqual([0, 0.25, 0.5, 1]);
  expect(stacked([0, 0], [0, 1])).toEqual([0, 0.5, 1]);
});

test("labels keep their distance and stay inside", () => {
  expect(spread([10, 11, 40], 13, 0, 50)).toEqual([10, 23, 40]);
  expect(spread([48, 49, 50], 13, 0, 50)).toEqual([24, 37, 50]);
  expect(spread([-9], 13, 0, 50)).toEqual([0]);
  fc.assert(
    fc.property(fc.array(fc.double({ min: 0, max: 100, noNaN: true }), { minLength: 1, maxLength: 7 }), (wanted) => {
      const places = spread(
        wanted.sort((a, b) => a - b),
        13,
        0,
        100,
      );
      for (let i = 1; i < places.length; i++) expect(places[i]! - places[i - 1]!).toBeGreaterThanOrEqual(13 - 1e-9);
      expect(places[0]).toBeGreaterThanOrEqual(0);
      expect(places.at(-1)).toBeLessThanOrEqual(100);
    }),
  );
});
