/** The mannequin in the T-pose as one mesh that follows joints, with the data for a shader that poses hundreds of bodies. */

import { JOINT, restPose } from "../humanoid";
import type { Fit } from "./fit";
import { buildMesh } from "./mesh";
import { SlotRows } from "./slot_rows";
import { RIGID_SLOTS, SLOT_JOINTS } from "./slots";
import { WAIST_RINGS, waistParameter } from "./waist";

/** Numbers of one slot's transform, see `SlotRows`. */
const ROW_FLOATS = 12;

/** A mesh whose vertices follow one joint, or two in a mixture. */
export interface SkinnedBody {
  /** xyz of every vertex in the T-pose, metres. */
  positions: Float32Array;
  /** Unit normal xyz of every vertex, in the T-pose. */
  normals: Float32Array;
  /** The two joints of every vertex; equal if it follows only one. */
  joints: Uint8Array;
  /** Share of the second joint, 0–1. */
  blends: Float32Array;
  /** 0 for the shell, 1 for the dark joints. */
  tones: Uint8Array;
  /** Three vertices per triangle, counter-clockwise from outside. */
  indices: Uint16Array;
}

/** xyz of every joint in the T-pose of a body, metres, to which {@link SkinnedBody} is relative. */
export function restJoints(fit: Fit): Float32Array {
  return restRows(fit).world.positions;
}

function restRows(fit: Fit): SlotRows {
  const rows = new SlotRows();
  const pose = restPose();
  pose[1] = fit.proportions[1]!;
  rows.setPose(fit, pose);
  return rows;
}

/**
 * Converts the mannequin's mesh from its slots to joints. The waist's rings, which follow a curve in the mannequin, are
 * mixtures of hips and chest here: at the sizes of a crowd the two look alike.
 *
 * @param detail - As for {@link buildMesh}.
 */
export function skinnedBody(fit: Fit, detail: number): SkinnedBody {
  const { positions, normals, slots, indices, groups } = buildMesh(detail);
  const rows = restRows(fit).values;
  const count = slots.length;
  const body: SkinnedBody = {
    positions: new Float32Array(3 * count),
    normals: new Float32Array(3 * count),
    joints: new Uint8Array(2 * count),
    blends: new Float32Array(count),
    tones: new Uint8Array(count),
    indices,
  };
  for (let vertex = 0; vertex < count; vertex++) {
    const slot = slots[vertex]!;
    let length = 0;
    for (let axis = 0; axis < 3; axis++) {
      const row = ROW_FLOATS * slot + 4 * axis;
      let position = rows[row + 3]!;
      let normal = 0;
      for (let k = 0; k < 3; k++) {
        position += rows[row + k]! * positions[3 * vertex + k]!;
        normal += rows[row + k]! * normals[3 * vertex + k]!;
      }
      body.positions[3 * vertex + axis] = position;
      body.normals[3 * vertex + axis] = normal;
      length += normal * normal;
    }
    for (let axis = 0; axis < 3; axis++) body.normals[3 * vertex + axis]! /= Math.sqrt(length) || 1;
    const ring = slot - RIGID_SLOTS.length;
    body.joints[2 * vertex] = ring < 0 ? SLOT_JOINTS[slot]! : JOINT.hips;
    body.joints[2 * vertex + 1] = ring < 0 ? SLOT_JOINTS[slot]! : JOINT.chest;
    body.blends[vertex] = ring < 0 ? 0 : waistParameter(Math.min(ring, WAIST_RINGS - 1));
  }
  for (const [tone, { start, count: length }] of groups.entries())
    for (const vertex of indices.subarray(start, start + length)) body.tones[vertex] = tone;
  return body;
}
