import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { BODIES, BODY_LIMITS, BodyLevels } from "./levels";

const worn = (levels: BodyLevels, body: (typeof BODIES)[number]) => [
  ...levels.walkers[body].subarray(0, levels.counts[body]),
];

describe("the bodies of a crowd", () => {
  it("are the finer the nearer, and those out of sight wear none", () => {
    const levels = new BodyLevels(5);
    levels.choose([300, 0, 100, 10, 250], BODY_LIMITS);
    expect([worn(levels, "near"), worn(levels, "middle"), worn(levels, "far")]).toEqual([[0, 4], [2], [3]]);
  });

  it("do not change to and fro at a limit", () => {
    const levels = new BodyLevels(1);
    levels.choose([61], BODY_LIMITS);
    for (const height of [59, 61, 58]) {
      levels.choose([height], BODY_LIMITS);
      expect(levels.counts.middle).toBe(1);
    }
    levels.choose([50], BODY_LIMITS);
    expect(levels.counts.middle).toBe(0);
    levels.choose([59], BODY_LIMITS);
    expect(levels.counts.middle).toBe(0);
  });

  it("are one for everybody in sight, and never more fine ones than may be", () => {
    fc.assert(
      fc.property(fc.array(fc.array(fc.nat(400), { minLength: 60, maxLength: 60 }), { maxLength: 5 }), (pictures) => {
        const levels = new BodyLevels(60);
        for (const heights of pictures) {
          levels.choose(heights, BODY_LIMITS);
          const all = BODIES.flatMap((body) => worn(levels, body)).toSorted((a, b) => a - b);
          expect(all).toEqual([...heights.keys()].filter((walker) => heights[walker]! > 0));
          expect(levels.counts.near).toBeLessThanOrEqual(BODY_LIMITS.near.count);
          expect(levels.counts.middle).toBeLessThanOrEqual(BODY_LIMITS.middle.count);
        }
      }),
    );
  });
});
