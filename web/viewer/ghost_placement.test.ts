import { describe, expect, it } from "vitest";
import { createWorldPose, DEFAULT_PROPORTIONS, headingOf, placePose, restPose, worldFromLocal } from "../humanoid";
import { BESIDE, GhostPlacement, MAX_DRIFT } from "./ghost_placement";

/** A body at a position on the ground, facing `heading`. */
function bodyAt(x: number, z: number, heading = 0) {
  const pose = restPose();
  placePose(restPose(), heading, x, z, pose);
  const world = createWorldPose();
  worldFromLocal(DEFAULT_PROPORTIONS, pose, world);
  return { pose, world };
}

describe("ghost placement", () => {
  it("begins at the character's right, facing its way", () => {
    const placement = new GhostPlacement();
    placement.place(bodyAt(7, -3, 2).pose, DEFAULT_PROPORTIONS, bodyAt(0, 0, 0).world, true);
    expect(placement.pose[0]).toBeCloseTo(-BESIDE, 5);
    expect(placement.pose[2]).toBeCloseTo(0, 5);
    const world = createWorldPose();
    worldFromLocal(DEFAULT_PROPORTIONS, placement.pose, world);
    expect(headingOf(world, 9)).toBeCloseTo(0, 5);
  });

  it("walks its own path: it moves as far as the input does, wherever the character goes", () => {
    const placement = new GhostPlacement();
    placement.place(bodyAt(0, 0, 1).pose, DEFAULT_PROPORTIONS, bodyAt(0, 0).world, true);
    const before = placement.pose.slice();
    const again = placement.place(bodyAt(0.3, 0.4, 1).pose, DEFAULT_PROPORTIONS, bodyAt(0.1, 0.6).world, true);
    expect(again).toBe(false);
    expect(Math.hypot(placement.pose[0]! - before[0]!, placement.pose[2]! - before[2]!)).toBeCloseTo(0.5, 5);
  });

  it("is set beside the character anew when it has strayed", () => {
    const placement = new GhostPlacement();
    const input = bodyAt(0, 0).pose;
    expect(placement.place(input, DEFAULT_PROPORTIONS, bodyAt(0, 0).world, true)).toBe(false);
    expect(placement.place(input, DEFAULT_PROPORTIONS, bodyAt(0, 0.9 * MAX_DRIFT.along).world, true)).toBe(false);
    expect(placement.place(input, DEFAULT_PROPORTIONS, bodyAt(0, 5).world, true)).toBe(true);
    // The ghost lagged, so it gets a head start.
    expect(placement.pose[2]).toBeCloseTo(5 + MAX_DRIFT.along / 2, 5);
    expect(placement.pose[0]).toBeCloseTo(-BESIDE, 5);
  });

  it("is set anew before it walks into the character", () => {
    const placement = new GhostPlacement();
    const input = bodyAt(0, 0).pose;
    placement.place(input, DEFAULT_PROPORTIONS, bodyAt(0, 0).world, true);
    expect(placement.place(input, DEFAULT_PROPORTIONS, bodyAt(-0.6, 0).world, true)).toBe(true);
    expect(placement.pose[0]).toBeCloseTo(-0.6 - BESIDE, 5);
  });

  it("stays in the character's place when it lies over it", () => {
    const placement = new GhostPlacement();
    for (const step of [0, 1, 2]) {
      placement.place(bodyAt(3 * step, 1, step).pose, DEFAULT_PROPORTIONS, bodyAt(step, 2, -1).world, false);
      expect(placement.pose[0]).toBeCloseTo(step, 5);
      expect(placement.pose[2]).toBeCloseTo(2, 5);
    }
  });
});
