/**
 * Ground points of the soles of a motion, and their sliding speeds, as in the engine's `kinematics/soles.rs`. Pure
 * functions.
 */
import {
  createWorldPose,
  JOINT,
  POSE_FLOATS,
  quaternionAt,
  restPose,
  turned,
  type Vector,
  type WorldPose,
  worldFromLocal,
} from "../../humanoid";

export const SIDES = ["left", "right"] as const;
export type Side = (typeof SIDES)[number];

/** Distance of the heel behind the ankle, as a share of the ground distance from ankle to toes. */
const HEEL_SHARE = 0.35;
/** Height difference of heel and ball over which the pivot changes from one to the other, metres. */
const PIVOT_BLEND = 0.04;

/** Ground points of a foot, metres. */
export interface Sole {
  heel: Vector;
  ball: Vector;
}

/** Ground points of a foot in every frame. */
export function solesOf(poses: Float32Array, proportions: ArrayLike<number>, side: Side): Sole[] {
  const [foot, toes] = [JOINT[`${side}_foot`], JOINT[`${side}_toes`]];
  const world = createWorldPose();
  const rest = restPose();
  rest[1] = proportions[1]!;
  worldFromLocal(proportions, rest, world);
  const [footHeight, toeHeight] = [foot, toes].map((joint) => Math.max(0, world.positions[3 * joint + 1]!)) as [
    number,
    number,
  ];
  const heel: Vector = [-HEEL_SHARE * proportions[3 * toes]!, -footHeight, -HEEL_SHARE * proportions[3 * toes + 2]!];
  const ball: Vector = [0, -toeHeight, 0];
  return Array.from({ length: poses.length / POSE_FLOATS }, (_, frame) => {
    worldFromLocal(proportions, poses.subarray(frame * POSE_FLOATS, (frame + 1) * POSE_FLOATS), world);
    return { heel: pointOf(world, foot, heel), ball: pointOf(world, toes, ball) };
  });
}

function pointOf({ positions, rotations }: WorldPose, joint: number, offset: Vector): Vector {
  const [x, y, z] = turned(quaternionAt(rotations, joint), offset);
  return [positions[3 * joint]! + x, positions[3 * joint + 1]! + y, positions[3 * joint + 2]! + z];
}

/** Movement of a foot's pivot over the ground since the previous frame, metres: x and z. */
export function pivotTravel(now: Sole, before: Sole): readonly [x: number, z: number] {
  // The foot pivots on the lower of heel and ball.
  const onHeel = Math.min(1, Math.max(0, 0.5 + (now.ball[1] - now.heel[1]) / PIVOT_BLEND));
  const travel = (axis: 0 | 2) =>
    onHeel * (now.heel[axis] - before.heel[axis]) + (1 - onHeel) * (now.ball[axis] - before.ball[axis]);
  return [travel(0), travel(2)];
}
