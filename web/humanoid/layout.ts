/**
 * The layout of poses in flat arrays: joint order, parents, the mannequin's own proportions. It mirrors
 * `rust/strut-core/src/humanoid.rs`, whose doc comments define the frames: in the T-pose facing +Z every joint's frame is
 * aligned with the world, and left is +X.
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

/** Numbers per joint of a crowd: position x y z and 0, rotation x y z w, both in the world. */
export const CROWD_JOINT_FLOATS = 8;
/** Numbers per walker of a crowd. */
export const CROWD_WALKER_FLOATS = JOINTS * CROWD_JOINT_FLOATS;

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

/** Whether an array is a pose of finite numbers. */
export function isPose(pose: ArrayLike<number>): boolean {
  if (pose.length !== POSE_FLOATS) return false;
  for (let i = 0; i < POSE_FLOATS; i++) if (!Number.isFinite(pose[i])) return false;
  return true;
}
