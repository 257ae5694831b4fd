import { expect, test } from "vitest";
import { distanceTo, pathOf } from "./path_tool";

const spots = (path: Float32Array) =>
  Array.from({ length: path.length / 2 }, (_, i) => [path[2 * i]!, path[2 * i + 1]!]);

test("a click is a straight way to a place", () => {
  const path = spots(pathOf({ x: 0, z: 0 }, [{ x: 0, z: 1 }]));
  expect(path[0]).toEqual([0, 0]);
  expect(path.at(-1)).toEqual([0, 1]);
  expect(path.every(([x]) => x === 0)).toBe(true);
});

test("a stroke is evenly spaced, and led to from where the character is", () => {
  const stroke = [
    { x: 2, z: 0 },
    { x: 2, z: 0.01 },
    { x: 2, z: 3 },
  ];
  const path = spots(pathOf({ x: 0, z: 0 }, stroke));
  expect(path[0]).toEqual([0, 0]);
  expect(path.at(-1)).toEqual([2, 3]);
  const steps = path.slice(1).map(([x, z], i) => Math.hypot(x! - path[i]![0]!, z! - path[i]![1]!));
  expect(Math.max(...steps)).toBeLessThan(0.11);
});

test("the tremble of a hand is smoothed, and its ends stay", () => {
  const stroke = Array.from({ length: 60 }, (_, i) => ({ x: i % 2 ? 0.03 : -0.03, z: i / 10 }));
  const path = spots(pathOf({ x: -0.03, z: 0 }, stroke));
  expect(path[0]![0]).toBeCloseTo(-0.03, 6);
  const inner = path.slice(3, -3).map(([x]) => Math.abs(x!));
  expect(Math.max(...inner)).toBeLessThan(0.012);
});

test("distances are those to the nearest piece", () => {
  const path = Float32Array.of(0, 0, 0, 2, 2, 2);
  expect(distanceTo(path, { x: 0.5, z: 1 })).toBeCloseTo(0.5, 6);
  expect(distanceTo(path, { x: 3, z: 2 })).toBeCloseTo(1, 6);
  expect(pathOf({ x: 0, z: 0 }, []).length).toBe(0);
});
