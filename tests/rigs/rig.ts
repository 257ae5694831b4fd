/**
 * Rigged characters made from the mannequin, as real files: they resemble real families of rigs, and their ground truth
 * is known.
 */
import { Matrix4, Quaternion, Vector3 } from "three";
import { chunksOf } from "../../web/character/glb_patch";
import { vrmBone } from "../../web/character/vrm_humanoid";
import { BufferBuilder, glbFile } from "../../web/formats/glb";
import { mannequinGlb } from "../../web/formats/mannequin_glb";
import { DEFAULT_PROPORTIONS, JOINT, PARENTS, ROLES, restPose } from "../../web/humanoid";
import { FAMILIES, type Family, mirroredName } from "./families";

/** A character and its ground truth. */
export interface Rig {
  readonly family: Family;
  readonly glb: Uint8Array<ArrayBuffer>;
  /** World rotation of the joint of each role in the T-pose facing +Z. */
  readonly rest: readonly Quaternion[];
  /** Length of its legs relative to the mannequin's. */
  readonly legRatio: number;
}

/** Changes of a file, for tests of refused files. */
export interface Changes {
  /** Changes the document before it is written. */
  document?: (document: GltfDocument) => void;
}

/** The parts of a glTF document that are made here. */
export interface GltfDocument {
  asset: Record<string, unknown>;
  nodes: Record<string, unknown>[];
  skins: Record<string, unknown>[];
  extensions?: Record<string, Record<string, unknown>>;
  [key: string]: unknown;
}

/** The mannequin's skin in the T-pose, in plain arrays. */
interface Skin {
  positions: Float32Array;
  normals: Float32Array;
  joints: Uint8Array;
  weights: Float32Array;
  indices: Uint16Array;
}

/** One joint of a rig; positions are in the bind pose, world. */
interface RigJoint {
  name: string;
  parent: number;
  position: Vector3;
  rotation: Quaternion;
}

/** Makes the rig of a family. */
export function makeRig(family: Family, { document }: Changes = {}): Rig {
  const skin = mannequinSkin();
  const body = shaped(family, skin);
  const turns = posed(family);
  const facing = new Quaternion().setFromAxisAngle(new Vector3(0, 1, 0), family.facesAway ? Math.PI : 0);
  const rest = ROLES.map((_, j) => restFrame(family, body.positions, j, facing));
  place(body, turns, facing);
  const joints = jointsOf(family, body.positions, turns, rest, facing);
  const content = documentOf(family, joints, body, skin.indices);
  document?.(content.document);
  const leg = (p: ArrayLike<number>, j: number) => Math.hypot(p[3 * j]!, p[3 * j + 1]!, p[3 * j + 2]!);
  const [knee, foot] = [JOINT.left_lower_leg, JOINT.left_foot];
  const own = body.lengths[knee]! + body.lengths[foot]!;
  return {
    family,
    glb: glbFile(content.document, content.buffer),
    rest,
    legRatio: own / (leg(DEFAULT_PROPORTIONS, knee) + leg(DEFAULT_PROPORTIONS, foot)),
  };
}

/** Returns all eight rigs. */
export const rigs = (): Rig[] => FAMILIES.map((family) => makeRig(family));

function mannequinSkin(): Skin {
  const animation = { name: "", proportions: DEFAULT_PROPORTIONS, poses: restPose(), times: new Float32Array(1) };
  const { json, binary } = chunksOf(mannequinGlb(animation));
  const { accessors, bufferViews, meshes } = json as unknown as {
    accessors: { bufferView: number; count: number }[];
    bufferViews: { byteOffset: number; byteLength: number }[];
    meshes: { primitives: { attributes: Record<string, number>; indices: number }[] }[];
  };
  const bytes = (accessor: number) => {
    const { byteOffset, byteLength } = bufferViews[accessors[accessor]!.bufferView]!;
    return binary.slice(byteOffset, byteOffset + byteLength);
  };
  const { primitives } = meshes[0]!;
  const { POSITION, NORMAL, JOINTS_0, WEIGHTS_0 } = primitives[0]!.attributes;
  const floats = (accessor: number | undefined) => new Float32Array(bytes(accessor!).buffer);
  return {
    positions: floats(POSITION),
    normals: floats(NORMAL),
    joints: bytes(JOINTS_0!),
    weights: floats(WEIGHTS_0),
    indices: Uint16Array.from(primitives.flatMap(({ indices }) => [...new Uint16Array(bytes(indices).buffer)])),
  };
}

