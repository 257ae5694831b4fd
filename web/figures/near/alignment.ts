/** The best alignment of one pose to another on the ground: T of Eq. 1 for a window of one frame. Pure functions. */
import { createWorldPose, JOINT, POSE_FLOATS, placePose, type Role, worldFromLocal } from "../../humanoid";

/**
 * w of each joint of the metric, by size and visibility; their sum is {@link WEIGHT}. `near.test.ts` checks them
 * against the engine.
 */
export const WEIGHTS: Readonly<Partial<Record<Role, number>>> = {
  left_upper_leg: 1,
  right_upper_leg: 1,
  left_lower_leg: 1.5,
  right_lower_leg: 1.5,
  left_foot: 1.5,
  right_foot: 1.5,
  left_toes: 0.5,
  right_toes: 0.5,
  hips: 1,
  chest: 1.5,
  neck: 0.5,
  head: 1.5,
  left_shoulder: 0.25,
  right_shoulder: 0.25,
  left_upper_arm: 1,
  right_upper_arm: 1,
  left_lower_arm: 1,
  right_lower_arm: 1,
  left_hand: 1,
  right_hand: 1,
};

/** Joints of the metric with their weights. */
const POINTS = Object.entries(WEIGHTS).map(([role, weight]) => [JOINT[role as Role], weight] as const);
export const WEIGHT = POINTS.reduce((sum, [, weight]) => sum + weight, 0);

/** A pose aligned to another one. */
export interface Aligned {
  pose: Float32Array;
  /** Its joints in the world, metres. */
  positions: Float32Array;
  /** θ, radians, and the position of the pose's origin after alignment, metres. */
  turn: number;
  x: number;
  z: number;
  /** Mean squares of the remaining differences in height and on the ground, m²: their sum is D. */
  heights: number;
  ground: number;
}

/** Joints of a pose in the world. */
export function positionsOf(pose: ArrayLike<number>, proportions: ArrayLike<number>): Float32Array {
  const world = createWorldPose();
  worldFromLocal(proportions, pose, world);
  return Float32Array.from(world.positions);
}

/** A pose, rotated and moved over the ground so that it is nearest to given joints. */
export function align(to: ArrayLike<number>, pose: ArrayLike<number>, proportions: ArrayLike<number>): Aligned {
  const from = positionsOf(pose, proportions);
  const [a, b] = [centreOf(to), centreOf(from)];
  let [along, across] = [0, 0];
  for (const [joint, weight] of POINTS) {
    const [px, pz] = [to[3 * joint]! - a.x, to[3 * joint + 2]! - a.z];
    const [qx, qz] = [from[3 * joint]! - b.x, from[3 * joint + 2]! - b.z];
    along += weight * (px * qx + pz * qz);
    across += weight * (px * qz - pz * qx);
  }
  const turn = Math.atan2(across, along);
  const [cos, sin] = [Math.cos(turn), Math.sin(turn)];
  const [x, z] = [a.x - cos * b.x - sin * b.z, a.z - cos * b.z + sin * b.x];
  const moved = new Float32Array(POSE_FLOATS);
  placePose(pose, turn, x, z, moved);
  const positions = positionsOf(moved, proportions);
  const meanSquare = (axes: readonly number[]) => {
    const square = (joint: number) =>
      axes.reduce((sum, i) => sum + (to[3 * joint + i]! - positions[3 * joint + i]!) ** 2, 0);
    return POINTS.reduce((sum, [joint, weight]) => sum + weight * square(joint), 0) / WEIGHT;
  };
  return { pose: moved, positions, turn, x, z, heights: meanSquare([1]), ground: meanSquare([0, 2]) };
}

/** The weighted mean of joints on the ground. */
function centreOf(positions: ArrayLike<number>): { x: number; z: number } {
  const mean = (axis: number) =>
    POINTS.reduce((sum, [joint, weight]) => sum + weight * positions[3 * joint + axis]!, 0) / WEIGHT;
  return { x: mean(0), z: mean(2) };
}
