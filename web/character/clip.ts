/** A motion on a character as keys of its bones: for clips of three.js and for files. */
import { AnimationClip, type Object3D, Quaternion, QuaternionKeyframeTrack, VectorKeyframeTrack } from "three";
import { JOINT, POSE_FLOATS, ROLES } from "../humanoid";
import type { Bound } from "./bind";
import type { CharacterClipOptions, StyledPoses, VrmLike } from "./types";
import { vrmBone } from "./vrm_humanoid";

/** Keys of a character, one a frame. */
export interface Keys {
  /** Seconds; the first is 0. */
  readonly times: Float32Array;
  /** Local translations of the hips in their parent's frame, xyz. */
  readonly hips: Float32Array;
  /** Of every driven joint its local rotations, xyzw, each the nearer of the two that mean the same. */
  readonly rotations: readonly Float32Array[];
}

/** The motion on the bones of a character. @throws StrutError `bad-input` unless the motion is one of finite poses */
export function keysOf({ rig, driven, hipsScale }: Bound, motion: StyledPoses, inPlace: boolean): Keys {
  const frames = motion.timeOut.length;
  const hips = new Float32Array(3 * frames);
  const rotations = Array.from(driven, () => new Float32Array(4 * frames));
  const pose = new Float32Array(POSE_FLOATS);
  const start = motion.timeOut[0] ?? 0;
  rig.setBody(motion.proportions);
  for (let f = 0; f < frames; f++) {
    pose.set(motion.poses.subarray(f * POSE_FLOATS, (f + 1) * POSE_FLOATS));
    if (inPlace) [pose[0], pose[2]] = [motion.poses[0]!, motion.poses[2]!];
    rig.apply(pose);
    for (let axis = 0; axis < 3; axis++) hips[3 * f + axis] = rig.frame[axis]! * hipsScale;
    for (const [i, joint] of driven.entries()) {
      const keys = rotations[i]!;
      keys.set(rig.frame.subarray(3 + 4 * joint, 7 + 4 * joint), 4 * f);
      if (f > 0) turnToward(keys, f);
    }
  }
  return { times: motion.timeOut.map((time) => time - start), hips, rotations };
}

/** Interpolation goes the short way only between quaternions of the same sign. */
function turnToward(keys: Float32Array, frame: number): void {
  let dot = 0;
  for (let k = 0; k < 4; k++) dot += keys[4 * frame + k]! * keys[4 * frame - 4 + k]!;
  if (dot < 0) for (let k = 0; k < 4; k++) keys[4 * frame + k]! *= -1;
}

/**
 * The motion as a clip of three.js. A track names its node, or the node's uuid where another has the same name. A VRM of
 * three-vrm gets tracks of its normalized bones, which it passes on.
 */
export function characterClip(
  bound: Bound,
  object: Object3D,
  vrm: VrmLike | undefined,
  motion: StyledPoses,
  { name = motion.name, inPlace = false }: CharacterClipOptions,
): AnimationClip {
  const keys = keysOf(bound, motion, inPlace);
  const counts = new Map<string, number>();
  object.traverse((node) => counts.set(node.name, (counts.get(node.name) ?? 0) + 1));
  const target = (node: Object3D) => (node.name && counts.get(node.name) === 1 ? node.name : node.uuid);
  // Every track has its own times: three.js changes them in place where a track is moved or scaled.
  const times = () => keys.times.slice();
  const { joints, roles, driven } = bound;
  const hips = joints.nodes[roles[JOINT.hips]!]!;
  const tracks: (QuaternionKeyframeTrack | VectorKeyframeTrack)[] = [];
  if (vrm) {
    const rest = restRotations(bound);
    for (const [r, role] of ROLES.entries()) {
      const normalized = roles[r]! >= 0 && boneOf(vrm, role, joints.nodes[roles[r]!]!);
      if (!normalized) continue;
      const joint = roles[r]!;
      const [above, own] = [rest[joints.parents[joint]!]!, rest[joint]!];
      const raw = keys.rotations[driven.indexOf(joint)]!;
      const values = new Float32Array(raw.length);
      const turned = new Quaternion();
      for (let i = 0; i < raw.length; i += 4)
        turned.fromArray(raw, i).premultiply(above).multiply(own.clone().invert()).toArray(values, i);
      if (role === "hips")
        tracks.push(new VectorKeyframeTrack(`${target(normalized)}.position`, times(), inWorld(bound, keys.hips)));
      tracks.push(new QuaternionKeyframeTrack(`${target(normalized)}.quaternion`, times(), values));
    }
  } else {
    tracks.push(new VectorKeyframeTrack(`${target(hips)}.position`, times(), keys.hips));
    for (const [i, joint] of driven.entries())
      tracks.push(
        new QuaternionKeyframeTrack(`${target(joints.nodes[joint]!)}.quaternion`, times(), keys.rotations[i]!),
      );
  }
  return new AnimationClip(name, keys.times.at(-1) ?? 0, tracks);
}

/** The normalized bone of a role whose raw bone is this node: the chest may be VRM's upper chest. */
function boneOf(vrm: VrmLike, role: (typeof ROLES)[number], raw: Object3D): Object3D | undefined {
  const bones = role === "chest" ? ["upperChest", "chest"] : [vrmBone(role)];
  const bone = bones.find((name) => vrm.humanoid.getRawBoneNode(name) === raw);
  return (bone && vrm.humanoid.getNormalizedBoneNode(bone)) || undefined;
}

/** World rotation of every joint at rest, which normalized bones are relative to. */
function restRotations({ joints }: Bound): Quaternion[] {
  const rest: Quaternion[] = [];
  for (const [joint, parent] of joints.parents.entries()) {
    const local = new Quaternion().fromArray(joints.local, 4 * joint);
    rest.push(parent < 0 ? local : rest[parent]!.clone().multiply(local));
  }
  return rest;
}

/** Positions of the hips in the character's object: there normalized bones are. */
function inWorld({ joints, roles }: Bound, positions: Float32Array): Float32Array {
  const parent = joints.nodes[joints.parents[roles[JOINT.hips]!]!]!;
  const out = positions.slice();
  for (let node = parent; node !== joints.nodes[0]; node = node.parent!) {
    node.updateMatrix();
    const e = node.matrix.elements;
    for (let i = 0; i < out.length; i += 3) {
      const [x, y, z] = [out[i]!, out[i + 1]!, out[i + 2]!];
      for (let k = 0; k < 3; k++) out[i + k] = e[k]! * x + e[4 + k]! * y + e[8 + k]! * z + e[12 + k]!;
    }
  }
  return out;
}