/** Returns the body in the T-pose: joints and skin, with the family's proportions. */
function shaped({ size, shape }: Family, skin: Skin) {
  const before: Vector3[] = [];
  const positions: Vector3[] = [];
  const factors: number[] = [];
  for (const [j, role] of ROLES.entries()) {
    const parent = PARENTS[j]!;
    const offset = new Vector3().fromArray(DEFAULT_PROPORTIONS, 3 * j);
    factors.push((parent < 0 ? size : factors[parent]!) * (shape[role] ?? 1));
    before.push(parent < 0 ? offset : before[parent]!.clone().add(offset));
    positions.push(
      parent < 0
        ? offset.clone().multiplyScalar(size)
        : offset.clone().multiplyScalar(factors[parent]!).add(positions[parent]!),
    );
  }
  const lengths = positions.map((p, j) => (PARENTS[j]! < 0 ? 0 : p.distanceTo(positions[PARENTS[j]!]!)));
  const vertices = eachVertex(skin, (v, joint, out) =>
    out.copy(v).sub(before[joint]!).multiplyScalar(factors[joint]!).add(positions[joint]!),
  );
  return { ...skin, positions, lengths, vertices, normals: skin.normals.slice() };
}

type Body = ReturnType<typeof shaped>;

/** Moves every vertex of the skin by its joints. */
function eachVertex(
  { positions, joints, weights }: Skin,
  move: (v: Vector3, joint: number, out: Vector3) => void,
): Float32Array {
  const out = new Float32Array(positions.length);
  const [v, moved, sum] = [new Vector3(), new Vector3(), new Vector3()];
  for (let i = 0; i < positions.length / 3; i++) {
    v.fromArray(positions, 3 * i);
    sum.set(0, 0, 0);
    for (let k = 0; k < 4; k++) {
      if (weights[4 * i + k] === 0) continue;
      move(v, joints[4 * i + k]!, moved);
      sum.addScaledVector(moved, weights[4 * i + k]!);
    }
    sum.toArray(out, 3 * i);
  }
  return out;
}

/** Returns the world rotation of every joint from the T-pose to the bind pose. */
function posed({ pose }: Family): Quaternion[] {
  const about = (degrees: number) => new Quaternion().setFromAxisAngle(new Vector3(0, 0, 1), (degrees * Math.PI) / 180);
  return ROLES.map((role) => {
    if (pose === "T") return new Quaternion();
    const sign = role.startsWith("left") ? 1 : -1;
    if (/upper_arm|lower_arm|hand/.test(role)) return about(-45 * sign);
    if (/shoulder/.test(role)) return about(-5 * sign);
    return /upper_leg|lower_leg/.test(role) ? about(4 * sign) : new Quaternion();
  });
}

/** Moves joints and skin to the bind pose, standing on the ground and facing the family's direction. */
function place(body: Body, turns: readonly Quaternion[], facing: Quaternion): void {
  const before = body.positions.map((p) => p.clone());
  for (const [j, parent] of PARENTS.entries())
    if (parent >= 0)
      body.positions[j]!.copy(before[j]!)
        .sub(before[parent]!)
        .applyQuaternion(turns[parent]!)
        .add(body.positions[parent]!);
  body.vertices = eachVertex({ ...body, positions: body.vertices }, (v, joint, out) =>
    out.copy(v).sub(before[joint]!).applyQuaternion(turns[joint]!).add(body.positions[joint]!),
  );
  let lowest = Infinity;
  for (let i = 1; i < body.vertices.length; i += 3) lowest = Math.min(lowest, body.vertices[i]!);
  const point = new Vector3();
  for (let i = 0; i < body.vertices.length; i += 3) {
    point.fromArray(body.vertices, i);
    point.y -= lowest;
    point.applyQuaternion(facing).toArray(body.vertices, i);
    point.fromArray(body.normals, i).applyQuaternion(facing).toArray(body.normals, i);
  }
  for (const position of body.positions) {
    position.y -= lowest;
    position.applyQuaternion(facing);
  }
}

