import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { contour, density, encloses, type Grid } from "./contours";

const grid = (rows: number[][]): Grid => ({
  columns: rows[0]!.length,
  rows: rows.length,
  values: Float32Array.from(rows.flat()),
});

describe("density", () => {
  it("is greatest where most points are", () => {
    const { values, columns } = density([0.25, 0.5, 0.25, 0.5, 0.75, 0.5], 41, 21);
    expect(values[10 * columns + 10]).toBeCloseTo(1);
    expect(values[10 * columns + 30]).toBeCloseTo(0.5);
    expect(values[0]).toBeLessThan(0.01);
  });

  it("is nothing without points, and passes over those beyond", () => {
    expect(density([], 5, 5).values.every((v) => v === 0)).toBe(true);
    expect(density([7, -3, Number.NaN, 0.5], 5, 5).values.every((v) => v === 0)).toBe(true);
  });
});

describe("a contour", () => {
  it("goes round a hill", () => {
    const [loop, ...others] = contour(
      grid([
        [0, 0, 0],
        [0, 1, 0],
        [0, 0, 0],
      ]),
      0.5,
    );
    expect(others).toEqual([]);
    expect(loop).toHaveLength(8);
    for (let i = 0; i < 8; i += 2) expect(Math.hypot(loop![i]! - 0.5, loop![i + 1]! - 0.5)).toBeCloseTo(0.25);
  });

  it("goes round a lake in an island", () => {
    const loops = contour(
      grid([
        [0, 0, 0, 0, 0],
        [0, 1, 1, 1, 0],
        [0, 1, 0, 1, 0],
        [0, 1, 1, 1, 0],
        [0, 0, 0, 0, 0],
      ]),
      0.5,
    );
    expect(loops).toHaveLength(2);
    expect(encloses(loops, 0.5, 0.5)).toBe(false);
    expect(encloses(loops, 0.25, 0.5)).toBe(true);
  });

  it("ends at the edge of the grid, and is none above everything", () => {
    const all = grid([
      [1, 1],
      [1, 1],
    ]);
    const [loop] = contour(all, 0.5);
    expect(loop!.every((v) => v === 0 || v === 1)).toBe(true);
    expect(contour(all, 2)).toEqual([]);
  });

  it("encloses exactly the corners that are above, whatever the grid", () => {
    const value = fc.constantFrom(0, 0.2, 0.8, 1);
    fc.assert(
      fc.property(fc.array(fc.array(value, { minLength: 5, maxLength: 5 }), { minLength: 4, maxLength: 4 }), (rows) => {
        // Its border is below, so that no corner lies on a line.
        const bordered = [Array(7).fill(0), ...rows.map((row) => [0, ...row, 0]), Array(7).fill(0)];
        const loops = contour(grid(bordered), 0.5);
        for (const [r, row] of bordered.entries())
          for (const [c, v] of row.entries()) expect(encloses(loops, c / 6 + 1e-7, r / 5 + 1e-7)).toBe(v >= 0.5);
      }),
    );
  });
});
