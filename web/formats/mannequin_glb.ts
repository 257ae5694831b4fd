/**
 * The mannequin with an animation as a binary glTF 2.0 file, which Blender, Unreal, Unity and three.js open: one skinned
 * mesh in two tones, the 21 joints of the canonical humanoid as its skeleton, and one key a frame.
 */

import { JOINT, JOINTS, PARENTS, POSE_FLOATS, ROLES, restPose } from "../humanoid";
import { TONE_COLOURS } from "../mannequin/colours";
import { fitTo } from "../mannequin/fit";
import { buildMesh, TONES } from "../mannequin/mesh";
import { SlotRows } from "../mannequin/slot_rows";
import { RIGID_SLOTS, SLOT_JOINTS } from "../mannequin/slots";
import { WAIST_RINGS } from "../mannequin/waist";

/** An animation of the mannequin. */
export interface MannequinAnimation {
  name: string;
  /** Bone offsets, 21 × xyz, metres. */
  proportions: ArrayLike<number>;
  /** `POSE_FLOATS` numbers a frame. */
  poses: Float32Array;
  /** Time of each frame, seconds, rising; they need not be evenly spaced. */
  times: Float32Array;
}

const [FLOAT, UINT8, UINT16] = [5126, 5121, 5123];
const MAGIC = 0x46546c67;
const [JSON_CHUNK, BINARY_CHUNK] = [0x4e4f534a, 0x004e4942];

type Values = Float32Array | Uint16Array | Uint8Array;

/** Collects the buffer and what is in it. */
class BufferBuilder {
  readonly views: object[] = [];
  readonly accessors: object[] = [];
  readonly #parts: Uint8Array[] = [];
  length = 0;

  /** Adds an array and gives the number of its accessor. */
  add(values: Values, type: string, width: number, bounds = false): number {
    const bytes = new Uint8Array(values.buffer, values.byteOffset, values.byteLength);
    this.views.push({ buffer: 0, byteOffset: this.length, byteLength: bytes.length });
    this.#parts.push(bytes);
    this.length += bytes.length;
    const padding = -this.length & 3;
    this.#parts.push(new Uint8Array(padding));
    this.length += padding;
    const componentType = values instanceof Float32Array ? FLOAT : values instanceof Uint16Array ? UINT16 : UINT8;
    const accessor = { bufferView: this.views.length - 1, componentType, count: values.length / width, type };
    this.accessors.push(bounds ? { ...accessor, ...boundsOf(values, width) } : accessor);
    return this.accessors.length - 1;
  }

  write(out: Uint8Array, offset: number): void {
    let at = offset;
    for (const part of this.#parts) {
      out.set(part, at);
      at += part.length;
    }
  }
}

function boundsOf(values: Values, width: number): { min: number[]; max: number[] } {
  const [min, max] = [new Array<number>(width).fill(Infinity), new Array<number>(width).fill(-Infinity)];
  values.forEach((value, i) => {
    min[i % width] = Math.min(min[i % width]!, value);
    max[i % width] = Math.max(max[i % width]!, value);
  });
  return { min, max };
}

/** Weight of the ribcage on each ring of the waist: the others follow the pelvis. */
const chestShare = (ring: number): number => ring / (WAIST_RINGS - 1);

/** Level of detail of the mesh in the file. */
const DETAIL = 0.6;

