/** World transforms of joints from poses in flat arrays. */
import { JOINT, JOINTS, PARENTS } from "./layout";

/** Positions (21 × xyz, metres) and rotations (21 × xyzw) of all joints in the world. */
export interface WorldPose {
  positions: Float32Array;
  rotations: Float32Array;
}

/** A zeroed {@link WorldPose}, to be filled by {@link worldFromLocal}. */
export function createWorldPose(): WorldPose {
  return { positions: new Float32Array(3 * JOINTS), rotations: new Float32Array(4 * JOINTS) };
}

/**
 * Forward kinematics. Quaternions are normalised, so that a linearly interpolated pose stays rigid.
 *
 * @param proportions - 21 × xyz offsets, metres; the hips' entry is not used.
 * @param pose - {@link POSE_FLOATS} numbers.
 * @param out - Receives the joints in the world.
 */
export function worldFromLocal(proportions: ArrayLike<number>, pose: ArrayLike<number>, out: WorldPose): void {
  const p = out.positions;
  const q = out.rotations;
  for (let joint = 0; joint < JOINTS; joint++) {
    const source = 3 + 4 * joint;
    let x = pose[source]!;
    let y = pose[source + 1]!;
    let z = pose[source + 2]!;
    let w = pose[source + 3]!;
    const scale = 1 / (Math.hypot(x, y, z, w) || 1);
    x *= scale;
    y *= scale;
    z *= scale;
    w *= scale;
    const parent = PARENTS[joint]!;
    if (parent < 0) {
      p[0] = pose[0]!;
      p[1] = pose[1]!;
      p[2] = pose[2]!;
      q[0] = x;
      q[1] = y;
      q[2] = z;
      q[3] = w;
      continue;
    }
    const px = q[4 * parent]!;
    const py = q[4 * parent + 1]!;
    const pz = q[4 * parent + 2]!;
    const pw = q[4 * parent + 3]!;
    const ox = proportions[3 * joint]!;
    const oy = proportions[3 * joint + 1]!;
    const oz = proportions[3 * joint + 2]!;
    // v + 2w(u × v) + 2u × (u × v)
    const tx = 2 * (py * oz - pz * oy);
    const ty = 2 * (pz * ox - px * oz);
    const tz = 2 * (px * oy - py * ox);
    p[3 * joint] = p[3 * parent]! + ox + pw * tx + py * tz - pz * ty;
    p[3 * joint + 1] = p[3 * parent + 1]! + oy + pw * ty + pz * tx - px * tz;
    p[3 * joint + 2] = p[3 * parent + 2]! + oz + pw * tz + px * ty - py * tx;
    q[4 * joint] = pw * x + px * w + py * z - pz * y;
    q[4 * joint + 1] = pw * y - px * z + py * w + pz * x;
    q[4 * joint + 2] = pw * z + px * y - py * x + pz * w;
    q[4 * joint + 3] = pw * w - px * x - py * y - pz * z;
  }
}

/**
 * Heading about +Y in radians, 0 facing +Z: perpendicular to the mean of the across-vectors of hips and shoulders, as
 * in `pose_vector.rs`; `fallback` if that has no direction on the ground.
 */
export function headingOf(world: WorldPose, fallback: number): number {
  const p = world.positions;
  const across = (axis: number) =>
    p[3 * JOINT.left_upper_leg + axis]! -
    p[3 * JOINT.right_upper_leg + axis]! +
    p[3 * JOINT.left_upper_arm + axis]! -
    p[3 * JOINT.right_upper_arm + axis]!;
  const x = -across(2);
  const z = across(0);
  return x * x + z * z > 1e-8 ? Math.atan2(x, z) : fallback;
}
