import fc from "fast-check";
import { expect, it } from "vitest";
import { pixelOf, rangeOf, ticks, valueAt } from "./scale";

it("leads to pixels and back", () => {
  const scale = { least: 80, most: 94, from: 440, to: 0 };
  expect(pixelOf(scale, 80)).toBe(440);
  expect(pixelOf(scale, 94)).toBe(0);
  const value = fc.double({ min: -500, max: 500, noNaN: true });
  fc.assert(
    fc.property(value, (v) => {
      expect(valueAt(scale, pixelOf(scale, v))).toBeCloseTo(v, 6);
    }),
  );
});

it("has round numbers along it", () => {
  expect(ticks({ least: 80, most: 94 }, 7)).toEqual({ at: [80, 82, 84, 86, 88, 90, 92, 94], digits: 0 });
  expect(ticks({ least: -0.31, most: 0.22 }, 6)).toEqual({ at: [-0.3, -0.2, -0.1, 0, 0.1, 0.2], digits: 1 });
  expect(ticks({ least: 1, most: 1 }, 5).at).toEqual([]);
  const bound = fc.double({ min: -1e4, max: 1e4, noNaN: true });
  fc.assert(
    fc.property(bound, fc.double({ min: 1e-3, max: 1e4, noNaN: true }), (least, width) => {
      const { at } = ticks({ least, most: least + width }, 6);
      expect(at.length).toBeLessThanOrEqual(8);
      expect(at.every((v) => v >= least - width * 1e-3 && v <= least + width * 1.001)).toBe(true);
    }),
  );
});

it("takes in all values, with room beside them", () => {
  expect(rangeOf([2, 4, Number.NaN, 3], 0.25)).toEqual({ least: 1.5, most: 4.5 });
  expect(rangeOf([7, 7], 0.1)).toEqual({ least: 6.5, most: 7.5 });
  expect(rangeOf([], 0.1)).toEqual({ least: 0, most: 1 });
});
