import { describe, expect, it } from "vitest";
import { ease } from "./orbit_camera";

describe("the glide's easing", () => {
  it("begins and ends still, and never turns back", () => {
    expect(ease(0)).toBeCloseTo(0, 5);
    expect(ease(1)).toBeCloseTo(1, 5);
    let last = 0;
    for (let t = 0.01; t <= 1; t += 0.01) {
      expect(ease(t)).toBeGreaterThanOrEqual(last);
      last = ease(t);
    }
  });

  it("is cubic-bezier(.2, 0, 0, 1): most of the way in the first half", () => {
    // At parameter s = 0.5 the curve is at time 0.2, way 0.5.
    expect(ease(0.2)).toBeCloseTo(0.5, 3);
  });
});
