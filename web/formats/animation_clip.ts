/** An animation as three.js's `AnimationClip` for a loaded rig. three.js is the caller's: nothing is imported of it. */

import { JOINT, JOINTS, PARENTS, ROLES, type Role } from "../humanoid";
import { type HumanoidAnimation, hipsPositions, jointRotations } from "./animation";

/** The part of three.js that makes clips, by structure: the module itself, `import * as THREE from "three"`, fits. */
export interface ThreeLike<Clip, Track> {
  /** Makes a clip. */
  AnimationClip: new (
    name: string,
    duration: number,
    tracks: Track[],
  ) => Clip;
  /** Makes a track of rotations. */
  QuaternionKeyframeTrack: new (
    name: string,
    times: ArrayLike<number>,
    values: ArrayLike<number>,
  ) => Track;
  /** Makes a track of positions. */
  VectorKeyframeTrack: new (
    name: string,
    times: ArrayLike<number>,
    values: ArrayLike<number>,
  ) => Track;
}

/** A node of a rig, by structure: three.js's `Object3D` is one. */
export interface RigNode {
  /** Its name, by which tracks find it. */
  readonly name: string;
  /** Its identity. */
  readonly uuid: string;
  /** The nodes below it. */
  readonly children: readonly RigNode[];
}

/** What a clip may be told. */
export interface ClipOptions {
  /** Name of the clip; by default the animation's. */
  name?: string;
  /** Whether the hips stay over the place on the ground where they start; their height is kept. False by default. */
  inPlace?: boolean;
}

/** A rig lacks a joint that the animation moves. */
export class MissingJointError extends Error {
  override readonly name = "MissingJointError";
  /** The first joint, in canonical order, that was not found. */
  readonly role: Role;

  constructor(role: Role) {
    const parent = PARENTS[JOINT[role]]!;
    const place = parent < 0 ? "The rig" : `The rig's node “${ROLES[parent]}”`;
    super(`${place} has no node “${role}” below it.`);
    this.role = role;
  }
}

/**
 * Makes the clip: a position of the hips and a rotation of every joint, a key a frame at the animation's times.
 *
 * @param three - three.js, from whose classes the clip is made.
 * @param root - What the `AnimationMixer` will be made for. At or below it are 21 nodes named by the canonical roles, each
 *   below its parent's, at rest in the T-pose facing +Z without rotations: the mannequin's own GLB as it is loaded, say.
 *   A track names its node, or the node's uuid where another node has the same name.
 * @throws MissingJointError that names the joint, where one is not found.
 */
export function toAnimationClip<Clip, Track>(
  three: ThreeLike<Clip, Track>,
  root: RigNode,
  animation: HumanoidAnimation,
  { name = animation.name, inPlace = false }: ClipOptions = {},
): Clip {
  const targets = trackTargets(root);
  const positions = inPlace ? overTheStart(hipsPositions(animation)) : hipsPositions(animation);
  // Every track has its own times: three.js keeps the array and changes it in place when a track is moved or scaled.
  const times = () => animation.times.slice();
  const tracks = [new three.VectorKeyframeTrack(`${targets[0]}.position`, times(), positions)];
  for (let j = 0; j < JOINTS; j++)
    tracks.push(new three.QuaternionKeyframeTrack(`${targets[j]}.quaternion`, times(), jointRotations(animation, j)));
  return new three.AnimationClip(name, animation.times.at(-1) ?? 0, tracks);
}

/** What tracks call the joint of every role: the name of its node, or the uuid where the name is not the only one. */
function trackTargets(root: RigNode): string[] {
  const joints: RigNode[] = [];
  for (const [j, role] of ROLES.entries()) {
    const above = j === 0 ? [root] : joints[PARENTS[j]!]!.children;
    const node = firstNamed(role, above);
    if (!node) throw new MissingJointError(role);
    joints.push(node);
  }
  const counts = new Map<string, number>();
  countNames(root, counts);
  return joints.map(({ name, uuid }) => (counts.get(name) === 1 ? name : uuid));
}

/** The first node of a name in or below some nodes, in three.js's order of traversal. */
function firstNamed(name: string, nodes: readonly RigNode[]): RigNode | undefined {
  for (const node of nodes) {
    const found = node.name === name ? node : firstNamed(name, node.children);
    if (found) return found;
  }
  return undefined;
}

function countNames({ name, children }: RigNode, counts: Map<string, number>): void {
  counts.set(name, (counts.get(name) ?? 0) + 1);
  for (const child of children) countNames(child, counts);
}

/** Positions, xyz a frame, with the x and z of the first. */
function overTheStart(positions: Float32Array): Float32Array {
  return positions.map((value, i) => (i % 3 === 1 ? value : positions[i % 3]!));
}
