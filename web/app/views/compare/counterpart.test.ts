import { describe, expect, it } from "vitest";
import type { Performed } from "../../../client/protocol";
import { restPose } from "../../../humanoid";
import { mixed, shares } from "./counterpart";

/** A single frame in which the hips are rotated by `degrees` about +Y. */
function turned(degrees: number, secs: number, sign = 1): Performed {
  const pose = restPose();
  const half = (degrees * Math.PI) / 360;
  pose.set([0, sign * Math.sin(half), 0, sign * Math.cos(half)], 3);
  return {
    poses: Float32Array.from(pose),
    timeOut: Float32Array.of(secs),
    planted: Uint8Array.of(secs > 1 ? 1 : 0, 0),
  };
}

describe("the counterpart of a mixture", () => {
  it("gives the neutral style what is missing to 1", () => {
    expect(shares({ old: 0.25 }, ["neutral", "old", "proud"], "neutral")).toEqual([
      { style: "neutral", weight: 0.75 },
      { style: "old", weight: 0.25 },
    ]);
    expect(shares({ old: 1 }, ["neutral", "old"], "neutral")).toEqual([{ style: "old", weight: 1 }]);
    expect(shares({ old: 1.5 }, ["neutral", "old"], "neutral")[0]).toEqual({ style: "neutral", weight: -0.5 });
  });

  it("is the mean of the performances, whichever sign their quaternions have", () => {
    const mean = mixed([
      { ...turned(0, 1), weight: 0.5 },
      { ...turned(60, 2, -1), weight: 0.5 },
    ]);
    expect(2 * Math.acos(mean.poses[6]!) * (180 / Math.PI)).toBeCloseTo(30, 3);
    expect(mean.timeOut[0]).toBeCloseTo(1.5, 6);
    expect([...mean.planted], "of the first of two equals").toEqual([0, 0]);
  });

  it("is one performance where there is one style", () => {
    const only = turned(20, 1);
    expect(mixed([{ ...only, weight: 1 }]).poses).toBe(only.poses);
  });
});
