/** The pose of a motion between two of its frames. */
import { POSE_FLOATS } from "../../../humanoid";
import type { MeasuredMotion } from "./figures";

/** One buffer for each motion, reused from frame to frame. */
const buffers = new WeakMap<MeasuredMotion, Float32Array>();

/**
 * A motion's pose at a fractional frame, `POSE_FLOATS` numbers that the next call for the motion overwrites. Quaternions are
 * interpolated linearly and not normalised: the mannequin does that.
 */
export function poseAt(motion: MeasuredMotion, frame: number): Float32Array {
  const out = buffers.get(motion) ?? new Float32Array(POSE_FLOATS);
  buffers.set(motion, out);
  const i = Math.min(Math.floor(frame), motion.frames - 1);
  const j = Math.min(i + 1, motion.frames - 1);
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
