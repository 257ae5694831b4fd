/**
 * The canonical humanoid as the viewer sees it: joint order, parents, the mannequin's own proportions and forward
 * kinematics over flat arrays. Mirrors `rust/strut-core/src/humanoid.rs`, whose doc comments define the frames: in the
 * T-pose facing +Z every joint's frame is aligned with the world, and left is +X.
 */

/** Names of the joints in canonical order; a joint's index is its position here. */
export const ROLES = [
  "hips",
  "spine",
  "chest",
  "neck",
  "head",
  "left_shoulder",
  "left_upper_arm",
  "left_lower_arm",
  "left_hand",
  "right_shoulder",
  "right_upper_arm",
  "right_lower_arm",
  "right_hand",
  "left_upper_leg",
  "left_lower_leg",
  "left_foot",
  "left_toes",
  "right_upper_leg",
  "right_lower_leg",
  "right_foot",
  "right_toes",
] as const;

/** Name of a joint. */
export type Role = (typeof ROLES)[number];

/** Number of joints. */
export const JOINTS = ROLES.length;

/** Numbers of one pose: root x y z in metres, then the local quaternion x y z w of every joint. */
export const POSE_FLOATS = 3 + 4 * JOINTS;

/** Index of every joint by its name. */
export const JOINT = Object.fromEntries(ROLES.map((role, index) => [role, index])) as Record<Role, number>;

/** Parent of each joint, parents first; −1 for the hips. */
export const PARENTS: readonly number[] = [-1, 0, 1, 2, 3, 2, 5, 6, 7, 2, 9, 10, 11, 0, 13, 14, 15, 0, 17, 18, 19];

const ARM = (side: number) => [0.03 * side, 0.143, -0.004, 0.128 * side, 0, 0, 0.272 * side, 0, 0, 0.242 * side, 0, 0];
const LEG = (side: number) => [0.084 * side, -0.022, 0, 0, -0.391, 0, 0, -0.41, 0, 0, -0.084, 0.128];

/**
 * The mannequin's own bone offsets, metres: position of each joint in its parent's frame in the T-pose, 21 × xyz; the
 * first is the height of the hips above the soles.
 */
export const DEFAULT_PROPORTIONS: Readonly<Float32Array> = new Float32Array([
  ...[0, 0.941, 0, 0, 0.172, 0, 0, 0.108, -0.004, 0, 0.182, 0, 0, 0.085, 0.006],
  ...ARM(1),
  ...ARM(-1),
  ...LEG(1),
  ...LEG(-1),
]);

/** The T-pose at the mannequin's own height. */
export function restPose(): Float32Array {
  const pose = new Float32Array(POSE_FLOATS);
  pose[1] = DEFAULT_PROPORTIONS[1]!;
  for (let joint = 0; joint < JOINTS; joint++) pose[6 + 4 * joint] = 1;
  return pose;
}

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
 * Forward kinematics. Quaternions are normalised on the way, so that a pose that was interpolated linearly stays rigid.
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
 * in `pose_vector.rs`; `fallback` where that has no direction on the ground.
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

/** Turn of the hips about +Y, radians: the twist of pose number `frame` in a flat array of poses. */
export function hipsTurn(poses: ArrayLike<number>, frame = 0): number {
  const offset = frame * POSE_FLOATS;
  return 2 * Math.atan2(poses[offset + 4]!, poses[offset + 6]!);
}

/** Whether an array is a pose of finite numbers. */
export function isPose(pose: ArrayLike<number>): boolean {
  if (pose.length !== POSE_FLOATS) return false;
  for (let i = 0; i < POSE_FLOATS; i++) if (!Number.isFinite(pose[i])) return false;
  return true;
}

/** Copies a pose, turned by `turn` radians about +Y and then moved by x and z metres over the ground. */
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
