/** An animation of the canonical humanoid, and the values of its tracks, shared by all writers of animations. */

import { POSE_FLOATS } from "../humanoid";

/** Poses over time on one body. */
export interface HumanoidAnimation {
  name: string;
  /** Bone offsets in the T-pose, 21 × xyz, metres; the first is the height of the hips. */
  proportions: ArrayLike<number>;
  /** `POSE_FLOATS` numbers per frame. */
  poses: Float32Array;
  /** Time of each frame, seconds, increasing; not necessarily evenly spaced. At least one frame. */
  times: Float32Array;
}

/** Positions of the hips, xyz per frame, metres. */
export function hipsPositions({ poses, times }: HumanoidAnimation): Float32Array {
  const positions = new Float32Array(3 * times.length);
  for (let f = 0; f < times.length; f++) positions.set(poses.subarray(f * POSE_FLOATS, f * POSE_FLOATS + 3), 3 * f);
  return positions;
}

/** Rotations of a joint relative to its parent, a unit quaternion xyzw per frame. */
export function jointRotations({ poses, times }: HumanoidAnimation, joint: number): Float32Array {
  const rotations = new Float32Array(4 * times.length);
  for (let f = 0; f < times.length; f++) {
    const at = f * POSE_FLOATS + 3 + 4 * joint;
    const length = Math.hypot(poses[at]!, poses[at + 1]!, poses[at + 2]!, poses[at + 3]!) || 1;
    for (let k = 0; k < 4; k++) rotations[4 * f + k] = poses[at + k]! / length;
  }
  return rotations;
}
