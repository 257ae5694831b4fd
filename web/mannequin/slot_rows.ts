/** The matrices of one mannequin: forward kinematics, then one affine transform per slot, in the layout of the shaders. */

import { createWorldPose, JOINT, type WorldPose, worldFromLocal } from "../humanoid";
import type { Fit } from "./fit";
import { RIGID_SLOTS, SLOT_JOINTS, SLOTS } from "./slots";
import { WAIST_RINGS, waistParameter } from "./waist";

/** Reach of the Bézier's inner control points, as a share of the distance between its ends. */
const WAIST_STIFFNESS = 0.35;
/** Numbers of one slot: three rows (x, y, z, translation). */
const ROW_FLOATS = 12;

/** World transforms of all slots; nothing is allocated per pose. */
export class SlotRows {
  /** Rows of every slot: the world's x, y, z from the slot's x, y, z, 1. */
  readonly values = new Float32Array(ROW_FLOATS * SLOTS.length);
  /** Joints in the world of the last pose. */
  readonly world: WorldPose = createWorldPose();

  /** Computes the transforms of a pose. */
  setPose(fit: Fit, pose: ArrayLike<number>): void {
    worldFromLocal(fit.proportions, pose, this.world);
    for (let slot = 0; slot < RIGID_SLOTS.length; slot++) this.#placeSlot(slot, SLOT_JOINTS[slot]!, fit.jointFromSlot);
    this.#placeWaist(fit);
  }

  /** `world_from_slot = world_from_joint · joint_from_slot`. */
  #placeSlot(slot: number, joint: number, jointFromSlot: Float32Array): void {
    const { positions, rotations } = this.world;
    rotationInto(turn, rotations, joint);
    for (let row = 0; row < 3; row++) {
      const a = turn[3 * row]!;
      const b = turn[3 * row + 1]!;
      const c = turn[3 * row + 2]!;
      const out = ROW_FLOATS * slot + 4 * row;
      for (let column = 0; column < 4; column++) {
        const m = 16 * slot + 4 * column;
        this.values[out + column] = a * jointFromSlot[m]! + b * jointFromSlot[m + 1]! + c * jointFromSlot[m + 2]!;
      }
      this.values[out + 3]! += positions[3 * joint + row]!;
    }
  }

  /** Rings along a cubic Bézier that leaves the pelvis and enters the ribcage straight; orientations are blended. */
  #placeWaist(fit: Fit): void {
    const { positions, rotations } = this.world;
    const q = rotations;
    const [hips, chest] = [JOINT.hips, JOINT.chest];
    rotationInto(turn, rotations, hips);
    rotationInto(endTurn, rotations, chest);
    const { waistStart: s0, waistEnd: e0 } = fit;
    for (let axis = 0; axis < 3; axis++) {
      const row = 3 * axis;
      curve[axis] = positions[3 * hips + axis]! + turn[row]! * s0[0] + turn[row + 1]! * s0[1] + turn[row + 2]! * s0[2];
      curve[9 + axis] =
        positions[3 * chest + axis]! + endTurn[row]! * e0[0] + endTurn[row + 1]! * e0[1] + endTurn[row + 2]! * e0[2];
    }
    const span = Math.hypot(curve[9]! - curve[0]!, curve[10]! - curve[1]!, curve[11]! - curve[2]!);
    for (let axis = 0; axis < 3; axis++) {
      curve[3 + axis] = curve[axis]! + WAIST_STIFFNESS * span * turn[3 * axis + 1]!;
      curve[6 + axis] = curve[9 + axis]! - WAIST_STIFFNESS * span * endTurn[3 * axis + 1]!;
    }
    let dot = 0;
    for (let k = 0; k < 4; k++) dot += q[4 * hips + k]! * q[4 * chest + k]!;
    const sign = dot < 0 ? -1 : 1;
    const { start, end } = fit.waistScale;
    for (let ring = 0; ring < WAIST_RINGS; ring++) {
      const t = waistParameter(ring);
      const s = 1 - t;
      let norm = 0;
      for (let k = 0; k < 4; k++) {
        blended[k] = s * q[4 * hips + k]! + sign * t * q[4 * chest + k]!;
        norm += blended[k]! * blended[k]!;
      }
      norm = 1 / Math.sqrt(norm || 1);
      for (let k = 0; k < 4; k++) blended[k]! *= norm;
      rotationInto(turn, blended, 0);
      const width = s * start[0] + t * end[0];
      const depth = s * start[1] + t * end[1];
      for (let axis = 0; axis < 3; axis++) {
        const out = ROW_FLOATS * (RIGID_SLOTS.length + ring) + 4 * axis;
        this.values[out] = turn[3 * axis]! * width;
        this.values[out + 1] = turn[3 * axis + 1]!;
        this.values[out + 2] = turn[3 * axis + 2]! * depth;
        this.values[out + 3] =
          s * s * s * curve[axis]! +
          3 * s * s * t * curve[3 + axis]! +
          3 * s * t * t * curve[6 + axis]! +
          t * t * t * curve[9 + axis]!;
      }
    }
  }
}

const turn = new Float32Array(9);
const endTurn = new Float32Array(9);
const blended = new Float32Array(4);
/** Control points of the waist's Bézier, 4 × xyz. */
const curve = new Float32Array(12);

/** Writes the quaternion at `index` as the rows of a rotation matrix. */
function rotationInto(out: Float32Array, quaternions: Float32Array, index: number): void {
  const x = quaternions[4 * index]!;
  const y = quaternions[4 * index + 1]!;
  const z = quaternions[4 * index + 2]!;
  const w = quaternions[4 * index + 3]!;
  out[0] = 1 - 2 * (y * y + z * z);
  out[1] = 2 * (x * y - w * z);
  out[2] = 2 * (x * z + w * y);
  out[3] = 2 * (x * y + w * z);
  out[4] = 1 - 2 * (x * x + z * z);
  out[5] = 2 * (y * z - w * x);
  out[6] = 2 * (x * z - w * y);
  out[7] = 2 * (y * z + w * x);
  out[8] = 1 - 2 * (x * x + y * y);
}
