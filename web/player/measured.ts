/** Motions with joint positions computed in advance, so that they can be compared at any instant. */
import { createWorldPose, headingOf, JOINTS, POSE_FLOATS, worldFromLocal } from "../humanoid";

/** A motion as poses, `POSE_FLOATS` numbers per frame. */
export interface Posed {
  poses: Float32Array;
}

/** A motion with the positions of its joints. */
export type Measured<M extends Posed = Posed> = M & {
  frames: number;
  /** Joints in the world, frames × 21 × xyz, metres. */
  world: Float32Array;
  /** The joints with the hips over the origin and the heading along +Z. */
  local: Float32Array;
};

/** Number of a motion's frames. */
export function framesOf({ poses }: Posed): number {
  return poses.length / POSE_FLOATS;
}

/** Computes the joints of every frame. */
export function measure<M extends Posed>(motion: M, proportions: ArrayLike<number>): Measured<M> {
  const frames = framesOf(motion);
  const [world, local] = [new Float32Array(3 * JOINTS * frames), new Float32Array(3 * JOINTS * frames)];
  const joints = createWorldPose();
  let heading = 0;
  for (let f = 0; f < frames; f++) {
    worldFromLocal(proportions, motion.poses.subarray(f * POSE_FLOATS, (f + 1) * POSE_FLOATS), joints);
    const p = joints.positions;
    world.set(p, 3 * JOINTS * f);
    heading = headingOf(joints, heading);
    const [s, c] = [Math.sin(heading), Math.cos(heading)];
    for (let j = 0; j < JOINTS; j++) {
      const [x, z] = [p[3 * j]! - p[0]!, p[3 * j + 2]! - p[2]!];
      local.set([c * x - s * z, p[3 * j + 1]!, s * x + c * z], 3 * (JOINTS * f + j));
    }
  }
  return { ...motion, frames, world, local };
}

/**
 * Distance of a joint between a frame of one motion and a fractional frame of another, regardless of position and
 * heading, metres.
 */
export function jointDistance(a: Measured, frame: number, b: Measured, other: number, joint: number): number {
  const first = Math.min(Math.floor(other), b.frames - 1);
  const t = other - first;
  const [at, from, to] = [frame, first, Math.min(first + 1, b.frames - 1)].map((f) => 3 * (JOINTS * f + joint));
  const apart = (axis: number) => a.local[at! + axis]! - (1 - t) * b.local[from! + axis]! - t * b.local[to! + axis]!;
  return Math.hypot(apart(0), apart(1), apart(2));
}

/** Mean distance of the joints of two motions at a frame, regardless of position and heading, metres. */
export function meanDistance(a: Measured, b: Measured, frame: number, other = frame): number {
  let sum = 0;
  for (let joint = 0; joint < JOINTS; joint++) sum += jointDistance(a, frame, b, other, joint);
  return sum / JOINTS;
}

/** One buffer for each motion, reused from frame to frame. */
const buffers = new WeakMap<Posed, Float32Array>();

/**
 * A motion's pose at a fractional frame, `POSE_FLOATS` numbers that the next call for the motion overwrites.
 * Quaternions are interpolated linearly and not normalised: the mannequin normalises them.
 */
export function poseAt(motion: Posed, frame: number): Float32Array {
  const out = buffers.get(motion) ?? new Float32Array(POSE_FLOATS);
  buffers.set(motion, out);
  const last = framesOf(motion) - 1;
  const i = Math.min(Math.floor(frame), last);
  const j = Math.min(i + 1, last);
  const t = frame - Math.floor(frame);
  const a = motion.poses.subarray(i * POSE_FLOATS, (i + 1) * POSE_FLOATS);
  const b = motion.poses.subarray(j * POSE_FLOATS, (j + 1) * POSE_FLOATS);
  for (let k = 0; k < 3; k++) out[k] = a[k]! + (b[k]! - a[k]!) * t;
  for (let q = 3; q < POSE_FLOATS; q += 4) {
    const dot = a[q]! * b[q]! + a[q + 1]! * b[q + 1]! + a[q + 2]! * b[q + 2]! + a[q + 3]! * b[q + 3]!;
    const sign = dot < 0 ? -1 : 1;
    for (let k = q; k < q + 4; k++) out[k] = a[k]! * (1 - t) + sign * b[k]! * t;
  }
  return out;
}
