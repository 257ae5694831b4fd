/**
 * The mannequin with an animation as a binary glTF 2.0 file, for Blender, Unreal, Unity and three.js: one skinned mesh
 * in two tones, the 21 joints of the canonical humanoid as its skeleton, and one key per frame.
 */

import { JOINT, JOINTS, ROLES, restPose } from "../humanoid";
import { TONE_COLOURS } from "../mannequin/colours";
import { fitTo } from "../mannequin/fit";
import { buildMesh, type MannequinMesh, TONES } from "../mannequin/mesh";
import { SlotRows } from "../mannequin/slot_rows";
import { RIGID_SLOTS, SLOT_JOINTS } from "../mannequin/slots";
import { WAIST_RINGS } from "../mannequin/waist";
import type { HumanoidAnimation } from "./animation";
import { BufferBuilder, glbFile } from "./glb";
import { jointAnimation, jointNodes } from "./humanoid_gltf";

/** Weight of the ribcage on each ring of the waist; the rest belongs to the pelvis. */
const chestShare = (ring: number): number => ring / (WAIST_RINGS - 1);

/** Level of detail of the mesh in the file. */
const DETAIL = 0.6;

/** Positions and unit normals of all vertices in the world, both xyz; positions in metres. */
function placeVertices(mesh: MannequinMesh, rows: Float32Array): { positions: Float32Array; normals: Float32Array } {
  const positions = new Float32Array(mesh.positions.length);
  const normals = new Float32Array(mesh.normals.length);
  for (const [v, slot] of mesh.slots.entries()) {
    for (let axis = 0; axis < 3; axis++) {
      const row = 12 * slot + 4 * axis;
      let [p, n] = [rows[row + 3]!, 0];
      for (let k = 0; k < 3; k++) {
        p += rows[row + k]! * mesh.positions[3 * v + k]!;
        n += rows[row + k]! * mesh.normals[3 * v + k]!;
      }
      positions[3 * v + axis] = p;
      normals[3 * v + axis] = n;
    }
    const length = Math.hypot(normals[3 * v]!, normals[3 * v + 1]!, normals[3 * v + 2]!) || 1;
    for (let axis = 0; axis < 3; axis++) normals[3 * v + axis]! /= length;
  }
  return { positions, normals };
}

/** Four joints per vertex and their weights, which sum to 1: one joint, or hips and chest at the waist. */
function skinVertices(slots: Uint8Array): { joints: Uint8Array; weights: Float32Array } {
  const joints = new Uint8Array(4 * slots.length);
  const weights = new Float32Array(4 * slots.length);
  for (const [v, slot] of slots.entries()) {
    if (slot < RIGID_SLOTS.length) {
      joints[4 * v] = SLOT_JOINTS[slot]!;
      weights[4 * v] = 1;
    } else {
      const share = chestShare(slot - RIGID_SLOTS.length);
      // The ends have one joint; the index of a joint without weight must be 0.
      joints[4 * v] = share === 1 ? JOINT.chest : JOINT.hips;
      joints[4 * v + 1] = share > 0 && share < 1 ? JOINT.chest : 0;
      weights[4 * v] = share === 1 ? 1 : 1 - share;
      weights[4 * v + 1] = share === 1 ? 0 : share;
    }
  }
  return { joints, weights };
}

/** Linear colour of a tone, as required by glTF. */
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
  const rest = new SlotRows();
  rest.setPose(fit, restPose());
  const restPositions = rest.world.positions;
  const mesh = buildMesh(DETAIL);
  const { positions, normals } = placeVertices(mesh, rest.values);
  const { joints, weights } = skinVertices(mesh.slots);
  const buffer = new BufferBuilder();
  const attributes = {
    POSITION: buffer.add(positions, "VEC3", true),
    NORMAL: buffer.add(normals, "VEC3"),
    JOINTS_0: buffer.add(joints, "VEC4"),
    WEIGHTS_0: buffer.add(weights, "VEC4"),
  };
  const primitives = mesh.groups.map(({ start, count }, material) => ({
    attributes,
    indices: buffer.add(mesh.indices.slice(start, start + count), "SCALAR"),
    material,
  }));
  const inverseBindMatrices = buffer.add(inverseBind(restPositions), "MAT4");
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
    nodes: [
      ...jointNodes(ROLES, restPositions.subarray(0, 3), fit.proportions),
      { name: "mannequin", mesh: 0, skin: 0 },
    ],
    meshes: [{ name: "mannequin", primitives }],
    materials,
    skins: [{ joints: ROLES.map((_, j) => j), skeleton: 0, inverseBindMatrices }],
    animations: [jointAnimation(buffer, animation)],
  };
  return glbFile(content, buffer);
}

/** From the world of the T-pose to every joint, 21 × 4 × 4, column-major: translations, because no joint is rotated there. */
function inverseBind(rest: Float32Array): Float32Array {
  const matrices = new Float32Array(16 * JOINTS);
  for (let j = 0; j < JOINTS; j++) {
    for (let k = 0; k < 4; k++) matrices[16 * j + 5 * k] = 1;
    for (let axis = 0; axis < 3; axis++) matrices[16 * j + 12 + axis] = -rest[3 * j + axis]!;
  }
  return matrices;
}
