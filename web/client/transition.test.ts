import { describe, expect, it } from "vitest";
import { exp, JOINT, restPose } from "../humanoid";
import { Transition } from "./transition";

/** A pose with the root at a height and the left knee bent by an angle. */
function pose(height: number, knee: number): Float32Array {
  const made = restPose();
  made[1] = height;
  made.set(exp([knee, 0, 0]), 3 + 4 * JOINT.left_lower_leg);
  return made;
}

const kneeOf = (of: Float32Array) => {
  const at = 3 + 4 * JOINT.left_lower_leg;
  return 2 * Math.atan2(of[at]!, of[at + 3]!);
};

describe("a transition", () => {
  const transition = Transition.between(pose(0.95, 0.5), pose(0.9, 0.2));

  it("begins with the pose that was shown", () => {
    const shown = pose(0.9, 0.2);
    expect(transition.apply(shown, 0)).toBe(true);
    expect(shown[1]).toBeCloseTo(0.95, 6);
    expect(kneeOf(shown)).toBeCloseTo(0.5, 5);
  });

  it("halves the difference, whatever the pose is by then", () => {
    const shown = pose(1, 0.7);
    expect(transition.apply(shown, 0.08)).toBe(true);
    expect(shown[1]).toBeCloseTo(1.025, 6);
    expect(kneeOf(shown)).toBeCloseTo(0.85, 5);
  });

  it("ends", () => {
    const shown = pose(1, 0.7);
    expect(transition.apply(shown, 1)).toBe(false);
    expect(shown).toEqual(pose(1, 0.7));
  });
});
