/** Chooses the first of several motions in a file to show: the one that looks most like walking. */
import { JOINT, POSE_FLOATS } from "../humanoid";
import type { CharacterMotion } from "./types";

/** Names of walks, and of walks in other directions than forwards. */
const WALK = /walk/i;
const OTHER_WAY = /back|left|right|strafe|side|turn|crouch|start|stop|injured|drunk/i;

/** Index of the motion that walks most: by its name, otherwise by how far its legs swing. −1 if there is none. */
export function mostWalking(motions: readonly CharacterMotion[]): number {
  const walks = motions.flatMap(({ name }, i) => (WALK.test(name) ? [i] : []));
  if (walks.length > 0) return walks.find((i) => !OTHER_WAY.test(motions[i]!.name)) ?? walks[0]!;
  if (motions.length < 2) return motions.length - 1;
  const swings = motions.map(swingOf);
  return swings.indexOf(Math.max(...swings));
}

/** Mean angle between the thighs, radians. */
function swingOf(motion: CharacterMotion): number {
  const poses = motion.poses(motion.proportions);
  const [left, right] = [3 + 4 * JOINT.left_upper_leg, 3 + 4 * JOINT.right_upper_leg];
  let sum = 0;
  for (let frame = 0; frame < poses.length; frame += POSE_FLOATS) {
    let dot = 0;
    for (let k = 0; k < 4; k++) dot += poses[frame + left + k]! * poses[frame + right + k]!;
    sum += 2 * Math.acos(Math.min(1, Math.abs(dot)));
  }
  return sum / Math.max(1, motion.frames);
}
