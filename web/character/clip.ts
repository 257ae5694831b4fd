/** A motion on a character as keyframes of its bones: for clips of three.js and for files. */
import {
  AnimationClip,
  type Object3D,
  PropertyBinding,
  Quaternion,
  QuaternionKeyframeTrack,
  VectorKeyframeTrack,
} from "three";
import { JOINT, POSE_FLOATS, ROLES } from "../humanoid";
import type { Bound } from "./bind";
import type { CharacterClipOptions, StyledPoses, VrmLike } from "./types";
import { vrmBone } from "./vrm_humanoid";

/** Keyframes of a character, one per frame. */
export interface Keys {
  /** Seconds; the first is 0. */
  readonly times: Float32Array;
  /** Local translations of the hips in their parent's frame, xyz. */
  readonly hips: Float32Array;
  /** Local rotations of every driven joint, xyzw, with the sign nearer to the previous key. */
  readonly rotations: readonly Float32Array[];
  /** Local translations of the other joints that are moved, xyz, by joint. */
  readonly places: ReadonlyMap<number, Float32Array>;
}

/** The motion on the bones of a character. @throws StrutError `bad-input` unless the motion consists of finite poses */
export function keysOf(bound: Bound, motion: StyledPoses, inPlace: boolean): Keys {
  return bound.rig.onBody(motion.proportions, () => keysOnBody(bound, motion, inPlace));
}

function keysOnBody({ rig, driven, moved, hipsScale }: Bound, motion: StyledPoses, inPlace: boolean): Keys {
  const frames = motion.timeOut.length;
  const hips = new Float32Array(3 * frames);
  const rotations = Array.from(driven, () => new Float32Array(4 * frames));
  const places = new Map(moved.joints.map((joint) => [joint, new Float32Array(3 * frames)]));
  const pose = new Float32Array(POSE_FLOATS);
  const start = motion.timeOut[0] ?? 0;
  for (let f = 0; f < frames; f++) {
    pose.set(motion.poses.subarray(f * POSE_FLOATS, (f + 1) * POSE_FLOATS));
    if (inPlace) [pose[0], pose[2]] = [motion.poses[0]!, motion.poses[2]!];
    rig.apply(pose);
    for (let axis = 0; axis < 3; axis++) hips[3 * f + axis] = rig.frame[axis]! * hipsScale;
    moved.update(rig.frame);
    for (const [i, joint] of driven.entries()) {
      const keys = rotations[i]!;
      const m = moved.joints.indexOf(joint);
      places.get(joint)?.set(moved.positions.subarray(3 * m, 3 * m + 3), 3 * f);
      const turned =
        m < 0 ? rig.frame.subarray(3 + 4 * joint, 7 + 4 * joint) : moved.rotations.subarray(4 * m, 4 * m + 4);
      keys.set(turned, 4 * f);
      if (f > 0) turnToward(keys, f);
    }
  }
  return { times: motion.timeOut.map((time) => time - start), hips, rotations, places };
}

/** Interpolation takes the shorter path only between quaternions of the same sign. */
function turnToward(keys: Float32Array, frame: number): void {
  let dot = 0;
  for (let k = 0; k < 4; k++) dot += keys[4 * frame + k]! * keys[4 * frame - 4 + k]!;
  if (dot < 0) for (let k = 0; k < 4; k++) keys[4 * frame + k]! *= -1;
}

/**
 * The motion as a clip of three.js. A track names its node, or the node's uuid if another node has the same name. A VRM
 * of three-vrm gets tracks of its normalized bones, which it copies to the raw ones.
 */
