import { describe, expect, it } from "vitest";
import { createWorldPose, DEFAULT_PROPORTIONS, JOINT, restPose, worldFromLocal } from "../../../humanoid";
import { NAMED_AXES } from "./axes";
import { dimensionOf, type Point } from "./dimensions";

const LEFT: Point = [0, 0, -1];

function rest() {
  const world = createWorldPose();
  worldFromLocal(DEFAULT_PROPORTIONS, restPose(), world);
  return world;
}

const length = ([a, b]: readonly [Point, Point]) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

describe("a dimension line", () => {
  it("is as long as what it measures", () => {
    const world = rest();
    // The left hand is 40 cm in front of its shoulder, the left foot 30 cm in front of the right one and 5 cm higher.
    world.positions[3 * JOINT.left_hand + 2] = world.positions[3 * JOINT.left_upper_arm + 2]! + 0.4;
    world.positions[3 * JOINT.left_foot + 2]! += 0.3;
    world.positions[3 * JOINT.left_foot + 1]! += 0.05;
    const measured = (axis: string) => length(dimensionOf(axis, world, LEFT)!.line);
    expect(measured("hips_height")).toBeCloseTo(0.941);
    expect(measured("reach_left")).toBeCloseTo(0.4);
    expect(measured("foot_separation")).toBeCloseTo(0.3);
    expect(measured("foot_height_difference")).toBeCloseTo(0.05);
    expect(measured("torso_lean")).toBeLessThan(0.01);
    expect(measured("hand_height_right")).toBeCloseTo(world.positions[3 * JOINT.right_hand + 1]!);
  });

  it("is there for every measure that has a name, and for no expression", () => {
    const lengths = NAMED_AXES.filter((axis) => !axis.startsWith("knee") && axis !== "speed");
    for (const axis of lengths) expect(dimensionOf(axis, rest(), LEFT), axis).toBeDefined();
    expect(dimensionOf("hand_l.y - hips.y", rest(), LEFT)).toBeUndefined();
  });
});
