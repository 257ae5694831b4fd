import { describe, expect, it } from "vitest";
import { STYLE_HALF_LIFE_SECS } from "../client/protocol";
import { approach } from "./smoothing";

describe("smoothing of weights", () => {
  it("goes half the way in its half-life, however the time is cut", () => {
    const whole = approach({ proud: 0, old: 1 }, { proud: 1 }, STYLE_HALF_LIFE_SECS);
    expect(whole.proud).toBeCloseTo(0.5);
    expect(whole.old).toBeCloseTo(0.5);
    let cut = approach({ proud: 0 }, { proud: 1 }, STYLE_HALF_LIFE_SECS / 2);
    cut = approach(cut, { proud: 1 }, STYLE_HALF_LIFE_SECS / 2);
    expect(cut.proud).toBeCloseTo(0.5);
  });

  it("arrives, and forgets the styles that are gone", () => {
    const target = { proud: 0.3 };
    expect(approach({ proud: 0.3001, old: 0.0005 }, target, 0.016)).toBe(target);
    expect(approach({ old: 1 }, target, 10)).toBe(target);
  });

  it("knows the weight of a style by any name", () => {
    const half = approach({}, { constructor: 1 }, STYLE_HALF_LIFE_SECS);
    expect(half.constructor).toBeCloseTo(0.5);
    expect(Object.keys(approach({ toString: 1 }, { old: 1 }, 0.01))).toEqual(["toString", "old"]);
  });
});
