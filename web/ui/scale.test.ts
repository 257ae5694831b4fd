import fc from "fast-check";
import { expect, it } from "vitest";
import {
  clampedValueAt,
  decades,
  paddedExtent,
  pixelOf,
  roundedExtent,
  ruler,
  type Scale,
  ticks,
  valueAt,
} from "./scale";

const bound = fc.double({ min: -1e4, max: 1e4, noNaN: true });
const length = fc.double({ min: 1e-2, max: 1e4, noNaN: true });
/** Scales that run up or down a screen. */
const scales = fc
  .tuple(bound, length, fc.integer({ min: -500, max: 500 }), fc.integer({ min: 20, max: 2000 }), fc.boolean())
  .map(([min, width, from, px, up]): Scale => ({ min, max: min + width, from, to: up ? from - px : from + px }));

it("leads to pixels and back", () => {
  const scale = { min: 80, max: 94, from: 440, to: 0 };
  expect(pixelOf(scale, 80)).toBe(440);
  expect(pixelOf(scale, 94)).toBe(0);
  fc.assert(
    fc.property(scales, bound, (scale, value) => {
      const error = Math.abs(valueAt(scale, pixelOf(scale, value)) - value);
      expect(error).toBeLessThan(1e-9 * (Math.abs(scale.min) + scale.max - scale.min + Math.abs(value) + 1));
    }),
  );
});

it("stays finite without extent", () => {
  expect(pixelOf({ min: 3, max: 3, from: 10, to: 90 }, 3)).toBe(10);
  expect(valueAt({ min: 3, max: 5, from: 10, to: 10 }, 40)).toBe(3);
  expect(ruler({ min: 3, max: 3, from: 10, to: 90 }, 40)).toEqual([]);
});

it("keeps clamped values within", () => {
  fc.assert(
    fc.property(scales, bound, (scale, pixel) => {
      const value = clampedValueAt(scale, pixel);
      expect(value >= scale.min && value <= scale.max).toBe(true);
    }),
  );
});

it("has round ticks within", () => {
  expect(ticks({ min: 80, max: 94 }, 7)).toEqual({ values: [80, 82, 84, 86, 88, 90, 92, 94], digits: 0 });
  expect(ticks({ min: -0.31, max: 0.22 }, 6)).toEqual({ values: [-0.3, -0.2, -0.1, 0, 0.1, 0.2], digits: 1 });
  expect(ticks({ min: 1, max: 1 }, 5).values).toEqual([]);
  fc.assert(
    fc.property(scales, fc.integer({ min: 1, max: 30 }), (scale, count) => {
      const { values, digits } = ticks(scale, count);
      expect(values.length).toBeLessThanOrEqual(count + 1);
      const slack = 10 ** -digits * 1e-6 + 1e-9 * (scale.max - scale.min);
      expect(values.every((v) => v >= scale.min - slack && v <= scale.max + slack)).toBe(true);
      expect(values.every((v) => Number(v.toFixed(digits)) === v)).toBe(true);
    }),
  );
});

it("has a ruler whose labels keep their distance", () => {
  const marks = ruler({ min: 0, max: 2, from: 100, to: 500 }, 150);
  expect(marks.filter(({ label }) => label !== undefined)).toEqual([
    { value: 0, pixel: 100, label: "0" },
    { value: 1, pixel: 300, label: "1" },
    { value: 2, pixel: 500, label: "2" },
  ]);
  expect(marks.map(({ value }) => value)).toEqual([0, 0.2, 0.4, 0.6, 0.8, 1, 1.2, 1.4, 1.6, 1.8, 2]);
  expect(ruler({ min: 0, max: 600, from: 0, to: 1100 }, 100).find(({ value }) => value === 100)?.label).toBe("100");
  fc.assert(
    fc.property(scales, fc.integer({ min: 10, max: 200 }), (scale, minPx) => {
      const marks = ruler(scale, minPx);
      const long = marks.filter(({ label }) => label !== undefined);
      for (let i = 1; i < long.length; i++)
        expect(Math.abs(long[i]!.pixel - long[i - 1]!.pixel)).toBeGreaterThan(minPx * (1 - 1e-6) - 1e-3);
      const places = long.map((mark) => marks.indexOf(mark));
      for (let i = 1; i < places.length; i++) expect(places[i]! - places[i - 1]!).toBe(5);
    }),
  );
});

it("takes in all values, with room beside them", () => {
  expect(paddedExtent([2, 4, Number.NaN, 3], 0.25)).toEqual({ min: 1.5, max: 4.5 });
  expect(paddedExtent([7, 7], 0.1)).toEqual({ min: 6.5, max: 7.5 });
  expect(paddedExtent([], 0.1)).toEqual({ min: 0, max: 1 });
});

it("rounds the ends around all values", () => {
  const number = fc.double({ min: -1e4, max: 1e4, noNaN: true });
  fc.assert(
    fc.property(fc.array(number, { minLength: 1 }), fc.double({ min: 0.1, max: 100, noNaN: true }), (values, least) => {
      const { min, max } = roundedExtent(values, least);
      const slack = 1e-6 * (1 + Math.abs(min) + Math.abs(max));
      expect(values.every((value) => value >= min - slack && value <= max + slack)).toBe(true);
      expect(max - min).toBeGreaterThan(least - slack);
    }),
  );
  expect(roundedExtent([], 3)).toEqual({ min: 0, max: 3 });
  expect(roundedExtent([31, 37], 1)).toEqual({ min: 30, max: 38 });
});

it("has as many decimals as distinguish its ticks", () => {
  const digits = (min: number, max: number, count: number) => ticks({ min, max }, count).digits;
  expect([digits(0, 50, 5), digits(0, 5, 5), digits(0, 1, 2), digits(0.1, 0.2, 5)]).toEqual([0, 0, 1, 2]);
});

it("is logarithmic where asked, with powers of ten", () => {
  const scale: Scale = { min: 0.0001, max: 10, from: 44, to: 384, log: true };
  expect(decades(scale)).toEqual([0.0001, 0.001, 0.01, 0.1, 1, 10]);
  fc.assert(
    fc.property(fc.double({ min: 0, max: 1, noNaN: true }), (share) => {
      const value = 0.0001 * 1e5 ** share;
      expect(valueAt(scale, pixelOf(scale, value))).toBeCloseTo(value, 5);
    }),
  );
  expect(pixelOf(scale, 0.01)).toBeCloseTo(44 + 0.4 * 340);
});
