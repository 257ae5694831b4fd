import fc from "fast-check";
import { expect, test } from "vitest";
import { type Axes, decadesOf, digitsOf, extentOf, ticksOf, valueOfX, xOf, yOf } from "./axes";

const number = fc.double({ min: -1e4, max: 1e4, noNaN: true });

test("ends are round, and hold all values", () => {
  fc.assert(
    fc.property(fc.array(number, { minLength: 1 }), fc.double({ min: 0.1, max: 100, noNaN: true }), (values, least) => {
      const [min, max] = extentOf(values, least);
      const slack = 1e-6 * (1 + Math.abs(min) + Math.abs(max));
      expect(values.every((value) => value >= min - slack && value <= max + slack)).toBe(true);
      expect(max - min).toBeGreaterThan(least - slack);
      const ticks = ticksOf([min, max], 5);
      expect(ticks.length).toBeLessThan(12);
      expect(ticks.every((tick) => tick >= min - slack && tick <= max + slack)).toBe(true);
    }),
  );
  expect(extentOf([], 3)).toEqual([0, 3]);
  expect(extentOf([31, 37], 1)).toEqual([30, 38]);
  expect(
    [
      [0, 10],
      [0, 1],
      [0, 0.5],
      [0.1, 0.12],
    ].map(digitsOf),
  ).toEqual([0, 0, 1, 2]);
  expect(decadesOf([0.0001, 10])).toEqual([0.0001, 0.001, 0.01, 0.1, 1, 10]);
});

test("a pixel has the value that lies on it", () => {
  const share = fc.double({ min: 0, max: 1, noNaN: true });
  fc.assert(
    fc.property(share, fc.boolean(), (at, logX) => {
      const axes: Axes = { width: 400, height: 200, x: [0.0001, 10], y: [0, 1], logX };
      const value = logX ? 0.0001 * 1e5 ** at : 0.0001 + at * 9.9999;
      expect(valueOfX(axes, xOf(axes, value))).toBeCloseTo(value, 5);
    }),
  );
  const axes: Axes = { width: 400, height: 200, x: [0, 1], y: [0, 1] };
  expect(yOf(axes, 1)).toBeLessThan(yOf(axes, 0));
});
