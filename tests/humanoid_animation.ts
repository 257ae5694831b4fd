/** A motion in which everything moves, for tests of animation export. */
import { DEFAULT_PROPORTIONS, JOINT, JOINTS, POSE_FLOATS, restPose } from "../web/humanoid";

/** A body larger than the mannequin's own, with longer shins. */
export const TALL_BODY: Float32Array = DEFAULT_PROPORTIONS.map((offset, i) => {
  const shin = Math.floor(i / 3) === JOINT.left_foot || Math.floor(i / 3) === JOINT.right_foot;
  return offset * (shin ? 1.25 : 1.15);
});

/** Returns two seconds in which the hips travel 1.5 m and every joint swings by up to 45°, at uneven times. */
export function movingAnimation(proportions: ArrayLike<number> = TALL_BODY) {
  const frames = 61;
  const poses = new Float32Array(frames * POSE_FLOATS);
  const times = new Float32Array(frames);
  for (let frame = 0; frame < frames; frame++) {
    const pose = restPose();
    pose.set([0.2 * Math.sin(frame / 9), 0.9 + 0.05 * Math.cos(frame / 4), frame / 40], 0);
    for (let joint = 0; joint < JOINTS; joint++) {
      const half = 0.39 * Math.sin(frame / 11 + joint);
      const axis = joint % 3;
      pose.set([0, 0, 0, Math.cos(half)], 3 + 4 * joint);
      pose[3 + 4 * joint + axis] = Math.sin(half);
    }
    poses.set(pose, frame * POSE_FLOATS);
    times[frame] = frame / 30 + 0.01 * Math.sin(frame);
  }
  times[0] = 0;
  return { name: "moving", proportions, poses, times };
}

/** Returns the pose of a frame. */
export function poseOf({ poses }: { poses: Float32Array }, frame: number): Float32Array {
  return poses.slice(frame * POSE_FLOATS, (frame + 1) * POSE_FLOATS);
}
