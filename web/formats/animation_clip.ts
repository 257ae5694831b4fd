/** An animation as three.js's `AnimationClip` for a loaded rig. The caller passes three.js: nothing is imported from it. */

import { JOINT, JOINTS, PARENTS, ROLES, type Role } from "../humanoid";
import { type HumanoidAnimation, hipsPositions, jointRotations } from "./animation";

/** The part of three.js that makes clips, by structure; the module itself, `import * as THREE from "three"`, matches. */
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

/** Options of a clip. */
export interface ClipOptions {
  /** Name of the clip; by default the animation's. */
  name?: string;
  /** Whether the hips stay at their starting point on the ground (in place); their height is kept. False by default. */
  inPlace?: boolean;
}

/** The error of a rig without a joint that the animation moves. */
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
 * Makes the clip: positions of the hips and rotations of every joint, one key per frame at the animation's times.
 *
 * @param three - three.js, from whose classes the clip is made.
 * @param root - The root for the `AnimationMixer`. At or below it are 21 nodes named by the canonical roles, each below
 * its parent's, at rest in the T-pose facing +Z without rotations, for example the loaded GLB of the mannequin. A track
 * names its node, or the node's uuid if another node has the same name.
 * @throws MissingJointError that names the joint, if one is not found.
 */
export function toAnimationClip<Clip, Track>(
  three: ThreeLike<Clip, Track>,
  root: RigNode,
  animation: HumanoidAnimation,
  { name = animation.name, inPlace = false }: ClipOptions = {},
): Clip {
  const targets = trackTargets(root);
  const positions = inPlace ? overTheStart(hipsPositions(animation)) : hipsPositions(animation);
  // Every track has its own times: three.js keeps the array and changes it in place when a track is shifted or scaled.
  const times = () => animation.times.slice();
  const tracks = [new three.VectorKeyframeTrack(`${targets[0]}.position`, times(), positions)];
  for (let j = 0; j < JOINTS; j++)
    tracks.push(new three.QuaternionKeyframeTrack(`${targets[j]}.quaternion`, times(), jointRotations(animation, j)));
  return new three.AnimationClip(name, animation.times.at(-1) ?? 0, tracks);
}

/** The track target of every role's joint: the name of its node, or the uuid if the name is not unique. */
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

/** The first node with a name in or below some nodes, in three.js's order of traversal. */
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

/** Positions, xyz per frame, with the x and z of the first. */
function overTheStart(positions: Float32Array): Float32Array {
  return positions.map((value, i) => (i % 3 === 1 ? value : positions[i % 3]!));
}