export function characterClip(
  bound: Bound,
  object: Object3D,
  vrm: VrmLike | undefined,
  motion: StyledPoses,
  { name = motion.name, inPlace = false, keep }: CharacterClipOptions,
): AnimationClip {
  const keys = keysOf(bound, motion, inPlace);
  const counts = new Map<string, number>();
  object.traverse((node) => counts.set(node.name, (counts.get(node.name) ?? 0) + 1));
  const target = (node: Object3D) => (node.name && counts.get(node.name) === 1 ? node.name : node.uuid);
  // Every track has its own times: three.js changes them in place when a track is shifted or scaled.
  const times = () => keys.times.slice();
  const { joints, roles, driven } = bound;
  const hips = roles[JOINT.hips]!;
  const normalized = vrm ? normalizedBones(vrm) : new Map<Object3D, Object3D>();
  const rest = restRotations(bound);
  const tracks: (QuaternionKeyframeTrack | VectorKeyframeTrack)[] = [];
  for (const [i, joint] of driven.entries()) {
    const raw = joints.nodes[joint]!;
    const bone = normalized.get(raw);
    // three-vrm does not change a joint that the VRM does not name, such as an additional one between spine and chest.
    const node = target(bone ?? raw);
    if (joint === hips) {
      const positions = bone ? inWorld(bound, keys.hips) : keys.hips;
      tracks.push(new VectorKeyframeTrack(`${node}.position`, times(), positions));
    }
    const places = keys.places.get(joint);
    if (places && !bone) tracks.push(new VectorKeyframeTrack(`${node}.position`, times(), places));
    const [above, own] = [rest[joints.parents[joint]!]!, rest[joint]!];
    const rotations = bone ? fromRest(keys.rotations[i]!, above, own) : keys.rotations[i]!;
    tracks.push(new QuaternionKeyframeTrack(`${node}.quaternion`, times(), rotations));
  }
  const kept = keep ? otherTracks(bound, object, keep, keys.times) : [];
  return new AnimationClip(name, keys.times.at(-1) ?? 0, [...tracks, ...kept]);
}

/** The tracks of a clip that do not move the body, retimed to the styled motion. */
function otherTracks({ joints, roles, driven }: Bound, object: Object3D, clip: AnimationClip, times: Float32Array) {
  const body = new Set<Object3D>(Array.from(driven, (joint) => joints.nodes[joint]!));
  // The movement of the hips' ancestors is contained in the motion of the hips.
  for (let joint = roles[JOINT.hips]!; joint >= 0; joint = joints.parents[joint]!) body.add(joints.nodes[joint]!);
  const last = Math.max(times.length - 1, 1);
  const styledTime = (secs: number) => {
    const frame = Math.min(Math.max((secs / (clip.duration || 1)) * last, 0), last);
    const [before, share] = [Math.floor(frame), frame % 1];
    const start = times[before] ?? 0;
    return start + share * ((times[before + 1] ?? start) - start);
  };
  return clip.tracks.flatMap((track) => {
    const { nodeName } = PropertyBinding.parseTrackName(track.name);
    const node: unknown = PropertyBinding.findNode(object, nodeName);
    if (body.has(node as Object3D)) return [];
    const copy = track.clone();
    copy.times = copy.times.map(styledTime);
    return [copy];
  });
}

/** The normalized bone of each raw bone that has a role, or lies between bones with roles. */
function normalizedBones({ humanoid }: VrmLike): Map<Object3D, Object3D> {
  const bones = new Map<Object3D, Object3D>();
  for (const name of [...ROLES.map(vrmBone), "upperChest"]) {
    const [raw, normalized] = [humanoid.getRawBoneNode(name), humanoid.getNormalizedBoneNode(name)];
    if (raw && normalized) bones.set(raw, normalized);
  }
  return bones;
}

/** Local rotations of a raw bone converted to those of its normalized bone, which is aligned with the world at rest. */
function fromRest(raw: Float32Array, above: Quaternion, own: Quaternion): Float32Array {
  const values = new Float32Array(raw.length);
  const [turned, back] = [new Quaternion(), own.clone().invert()];
  for (let i = 0; i < raw.length; i += 4) turned.fromArray(raw, i).premultiply(above).multiply(back).toArray(values, i);
  return values;
}

/** World rotation of every joint at rest, to which normalized bones are relative. */
function restRotations({ joints }: Bound): Quaternion[] {
  const rest: Quaternion[] = [];
  for (const [joint, parent] of joints.parents.entries()) {
    const local = new Quaternion().fromArray(joints.local, 4 * joint);
    rest.push(parent < 0 ? local : rest[parent]!.clone().multiply(local));
  }
  return rest;
}

/** Positions of the hips in the space of the character's object, which normalized bones use. */
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
