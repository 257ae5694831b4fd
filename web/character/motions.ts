/**
 * The motions in a file as poses, through the same binding as the poses that are performed (`shared/spec/embedding.md`
 * 5.6).
 */
import { type AnimationClip, AnimationMixer, Matrix4, type Object3D, Quaternion, Vector3 } from "three";
import { StrutError } from "../engine/errors";
import { bvhText } from "../formats/bvh";
import { POSE_FLOATS } from "../humanoid";
import type { Bound } from "./bind";
import type { CharacterMotion, Origin } from "./types";

/** Frames per second at which clips are sampled. */
const RATE_HZ = 60;
/** Longest clip, seconds; longer ones are cut. */
const MAX_SECS = 600;
/** Maximum number of values that are passed to the engine at once. */
const MAX_FLOATS = 1 << 21;

/**
 * The motions of a file.
 * @param proportions the body of its bones
 * @param on runs a conversion with the bones bound
 */
export function motionsOf(
  { object, clips }: Origin,
  proportions: Float32Array,
  on: <T>(convert: (bound: Bound) => T) => T,
): CharacterMotion[] {
  return clips.map((clip) => {
    const durationSecs = Math.min(Math.max(clip.duration || 0, 0), MAX_SECS);
    const frames = Math.floor(durationSecs * RATE_HZ + 1e-6) + 1;
    const poses = (body?: ArrayLike<number>) =>
      on((bound) => {
        const read = () => posesOf(bound, object, clip, frames);
        return body ? bound.rig.onBody(body, read) : read();
      });
    const toBVH = () => bvhText({ proportions, poses: poses(proportions), rateHz: RATE_HZ });
    return { name: clip.name, frames, rateHz: RATE_HZ, durationSecs, proportions, poses, toBVH };
  });
}

/** The poses of a clip; its bones are restored afterwards. */
function posesOf({ rig, joints }: Bound, object: Object3D, clip: AnimationClip, frames: number): Float32Array {
  const { nodes, parents, scales } = joints;
  const hung = nodes.flatMap((node, joint) => (joint > 0 && node.parent !== nodes[parents[joint]!] ? [joint] : []));
  const before = nodes.map(({ position, quaternion, scale }) => ({
    position: position.clone(),
    quaternion: quaternion.clone(),
    scale: scale.clone(),
  }));
  const mixer = new AnimationMixer(object);
  const action = mixer.clipAction(clip);
  const poses = new Float32Array(POSE_FLOATS * frames);
  try {
    action.play();
    const atOnce = Math.max(1, Math.floor(MAX_FLOATS / (7 * nodes.length)));
    for (let start = 0; start < frames; start += atOnce) {
      const some = Math.min(atOnce, frames - start);
      const locals = new Float32Array(7 * nodes.length * some);
      for (let frame = 0; frame < some; frame++) {
        // At its exact end, a looping clip is at its beginning.
        mixer.setTime(Math.min((start + frame) / RATE_HZ, Math.max(clip.duration - 1e-6, 0)));
        for (const [joint, node] of nodes.entries()) {
          const at = 7 * (frame * nodes.length + joint);
          if (joint === 0) locals[at + 6] = 1;
          else {
            const scale = scales[parents[joint]!]!;
            node.position.toArray(locals, at);
            for (let axis = 0; axis < 3; axis++) locals[at + axis]! *= scale;
            node.quaternion.toArray(locals, at + 3);
          }
        }
        for (const joint of hung) {
          const local = matrixIn(object, nodes[parents[joint]!]!).invert().multiply(matrixIn(object, nodes[joint]!));
          const [place, turn, size] = [new Vector3(), new Quaternion(), new Vector3()];
          local.decompose(place, turn, size);
          const at = 7 * (frame * nodes.length + joint);
          place.multiplyScalar(scales[parents[joint]!]!).toArray(locals, at);
          turn.toArray(locals, at + 3);
        }
      }
      if (!locals.every(Number.isFinite)) throw unreadable(clip.name);
      poses.set(rig.toPoses(locals), POSE_FLOATS * start);
    }
  } catch (cause) {
    throw cause instanceof StrutError ? cause : unreadable(clip.name, cause);
  } finally {
    action.stop();
    mixer.uncacheRoot(object);
    for (const [joint, node] of nodes.entries()) {
      node.position.copy(before[joint]!.position);
      node.quaternion.copy(before[joint]!.quaternion);
      node.scale.copy(before[joint]!.scale);
    }
  }
  return poses;
}

/** The matrix of a node in the space of an object. */
function matrixIn(object: Object3D, node: Object3D): Matrix4 {
  const matrix = new Matrix4();
  for (let at: Object3D | null = node; at && at !== object; at = at.parent)
    matrix.premultiply(new Matrix4().compose(at.position, at.quaternion, at.scale));
  return matrix;
}

function unreadable(name: string, cause?: unknown): StrutError {
  const message = `The motion '${name}' has keyframes that cannot be read.`;
  return new StrutError({ code: "bad-file", message, hint: "Export it again." }, cause);
}
