/**
 * Joints that poses translate as well as rotate: feet that are children of the root instead of their legs, as in rigs
 * for inverse kinematics, and bones whose position in the file differs from the bind pose.
 */
import { type Object3D, Quaternion, Vector3 } from "three";
import { JOINT } from "../humanoid";
import type { Joints } from "./joints";

export class MovedJoints {
  /** The joints, ascending. */
  readonly joints: readonly number[];
  /** Local translations in the frames of the nodes' parents, xyz per joint, of the last {@link update}. */
  readonly positions: Float32Array;
  /** Local rotations in the same frames, xyzw per joint. */
  readonly rotations: Float32Array;
  readonly #skeleton: Joints;
  readonly #hips: number;
  /** Joint of the node's parent, for each moved joint. */
  readonly #above: readonly number[];
  /** Offset from each joint's parent, in the parent's bind frame. */
  readonly #offsets: readonly Vector3[];
  readonly #turns: readonly Quaternion[];
  readonly #places: readonly Vector3[];
  readonly #turn = new Quaternion();
  readonly #place = new Vector3();

  /** @param driven joints that poses rotate */
  constructor(skeleton: Joints, roles: Int32Array, driven: Int32Array) {
    this.#skeleton = skeleton;
    this.#hips = roles[JOINT.hips]!;
    this.joints = skeleton.moved.filter((joint) => joint !== this.#hips && driven.includes(joint));
    const { nodes, parents, offsets, bind } = skeleton;
    const indices = new Map<Object3D, number>(nodes.map((node, joint) => [node, joint]));
    this.#above = this.joints.map((joint) => indices.get(nodes[joint]!.parent!) ?? parents[joint]!);
    this.positions = new Float32Array(3 * this.joints.length);
    this.rotations = new Float32Array(4 * this.joints.length);
    this.#offsets = nodes.map((_, joint) => {
      const offset = new Vector3().fromArray(offsets, 3 * joint);
      const above = parents[joint]!;
      return above < 0 ? offset : offset.applyQuaternion(new Quaternion().fromArray(bind, 4 * above).invert());
    });
    this.#turns = nodes.map(() => new Quaternion());
    this.#places = nodes.map(() => new Vector3());
  }

  /** Updates the joints from the engine's output: the translation of the hips, then the local rotation of every joint. */
  update(frame: ArrayLike<number>): void {
    if (this.joints.length === 0) return;
    const { parents, scales } = this.#skeleton;
    const [turn, place] = [this.#turn, this.#place];
    for (const [joint, above] of parents.entries()) {
      turn.fromArray(frame as number[], 3 + 4 * joint);
      if (joint === this.#hips) place.fromArray(frame as number[]);
      else place.copy(this.#offsets[joint]!);
      if (above < 0) {
        this.#turns[joint]!.copy(turn);
        this.#places[joint]!.copy(place);
        continue;
      }
      this.#places[joint]!.copy(place).applyQuaternion(this.#turns[above]!).add(this.#places[above]!);
      this.#turns[joint]!.copy(this.#turns[above]!).multiply(turn);
    }
    for (const [i, joint] of this.joints.entries()) {
      const above = this.#above[i]!;
      turn.copy(this.#turns[above]!).invert();
      place.copy(this.#places[joint]!).sub(this.#places[above]!).applyQuaternion(turn);
      place.divideScalar(scales[above]!).toArray(this.positions, 3 * i);
      turn
        .multiply(this.#turns[joint]!)
        .normalize()
        .toArray(this.rotations, 4 * i);
    }
  }
}
