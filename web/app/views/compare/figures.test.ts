import { describe, expect, it } from "vitest";
import { DEFAULT_PROPORTIONS, POSE_FLOATS, restPose } from "../../../humanoid";
import { measure } from "../../../player/measured";
import { figuresAt, type MeasuredMotion } from "./figures";

const FRAMES = 120;
const RATE_HZ = 60;

/** A T-pose that moves along z by `z(seconds)`, rotated by `heading` about +Y; the output is `slower` times as long. */
function sliding(z: (secs: number) => number, { heading = 0, slower = 1, planted = 1 } = {}): MeasuredMotion {
  const poses = new Float32Array(FRAMES * POSE_FLOATS);
  for (let f = 0; f < FRAMES; f++) {
    const pose = restPose();
    pose[2] = z(f / RATE_HZ);
    pose.set([0, Math.sin(heading / 2), 0, Math.cos(heading / 2)], 3);
    poses.set(pose, f * POSE_FLOATS);
  }
  const timeOut = Float32Array.from({ length: FRAMES }, (_, f) => (slower * f) / RATE_HZ);
  const feet = new Uint8Array(2 * FRAMES).fill(planted);
  return measure({ poses, timeOut, planted: feet, frameMs: 0.5 }, DEFAULT_PROPORTIONS);
}

const still = sliding(() => 0);

describe("the figures under a column", () => {
  it("take the difference of poses without place and heading", () => {
    const elsewhere = sliding((t) => 3 * t, { heading: 1 });
    expect(figuresAt(elsewhere, still, still, 60).difference).toBeCloseTo(0, 3);
    const bowed = sliding(() => 0);
    bowed.local[3 * 21 * 60 + 3 * 4 + 2]! += 0.21;
    expect(figuresAt(bowed, still, still, 60).difference).toBeCloseTo(1, 3);
    expect(figuresAt(still, still, still, 60).difference, "nothing to compare with itself").toBeUndefined();
  });

  it("say by how much the output is later", () => {
    expect(
      figuresAt(
        sliding(() => 0, { slower: 1.5 }),
        still,
        still,
        60,
      ).later,
    ).toBeCloseTo(500, 1);
  });

  it("measure the speed of planted feet, in output time", () => {
    expect(
      figuresAt(
        sliding((t) => 0.1 * t),
        still,
        undefined,
        60,
      ).skate,
    ).toBeCloseTo(10, 2);
    expect(
      figuresAt(
        sliding((t) => 0.1 * t, { slower: 2 }),
        still,
        undefined,
        60,
      ).skate,
    ).toBeCloseTo(5, 2);
    expect(
      figuresAt(
        sliding((t) => t, { planted: 0 }),
        still,
        undefined,
        60,
      ).skate,
    ).toBeUndefined();
  });

  it("give the jerk as a multiple of the input's, and the cost as it is", () => {
    const [one, two] = [sliding((t) => t ** 3), sliding((t) => 2 * t ** 3)];
    expect(figuresAt(two, one, undefined, 60).jerk).toBeCloseTo(2, 1);
    expect(figuresAt(one, still, undefined, 60).jerk, "an input without jerk").toBeUndefined();
    expect(figuresAt(one, still, undefined, 60).cost).toBe(0.5);
  });
});
