import { expect, test } from "vitest";
import { FrameCost } from "./frame_cost";

/** A frame that takes 0.13 ms, by a clock with a resolution of `stepMs`. */
function costBy(stepMs: number): number {
  let nowMs = 0;
  const cost = new FrameCost(() => Math.floor(nowMs / stepMs) * stepMs);
  for (let frame = 0; frame < 600; frame++) {
    cost.measure(1, () => {
      nowMs += 0.13;
    });
    nowMs += 16.1;
  }
  return cost.ms;
}

test("a frame's cost is told by a coarse clock as by a fine one", () => {
  expect(costBy(0.005)).toBeCloseTo(0.13, 2);
  expect(costBy(1)).toBeGreaterThan(0.08);
  expect(costBy(1)).toBeLessThan(0.18);
});

test("nothing measured costs nothing", () => {
  expect(new FrameCost().ms).toBe(0);
});

test("the cost of several frames is that of one", () => {
  let nowMs = 0;
  const cost = new FrameCost(() => nowMs);
  cost.measure(10, () => {
    nowMs += 5;
  });
  expect(cost.ms).toBe(0.5);
});
