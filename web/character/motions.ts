/** The motions in a character's file as poses, through the binding that performs poses (`shared/spec/embedding.md` 5.6). */
import { type AnimationClip, AnimationMixer, type Object3D } from "three";
import type { Bound } from "./bind";
import type { CharacterMotion } from "./types";

/** Frames a second at which clips are sampled. */
const RATE_HZ = 60;
/** Longest clip, seconds; what is longer is cut. */
const MAX_SECS = 600;

/** The motions of a character. */
export function motionsOf(bound: Bound, object: Object3D, clips: readonly AnimationClip[]): CharacterMotion[] {
  return clips.map((clip) => {
    const durationSecs = Math.min(Math.max(clip.duration, 0), MAX_SECS);
    const frames = Math.floor(durationSecs * RATE_HZ + 1e-6) + 1;
    const poses = () => bound.rig.toPoses(sampled(bound, object, clip, frames));
    return { name: clip.name, frames, rateHz: RATE_HZ, durationSecs, poses };
  });
}

/** Local transforms of all joints in every frame, seven numbers a joint; the character is left as it was. */
function sampled({ joints }: Bound, object: Object3D, clip: AnimationClip, frames: number): Float32Array {
  const { nodes, parents, scales } = joints;
  const before = nodes.map(({ position, quaternion, scale }) => ({
    position: position.clone(),
    quaternion: quaternion.clone(),
    scale: scale.clone(),
  }));
  const mixer = new AnimationMixer(object);
  const action = mixer.clipAction(clip);
  action.play();
  const locals = new Float32Array(7 * nodes.length * frames);
  let at = 0;
  for (let frame = 0; frame < frames; frame++) {
    // At its very end a repeated clip is at its beginning.
    mixer.setTime(Math.min(frame / RATE_HZ, Math.max(clip.duration - 1e-6, 0)));
    for (const [joint, node] of nodes.entries()) {
      if (joint === 0) locals[at + 6] = 1;
      else {
        const scale = scales[parents[joint]!]!;
        node.position.toArray(locals, at);
        for (let axis = 0; axis < 3; axis++) locals[at + axis]! *= scale;
        node.quaternion.toArray(locals, at + 3);
      }
      at += 7;
    }
  }
  action.stop();
  mixer.uncacheRoot(object);
  for (const [joint, node] of nodes.entries()) {
    node.position.copy(before[joint]!.position);
    node.quaternion.copy(before[joint]!.quaternion);
    node.scale.copy(before[joint]!.scale);
  }
  return locals;
}
