/** The bone matrices of one mannequin: forward kinematics, then one matrix a slot. */

import { Bone, Skeleton } from "three";
import { createWorldPose, JOINT, type WorldPose, worldFromLocal } from "../humanoid";
import type { Fit } from "./fit";
import { RIGID_SLOTS, SLOT_JOINTS, SLOTS } from "./slots";
import { WAIST_RINGS, waistParameter } from "./waist";

/** Reach of the Bézier's inner control points, as a share of the distance between its ends. */
const WAIST_STIFFNESS = 0.35;

/**
 * A skeleton whose matrices come from poses, not from a hierarchy of scene nodes: three.js only uploads them. Nothing is
 * allocated per frame.
 */
export class PoseSkeleton extends Skeleton {
  /** Joints in the world of the last pose. */
  readonly world: WorldPose = createWorldPose();
  readonly #matrices: Float32Array;
  readonly #curve = new Float32Array(12);

  constructor() {
    super(SLOTS.map(() => new Bone()));
    // Allocates the texture now, because it replaces the array that the matrices live in.
    this.#matrices = this.computeBoneTexture().boneMatrices!;
  }

  /** Computes the matrices of a pose. */
  setPose(fit: Fit, pose: ArrayLike<number>): void {
    worldFromLocal(fit.proportions, pose, this.world);
    for (let slot = 0; slot < RIGID_SLOTS.length; slot++) this.#placeSlot(slot, SLOT_JOINTS[slot]!, fit.jointFromSlot);
    this.#placeWaist(fit);
    if (this.boneTexture) this.boneTexture.needsUpdate = true;
  }

  /** Called by the renderer, which would otherwise gather matrices from scene nodes. */
  override update(): void {}

  /** `world_from_slot = world_from_joint · joint_from_slot`. */
  #placeSlot(slot: number, joint: number, jointFromSlot: Float32Array): void {
    const { positions, rotations } = this.world;
    const out = this.#matrices;
    const base = 16 * slot;
    rotationInto(out, base, rotations, joint);
    const m0 = out[base]!;
    const m1 = out[base + 1]!;
    const m2 = out[base + 2]!;
    const m4 = out[base + 4]!;
    const m5 = out[base + 5]!;
    const m6 = out[base + 6]!;
    const m8 = out[base + 8]!;
    const m9 = out[base + 9]!;
    const m10 = out[base + 10]!;
    for (let column = base; column < base + 16; column += 4) {
      const x = jointFromSlot[column]!;
      const y = jointFromSlot[column + 1]!;
      const z = jointFromSlot[column + 2]!;
      out[column] = m0 * x + m4 * y + m8 * z;
      out[column + 1] = m1 * x + m5 * y + m9 * z;
      out[column + 2] = m2 * x + m6 * y + m10 * z;
      out[column + 3] = 0;
    }
    out[base + 12]! += positions[3 * joint]!;
    out[base + 13]! += positions[3 * joint + 1]!;
    out[base + 14]! += positions[3 * joint + 2]!;
    out[base + 15] = 1;
  }

  /** Rings along a cubic Bézier that leaves the pelvis and enters the ribcage straight; orientations are blended. */
  #placeWaist(fit: Fit): void {
    const { positions, rotations } = this.world;
    const out = this.#matrices;
    const curve = this.#curve;
    const hips = JOINT.hips;
    const chest = JOINT.chest;
    rotationInto(out, 16 * RIGID_SLOTS.length, rotations, hips);
    rotationInto(out, 16 * RIGID_SLOTS.length + 16, rotations, chest);
    const a = 16 * RIGID_SLOTS.length;
    const d = a + 16;
    for (let axis = 0; axis < 3; axis++) {
      const s = fit.waistStart;
      const e = fit.waistEnd;
      curve[axis] =
        positions[3 * hips + axis]! + out[a + axis]! * s.x + out[a + 4 + axis]! * s.y + out[a + 8 + axis]! * s.z;
      curve[9 + axis] =
        positions[3 * chest + axis]! + out[d + axis]! * e.x + out[d + 4 + axis]! * e.y + out[d + 8 + axis]! * e.z;
    }
    const reach = WAIST_STIFFNESS * Math.hypot(curve[9]! - curve[0]!, curve[10]! - curve[1]!, curve[11]! - curve[2]!);
    for (let axis = 0; axis < 3; axis++) {
      curve[3 + axis] = curve[axis]! + reach * out[a + 4 + axis]!;
      curve[6 + axis] = curve[9 + axis]! - reach * out[d + 4 + axis]!;
    }
    const { start, end } = fit.waistScale;
    const sign =
      rotations[4 * hips]! * rotations[4 * chest]! +
        rotations[4 * hips + 1]! * rotations[4 * chest + 1]! +
        rotations[4 * hips + 2]! * rotations[4 * chest + 2]! +
        rotations[4 * hips + 3]! * rotations[4 * chest + 3]! <
      0
        ? -1
        : 1;
    for (let ring = 0; ring < WAIST_RINGS; ring++) {
      const t = waistParameter(ring);
      const s = 1 - t;
      for (let k = 0; k < 4; k++) blended[k] = s * rotations[4 * hips + k]! + sign * t * rotations[4 * chest + k]!;
      const length = Math.hypot(blended[0]!, blended[1]!, blended[2]!, blended[3]!) || 1;
      for (let k = 0; k < 4; k++) blended[k]! /= length;
      const base = 16 * (RIGID_SLOTS.length + ring);
      rotationInto(out, base, blended, 0);
      const width = s * start[0] + t * end[0];
      const depth = s * start[1] + t * end[1];
      for (let axis = 0; axis < 3; axis++) {
        out[base + axis]! *= width;
        out[base + 8 + axis]! *= depth;
        out[base + 12 + axis] =
          s * s * s * curve[axis]! +
          3 * s * s * t * curve[3 + axis]! +
          3 * s * t * t * curve[6 + axis]! +
          t * t * t * curve[9 + axis]!;
      }
    }
  }
}

const blended = new Float32Array(4);

/** Writes the rotation of quaternion number `index` as a 4 × 4 matrix without translation. */
function rotationInto(out: Float32Array, base: number, quaternions: Float32Array, index: number): void {
  const x = quaternions[4 * index]!;
  const y = quaternions[4 * index + 1]!;
  const z = quaternions[4 * index + 2]!;
  const w = quaternions[4 * index + 3]!;
  out[base] = 1 - 2 * (y * y + z * z);
  out[base + 1] = 2 * (x * y + w * z);
  out[base + 2] = 2 * (x * z - w * y);
  out[base + 3] = 0;
  out[base + 4] = 2 * (x * y - w * z);
  out[base + 5] = 1 - 2 * (x * x + z * z);
  out[base + 6] = 2 * (y * z + w * x);
  out[base + 7] = 0;
  out[base + 8] = 2 * (x * z + w * y);
  out[base + 9] = 2 * (y * z - w * x);
  out[base + 10] = 1 - 2 * (x * x + y * y);
  out[base + 11] = 0;
  out[base + 12] = 0;
  out[base + 13] = 0;
  out[base + 14] = 0;
  out[base + 15] = 1;
}
