/**
 * The mannequin with an animation as a binary glTF 2.0 file, which Blender, Unreal, Unity and three.js open: one skinned
 * mesh in two tones, the 21 joints of the canonical humanoid as its skeleton, and one key a frame.
 */

import { JOINT, JOINTS, ROLES, restPose } from "../humanoid";
import { TONE_COLOURS } from "../mannequin/colours";
import { type Fit, fitTo } from "../mannequin/fit";
import { buildMesh, TONES } from "../mannequin/mesh";
import { SlotRows } from "../mannequin/slot_rows";
import { RIGID_SLOTS, SLOT_JOINTS } from "../mannequin/slots";
import { WAIST_RINGS } from "../mannequin/waist";
import type { HumanoidAnimation } from "./animation";
import { BufferBuilder, glbFile } from "./glb";
import { jointAnimation, jointNodes } from "./humanoid_gltf";

/** Weight of the ribcage on each ring of the waist: the others follow the pelvis. */
const chestShare = (ring: number): number => ring / (WAIST_RINGS - 1);

/** Level of detail of the mesh in the file. */
const DETAIL = 0.6;

/** The mesh in the T-pose as glTF skins it. */
interface BoundMesh {
  /** xyz of every vertex in the world, metres. */
  positions: Float32Array;
  /** Unit normal xyz of every vertex. */
  normals: Float32Array;
  /** Four joints of every vertex, of which at most two have a weight. */
  joints: Uint8Array;
  /** Their weights, which sum to 1. */
  weights: Float32Array;
  /** Indices of the triangles of each tone. */
  groups: Uint16Array[];
  /** Joints in the world, 21 × xyz, metres. */
  rest: Float32Array;
}

function bindMesh(fit: Fit): BoundMesh {
  const rows = new SlotRows();
  rows.setPose(fit, restPose());
  const { positions: place, normals: direction, slots: slot, indices, groups: runs } = buildMesh(DETAIL);
  const count = slot.length;
  const positions = new Float32Array(3 * count);
  const normals = new Float32Array(3 * count);
  const joints = new Uint8Array(4 * count);
  const weights = new Float32Array(4 * count);
  for (let v = 0; v < count; v++) {
    const m = 12 * slot[v]!;
    for (let axis = 0; axis < 3; axis++) {
      const row = m + 4 * axis;
      let [p, n] = [rows.values[row + 3]!, 0];
      for (let k = 0; k < 3; k++) {
        p += rows.values[row + k]! * place[3 * v + k]!;
        n += rows.values[row + k]! * direction[3 * v + k]!;
      }
      positions[3 * v + axis] = p;
      normals[3 * v + axis] = n;
    }
    const length = Math.hypot(normals[3 * v]!, normals[3 * v + 1]!, normals[3 * v + 2]!) || 1;
    for (let axis = 0; axis < 3; axis++) normals[3 * v + axis]! /= length;
    if (slot[v]! < RIGID_SLOTS.length) {
      joints[4 * v] = SLOT_JOINTS[slot[v]!]!;
      weights[4 * v] = 1;
    } else {
      const share = chestShare(slot[v]! - RIGID_SLOTS.length);
      // The ends have one joint: a joint without weight must be 0.
      joints[4 * v] = share === 1 ? JOINT.chest : JOINT.hips;
      joints[4 * v + 1] = share > 0 && share < 1 ? JOINT.chest : 0;
      weights[4 * v] = share === 1 ? 1 : 1 - share;
      weights[4 * v + 1] = share === 1 ? 0 : share;
    }
  }
  const groups = runs.map(({ start, count }) => indices.slice(start, start + count));
  const rest = rows.world.positions.slice();
  return { positions, normals, joints, weights, groups, rest };
}

/** Colour of a tone, linear as glTF has it. */
function linear(hex: string): [number, number, number, number] {
  const channel = (i: number) => {
    const value = Number.parseInt(hex.slice(1 + 2 * i, 3 + 2 * i), 16) / 255;
    return value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
  };
  return [channel(0), channel(1), channel(2), 1];
}

/** Writes the file. @throws RangeError unless there are 63 proportions */
export function mannequinGlb(animation: HumanoidAnimation): Uint8Array<ArrayBuffer> {
  const fit = fitTo(animation.proportions);
  const mesh = bindMesh(fit);
  const buffer = new BufferBuilder();
  const attributes = {
    POSITION: buffer.add(mesh.positions, "VEC3", true),
    NORMAL: buffer.add(mesh.normals, "VEC3"),
    JOINTS_0: buffer.add(mesh.joints, "VEC4"),
    WEIGHTS_0: buffer.add(mesh.weights, "VEC4"),
  };
  const primitives = mesh.groups.map((indices, material) => ({
    attributes,
    indices: buffer.add(indices, "SCALAR"),
    material,
  }));
  const inverseBindMatrices = buffer.add(inverseBind(mesh.rest), "MAT4");
  const materials = TONES.map((tone) => ({
    name: tone,
    pbrMetallicRoughness: {
      baseColorFactor: linear(TONE_COLOURS.light[tone]),
      metallicFactor: 0,
      roughnessFactor: 0.56,
    },
  }));
  const content = {
    scene: 0,
    scenes: [{ nodes: [0, JOINTS] }],
    nodes: [...jointNodes(ROLES, mesh.rest.subarray(0, 3), fit.proportions), { name: "mannequin", mesh: 0, skin: 0 }],
    meshes: [{ name: "mannequin", primitives }],
    materials,
    skins: [{ joints: ROLES.map((_, j) => j), skeleton: 0, inverseBindMatrices }],
    animations: [jointAnimation(buffer, animation)],
  };
  return glbFile(content, buffer);
}

/** From the world of the T-pose to every joint, 21 × 4 × 4, column-major: translations, as no joint is turned there. */
function inverseBind(rest: Float32Array): Float32Array {
  const matrices = new Float32Array(16 * JOINTS);
  for (let j = 0; j < JOINTS; j++) {
    for (let k = 0; k < 4; k++) matrices[16 * j + 5 * k] = 1;
    for (let axis = 0; axis < 3; axis++) matrices[16 * j + 12 + axis] = -rest[3 * j + axis]!;
  }
  return matrices;
}