/** The mesh in the T-pose, with joints and weights of every vertex. */
function bindMesh(proportions: ArrayLike<number>): {
  positions: Float32Array;
  normals: Float32Array;
  joints: Uint8Array;
  weights: Float32Array;
  groups: { indices: Uint16Array; tone: number }[];
  rest: Float32Array;
} {
  const fit = fitTo(proportions);
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
  const groups = runs.map(({ start, count }, tone) => ({ indices: indices.slice(start, start + count), tone }));
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

/** Writes the file. */
export function mannequinGlb({ name, proportions, poses, times }: MannequinAnimation): Uint8Array<ArrayBuffer> {
  const { proportions: offsets } = fitTo(proportions);
  const mesh = bindMesh(proportions);
  const buffer = new BufferBuilder();
  const attributes = {
    POSITION: buffer.add(mesh.positions, "VEC3", 3, true),
    NORMAL: buffer.add(mesh.normals, "VEC3", 3),
    JOINTS_0: buffer.add(mesh.joints, "VEC4", 4),
    WEIGHTS_0: buffer.add(mesh.weights, "VEC4", 4),
  };
  const primitives = mesh.groups.map(({ indices, tone }) => ({
    attributes,
    indices: buffer.add(indices, "SCALAR", 1),
    material: tone,
  }));
  const inverseBind = new Float32Array(16 * JOINTS);
  for (let j = 0; j < JOINTS; j++) {
    for (let k = 0; k < 4; k++) inverseBind[16 * j + 5 * k] = 1;
    for (let axis = 0; axis < 3; axis++) inverseBind[16 * j + 12 + axis] = -mesh.rest[3 * j + axis]!;
  }
  const inverseBindMatrices = buffer.add(inverseBind, "MAT4", 16);
  const children = ROLES.map((_, j) => PARENTS.flatMap((parent, child) => (parent === j ? [child] : [])));
  const joints = ROLES.map((role, j) => ({
    name: role,
    translation: j === 0 ? [...mesh.rest.subarray(0, 3)] : [0, 1, 2].map((axis) => offsets[3 * j + axis]!),
    ...(children[j]!.length > 0 ? { children: children[j] } : {}),
  }));
  const materials = TONES.map((tone) => ({
    name: tone,
    pbrMetallicRoughness: {
      baseColorFactor: linear(TONE_COLOURS.light[tone]),
      metallicFactor: 0,
      roughnessFactor: 0.56,
    },
  }));
  const document = {
    asset: { version: "2.0", generator: "Strut" },
    scene: 0,
    scenes: [{ nodes: [0, JOINTS] }],
    nodes: [...joints, { name: "mannequin", mesh: 0, skin: 0 }],
    meshes: [{ name: "mannequin", primitives }],
    materials,
    skins: [{ joints: ROLES.map((_, j) => j), skeleton: 0, inverseBindMatrices }],
    animations: [animation(buffer, name, poses, times)],
    bufferViews: buffer.views,
    accessors: buffer.accessors,
    buffers: [{ byteLength: buffer.length }],
  };
  return container(document, buffer);
}

/** One translation of the hips and one rotation a joint. */
function animation(buffer: BufferBuilder, name: string, poses: Float32Array, times: Float32Array): object {
  const frames = times.length;
  const input = buffer.add(times, "SCALAR", 1, true);
  const samplers: object[] = [];
  const channels: object[] = [];
  const add = (node: number, path: string, values: Float32Array, type: string, width: number) => {
    samplers.push({ input, output: buffer.add(values, type, width), interpolation: "LINEAR" });
    channels.push({ sampler: samplers.length - 1, target: { node, path } });
  };
  const roots = new Float32Array(3 * frames);
  for (let f = 0; f < frames; f++) roots.set(poses.subarray(f * POSE_FLOATS, f * POSE_FLOATS + 3), 3 * f);
  add(0, "translation", roots, "VEC3", 3);
  for (let j = 0; j < JOINTS; j++) {
    const rotations = new Float32Array(4 * frames);
    for (let f = 0; f < frames; f++) {
      const at = f * POSE_FLOATS + 3 + 4 * j;
      const length = Math.hypot(poses[at]!, poses[at + 1]!, poses[at + 2]!, poses[at + 3]!) || 1;
      for (let k = 0; k < 4; k++) rotations[4 * f + k] = poses[at + k]! / length;
    }
    add(j, "rotation", rotations, "VEC4", 4);
  }
  return { name, samplers, channels };
}

function container(document: object, buffer: BufferBuilder): Uint8Array<ArrayBuffer> {
  const text = new TextEncoder().encode(JSON.stringify(document));
  const textLength = text.length + (-text.length & 3);
  const total = 12 + 8 + textLength + 8 + buffer.length;
  const out = new Uint8Array(total);
  const view = new DataView(out.buffer);
  [MAGIC, 2, total, textLength, JSON_CHUNK].forEach((word, i) => {
    view.setUint32(4 * i, word, true);
  });
  out.fill(0x20, 20, 20 + textLength);
  out.set(text, 20);
  view.setUint32(20 + textLength, buffer.length, true);
  view.setUint32(24 + textLength, BINARY_CHUNK, true);
  buffer.write(out, 28 + textLength);
  return out;
}
