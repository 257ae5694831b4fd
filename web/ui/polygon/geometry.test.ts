import fc from "fast-check";
import { describe, expect, it } from "vitest";
import {
  barycentric,
  circleVertices,
  distance,
  isInside,
  meanValue,
  nearestInside,
  type Point,
  pointOf,
  quarterIsolines,
  weightsAt,
} from "./geometry";

const coordinate = fc.double({ min: -200, max: 200, noNaN: true });
const anyPoint = fc.record({ x: coordinate, y: coordinate });
const sum = (weights: number[]) => weights.reduce((a, b) => a + b, 0);
const close = (a: Point, b: Point) => expect(distance(a, b)).toBeLessThan(1e-3);

describe("vertices on the circle", () => {
  it("start at the top and go clockwise", () => {
    const [top, right, bottom, left] = circleVertices(4, 92) as [Point, Point, Point, Point];
    close(top, { x: 0, y: -92 });
    close(right, { x: 92, y: 0 });
    close(bottom, { x: 0, y: 92 });
    close(left, { x: -92, y: 0 });
  });
});

describe("weights ↔ points", () => {
  const triangle = circleVertices(3, 92) as [Point, Point, Point];

  it("are the inverse of each other in a triangle, also outside it", () => {
    fc.assert(
      fc.property(anyPoint, (p) => {
        const weights = barycentric(p, ...triangle);
        expect(sum(weights)).toBeCloseTo(1, 9);
        close(pointOf(weights, triangle), p);
      }),
    );
  });

  it("are the inverse of each other inside polygons of 4 to 12 corners, and never negative there", () => {
    fc.assert(
      fc.property(fc.integer({ min: 4, max: 12 }), anyPoint, (n, raw) => {
        const corners = circleVertices(n, 92);
        const p = nearestInside(raw, corners);
        const weights = meanValue(p, corners);
        expect(sum(weights)).toBeCloseTo(1, 6);
        for (const w of weights) expect(w).toBeGreaterThan(-1e-6);
        close(pointOf(weights, corners), p);
      }),
    );
  });

  it("give a corner all of itself", () => {
    for (const n of [1, 2, 3, 8]) {
      const corners = circleVertices(n, 92);
      for (const [i, corner] of corners.entries()) {
        weightsAt(corner, corners).forEach((w, k) => {
          expect(w).toBeCloseTo(k === i ? 1 : 0, 6);
        });
      }
    }
  });

  it("change smoothly towards an edge", () => {
    const corners = circleVertices(8, 92);
    const onEdge = pointOf([0.5, 0.5], corners);
    const near = { x: onEdge.x * 0.9999, y: onEdge.y * 0.9999 };
    const [edge, inside] = [meanValue(onEdge, corners), meanValue(near, corners)];
    edge.forEach((w, i) => {
      expect(Math.abs(w - inside[i]!)).toBeLessThan(2e-3);
    });
  });
});

describe("nearest point", () => {
  it("is the point itself inside, on the border outside, and no corner is nearer", () => {
    fc.assert(
      fc.property(fc.integer({ min: 1, max: 9 }), anyPoint, (n, p) => {
        const corners = circleVertices(n, 92);
        const q = nearestInside(p, corners);
        for (const corner of corners) expect(distance(p, q)).toBeLessThanOrEqual(distance(p, corner) + 1e-9);
        if (n > 2 && isInside(p, corners)) expect(q).toEqual(p);
        close(nearestInside(q, corners), q);
      }),
    );
  });

  it("accepts both orientations", () => {
    const corners = circleVertices(5, 92);
    expect(isInside({ x: 1, y: 2 }, corners)).toBe(true);
    expect(isInside({ x: 1, y: 2 }, [...corners].reverse())).toBe(true);
    expect(isInside({ x: 91, y: 0 }, circleVertices(4, 92))).toBe(true);
    expect(isInside({ x: 80, y: 80 }, circleVertices(4, 92))).toBe(false);
  });
});

describe("quarter isolines", () => {
  it("join points of equal weight", () => {
    const [a, b, c] = circleVertices(3, 92) as [Point, Point, Point];
    const lines = quarterIsolines(a, b, c);
    expect(lines).toHaveLength(9);
    const [p, q] = lines[0]!;
    expect(barycentric(p, a, b, c)[0]).toBeCloseTo(0.75);
    expect(barycentric(q, a, b, c)[0]).toBeCloseTo(0.75);
  });
});
