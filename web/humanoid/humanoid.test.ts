import { readFileSync } from "node:fs";
import fc from "fast-check";
import { Quaternion, Vector3 } from "three";
import { describe, expect, it } from "vitest";
import {
  createWorldPose,
  DEFAULT_PROPORTIONS,
  headingOf,
  hipsTurn,
  isPose,
  JOINT,
  JOINTS,
  PARENTS,
  POSE_FLOATS,
  placePose,
  ROLES,
  restPose,
  worldFromLocal,
} from ".";

const rust = readFileSync(new URL("../../rust/strut-core/src/humanoid.rs", import.meta.url), "utf8");

/** Any pose with unit quaternions near the origin. */
const anyPose = fc
  .array(fc.double({ min: -1, max: 1, noNaN: true }), { minLength: POSE_FLOATS, maxLength: POSE_FLOATS })
  .map((numbers) => {
    const pose = Float32Array.from(numbers);
    for (let i = 3; i < POSE_FLOATS; i += 4) {
      const q = new Quaternion(pose[i], pose[i + 1], pose[i + 2], pose[i + 3]! + 1.5).normalize();
      q.toArray(pose, i);
    }
    return pose;
  });

describe("humanoid", () => {
  it("has the core's joints in the core's order", () => {
    const names = [...rust.matchAll(/R::\w+ => "(\w+)"/g)].map((match) => match[1]);
    expect(ROLES).toEqual(names);
    const parents = rust.match(/PARENTS: \[usize; JOINTS\] = \[NO_PARENT, ([\d, ]+)\]/)?.[1];
    expect(PARENTS.slice(1)).toEqual(parents?.split(", ").map(Number));
  });

  it("stands with its ankles at their height", () => {
    const world = createWorldPose();
    worldFromLocal(DEFAULT_PROPORTIONS, restPose(), world);
    expect(world.positions[3 * JOINT.left_foot + 1]).toBeCloseTo(0.118, 5);
    expect(world.positions[3 * JOINT.left_foot]).toBeCloseTo(0.084, 5);
    expect(world.positions[3 * JOINT.right_hand]).toBeCloseTo(-(0.03 + 0.128 + 0.272 + 0.242), 5);
  });

  it("agrees with three.js about forward kinematics", () => {
    fc.assert(
      fc.property(anyPose, (pose) => {
        const world = createWorldPose();
        worldFromLocal(DEFAULT_PROPORTIONS, pose, world);
        const rotations: Quaternion[] = [];
        const positions: Vector3[] = [];
        for (let joint = 0; joint < JOINTS; joint++) {
          const local = new Quaternion().fromArray(pose, 3 + 4 * joint);
          const parent = PARENTS[joint]!;
          const offset = new Vector3(...DEFAULT_PROPORTIONS.slice(3 * joint, 3 * joint + 3));
          rotations.push(parent < 0 ? local : rotations[parent]!.clone().multiply(local));
          positions.push(
            parent < 0
              ? new Vector3(pose[0], pose[1], pose[2])
              : offset.applyQuaternion(rotations[parent]!).add(positions[parent]!),
          );
          for (const [axis, value] of positions[joint]!.toArray().entries())
            expect(world.positions[3 * joint + axis]).toBeCloseTo(value, 4);
          expect(Math.abs(new Quaternion().fromArray(world.rotations, 4 * joint).dot(rotations[joint]!))).toBeCloseTo(
            1,
            4,
          );
        }
      }),
      { numRuns: 30 },
    );
  });

  it("placing a pose turns and moves every joint rigidly", () => {
    fc.assert(
      fc.property(anyPose, fc.double({ min: -3, max: 3, noNaN: true }), (pose, turn) => {
        const placed = new Float32Array(POSE_FLOATS);
        placePose(pose, turn, 2, -1, placed);
        const [before, after] = [createWorldPose(), createWorldPose()];
        worldFromLocal(DEFAULT_PROPORTIONS, pose, before);
        worldFromLocal(DEFAULT_PROPORTIONS, placed, after);
        for (let joint = 0; joint < JOINTS; joint++) {
          const expected = new Vector3()
            .fromArray(before.positions, 3 * joint)
            .applyAxisAngle(new Vector3(0, 1, 0), turn);
          expect(after.positions[3 * joint]).toBeCloseTo(expected.x + 2, 4);
          expect(after.positions[3 * joint + 1]).toBeCloseTo(expected.y, 4);
          expect(after.positions[3 * joint + 2]).toBeCloseTo(expected.z - 1, 4);
        }
      }),
      { numRuns: 30 },
    );
  });

  it("knows where a body faces", () => {
    for (const heading of [-2, 0, 0.5, 3]) {
      const pose = new Float32Array(POSE_FLOATS);
      placePose(restPose(), heading, 0, 0, pose);
      const world = createWorldPose();
      worldFromLocal(DEFAULT_PROPORTIONS, pose, world);
      expect(headingOf(world, 9)).toBeCloseTo(heading, 5);
      expect(hipsTurn(pose)).toBeCloseTo(heading, 5);
    }
    expect(headingOf(createWorldPose(), 9)).toBe(9);
  });

  it("refuses what is not a pose", () => {
    expect(isPose(restPose())).toBe(true);
    expect(isPose(restPose().fill(Number.NaN, 40, 41))).toBe(false);
    expect(isPose(new Float32Array(3))).toBe(false);
  });
});
