/** Rotates and moves whole poses over the ground. */
import { POSE_FLOATS } from "./layout";

/** Rotation of the hips about +Y, radians: the twist of pose `frame` in a flat array of poses. */
export function hipsTurn(poses: ArrayLike<number>, frame = 0): number {
  const offset = frame * POSE_FLOATS;
  return 2 * Math.atan2(poses[offset + 4]!, poses[offset + 6]!);
}

/** Copies a pose, rotated by `turn` radians about +Y and then moved by x and z metres over the ground. */
export function placePose(pose: ArrayLike<number>, turn: number, x: number, z: number, out: Float32Array): void {
  for (let i = 0; i < POSE_FLOATS; i++) out[i] = pose[i]!;
  const c = Math.cos(turn);
  const s = Math.sin(turn);
  out[0] = c * pose[0]! + s * pose[2]! + x;
  out[2] = c * pose[2]! - s * pose[0]! + z;
  const ch = Math.cos(turn / 2);
  const sh = Math.sin(turn / 2);
  const [qx, qy, qz, qw] = [pose[3]!, pose[4]!, pose[5]!, pose[6]!];
  out[3] = ch * qx + sh * qz;
  out[4] = ch * qy + sh * qw;
  out[5] = ch * qz - sh * qx;
  out[6] = ch * qw - sh * qy;
}