/** Returns the frame of a joint in the T-pose, with the family's bone axes. */
function restFrame({ axes }: Family, positions: readonly Vector3[], joint: number, facing: Quaternion): Quaternion {
  if (axes === "world") return facing.clone().invert();
  const role = ROLES[joint]!;
  const right = role.startsWith("right");
  const child = role === "chest" ? JOINT.neck : PARENTS.indexOf(joint);
  const direction = /toes/.test(role)
    ? new Vector3(0, 0, 1)
    : /hand/.test(role)
      ? new Vector3(right ? -1 : 1, 0, 0)
      : child < 0
        ? new Vector3(0, 1, 0)
        : positions[child]!.clone().sub(positions[joint]!).normalize();
  const along = axes === "y" ? new Vector3(0, 1, 0) : new Vector3(axes === "mirrored x" && right ? -1 : 1, 0, 0);
  const roll = new Quaternion().setFromAxisAngle(along, axes === "y" ? 0 : Math.PI / 2);
  return new Quaternion().setFromUnitVectors(along, direction).multiply(roll);
}

/** Returns the joints of the file, parents first. */
function jointsOf(
  family: Family,
  positions: readonly Vector3[],
  turns: readonly Quaternion[],
  rest: readonly Quaternion[],
  facing: Quaternion,
): { joints: RigJoint[]; ofRole: number[] } {
  const joints: RigJoint[] = [];
  const add = (name: string, parent: number, position: Vector3, rotation: Quaternion) =>
    joints.push({ name, parent, position, rotation }) - 1;
  const bind = (j: number) => facing.clone().multiply(turns[j]!).multiply(rest[j]!);
  const ofRole: number[] = [];
  const root = family.root === undefined ? -1 : add(family.root, -1, new Vector3(), new Quaternion());
  for (const [j, role] of ROLES.entries()) {
    let parent = j === 0 ? root : ofRole[PARENTS[j]!]!;
    if (family.isBiped && /upper_leg/.test(role)) parent = ofRole[JOINT.spine]!;
    if (family.isBiped && /shoulder/.test(role)) parent = ofRole[JOINT.neck]!;
    if (role === "chest")
      for (const [i, name] of family.trunk.entries()) {
        const share = (i + 1) / (family.trunk.length + 1);
        parent = add(name, parent, positions[JOINT.spine]!.clone().lerp(positions[j]!, share), bind(JOINT.spine));
      }
    ofRole.push(add(family.joints[j]!, parent, positions[j]!, bind(j)));
  }
  for (const [hand, naming] of [
    [JOINT.left_hand, (name: string) => name],
    [JOINT.right_hand, mirroredName],
  ] as const) {
    const elbow = positions[PARENTS[hand]!]!;
    const along = positions[hand]!.clone().sub(elbow).multiplyScalar(0.12);
    let parent = ofRole[hand]!;
    for (const name of family.finger)
      parent = add(naming(name), parent, joints[parent]!.position.clone().add(along), bind(hand));
  }
  const lock = new Vector3(0, -0.04, -0.06).applyQuaternion(facing);
  let strand = ofRole[JOINT.head]!;
  for (const name of family.hair)
    strand = add(name, strand, joints[strand]!.position.clone().add(lock), bind(JOINT.head));
  return { joints, ofRole };
}

function documentOf(
  family: Family,
  { joints, ofRole }: { joints: RigJoint[]; ofRole: number[] },
  body: Body,
  indices: Uint16Array,
): { document: GltfDocument; buffer: BufferBuilder } {
  const { metresPerUnit: unit, armature } = family;
  const world = new Matrix4().compose(new Vector3(), armature, new Vector3(unit, unit, unit));
  const inside = world.clone().invert();
  const matrices = joints.map(({ position, rotation }) =>
    new Matrix4().compose(
      position.clone().applyMatrix4(inside),
      armature.clone().invert().multiply(rotation),
      new Vector3(1, 1, 1),
    ),
  );
  const inverses = new Float32Array(16 * joints.length);
  const nodes: GltfDocument["nodes"] = joints.map(({ name, parent }, j) => {
    const inverse = matrices[j]!.clone().invert();
    inverse.elements[15] = 1;
    [inverse.elements[3], inverse.elements[7], inverse.elements[11]] = [0, 0, 0];
    inverses.set(inverse.elements, 16 * j);
    const local = parent < 0 ? matrices[j]! : matrices[parent]!.clone().invert().multiply(matrices[j]!);
    const [t, r, s] = [new Vector3(), new Quaternion(), new Vector3()];
    local.decompose(t, r, s);
    const children = joints.flatMap((joint, child) => (joint.parent === j ? [child] : []));
    return { name, translation: t.toArray(), rotation: r.toArray(), ...(children.length > 0 ? { children } : {}) };
  });
  const point = new Vector3();
  const vertices = body.vertices.slice();
  const normals = body.normals.slice();
  for (let i = 0; i < vertices.length; i += 3) {
    point.fromArray(vertices, i).applyMatrix4(inside).toArray(vertices, i);
    point.fromArray(normals, i).applyQuaternion(armature.clone().invert()).normalize().toArray(normals, i);
  }
  const buffer = new BufferBuilder();
  const attributes = {
    POSITION: buffer.add(vertices, "VEC3", true),
    NORMAL: buffer.add(normals, "VEC3"),
    JOINTS_0: buffer.add(
      body.joints.map((joint, i) => (body.weights[i]! > 0 ? ofRole[joint]! : 0)),
      "VEC4",
    ),
    WEIGHTS_0: buffer.add(body.weights, "VEC4"),
  };
  const roots = joints.flatMap(({ parent }, j) => (parent < 0 ? [j] : []));
  const document: GltfDocument = {
    asset: { version: "2.0", generator: "Strut's tests" },
    scene: 0,
    scenes: [{ nodes: [joints.length] }],
    nodes: [
      ...nodes,
      {
        name: "Armature",
        rotation: armature.toArray(),
        scale: [unit, unit, unit],
        children: [...roots, joints.length + 1],
      },
      { name: "Body", mesh: 0, skin: 0 },
    ],
    meshes: [{ name: "Body", primitives: [{ attributes, indices: buffer.add(indices, "SCALAR") }] }],
    skins: [{ joints: joints.map((_, j) => j), inverseBindMatrices: buffer.add(inverses, "MAT4") }],
  };
  if (family.vrm !== undefined) addVrm(document, family, joints, ofRole);
  return { document, buffer };
}

/** Adds VRM's humanoid, a meta that allows everything, and simulated hair. */
function addVrm(document: GltfDocument, { vrm, trunk, hair }: Family, joints: RigJoint[], ofRole: number[]): void {
  const bones = ROLES.map((role, j): [string, number] => [
    role === "chest" && trunk.length > 0 ? "upperChest" : vrmBone(role),
    ofRole[j]!,
  ]);
  if (trunk.length > 0) bones.push(["chest", joints.findIndex(({ name }) => name === trunk[0])]);
  const lock = hair.map((name) => joints.findIndex((joint) => joint.name === name));
  const swing = { hitRadius: 0.02, gravityPower: 0.2, dragForce: 0.4 };
  document.extensionsUsed = vrm === 1 ? ["VRMC_vrm", "VRMC_springBone"] : ["VRM"];
  document.extensions =
    vrm === 1
      ? {
          VRMC_vrm: {
            specVersion: "1.0",
            meta: {
              name: "Mannequin",
              authors: ["Strut"],
              licenseUrl: "https://vrm.dev/licenses/1.0/",
              avatarPermission: "everyone",
              modification: "allowModificationRedistribution",
              allowRedistribution: true,
              creditNotation: "required",
            },
            humanoid: { humanBones: Object.fromEntries(bones.map(([bone, node]) => [bone, { node }])) },
          },
          VRMC_springBone: {
            specVersion: "1.0",
            springs: [{ joints: lock.map((node) => ({ node, ...swing, stiffness: 0.5, gravityDir: [0, -1, 0] })) }],
          },
        }
      : {
          VRM: {
            specVersion: "0.0",
            meta: { title: "Mannequin", author: "Strut", allowedUserName: "Everyone", licenseName: "CC_BY" },
            humanoid: { humanBones: bones.map(([bone, node]) => ({ bone, node, useDefaultValues: true })) },
            secondaryAnimation: {
              // The format has this misspelling.
              boneGroups: [
                { ...swing, stiffiness: 0.5, gravityDir: { x: 0, y: -1, z: 0 }, center: -1, bones: lock.slice(0, 1) },
              ],
              colliderGroups: [],
            },
          },
        };
}
