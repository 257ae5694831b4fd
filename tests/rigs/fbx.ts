/**
 * FBX 7.4, binary: a rig as Mixamo writes it. Its joints are in centimetres without an armature, their rest is a
 * `PreRotation`, and two meshes follow the same joints.
 */
import { type AnimationClip, Euler, Matrix4, PropertyBinding, Quaternion, Vector3 } from "three";
import { chunksOf } from "../../web/character/glb_patch";
import type { Family } from "./families";
import { makeRig } from "./rig";

/** Ticks per second. */
const TICKS = 46_186_158_000n;

/** Options of the file. */
export interface FbxOptions {
  version?: number;
  /** Centimetres per unit, as written in the file. */
  unitScaleFactor?: number;
  /** A clip of the joints of the rig, not of a VRM's normalized bones. */
  clip?: AnimationClip;
  /** Whether there are meshes, Mixamo's option "With Skin"; `true` unless given. */
  skin?: boolean;
}

/** A value of a record: an integer is an int64, a `Float` a double. */
type Property = bigint | string | Float64Array | Float32Array | Int32Array | BigInt64Array | { int: number } | number;

/** A record of the file. */
interface Node {
  name: string;
  properties: Property[];
  children: Node[];
}

const node = (name: string, properties: Property[] = [], children: Node[] = []): Node => ({
  name,
  properties,
  children,
});

/** A property of an object, of type double. */
const p70 = (name: string, type: string, ...values: Property[]) => node("P", [name, type, "", "A", ...values]);

const object = (kind: string, id: bigint, name: string, of: string, type: string, children: Node[] = []) =>
  node(kind, [id, `${name}\0\x01${of}`, type], children);

const IDENTITY = Float64Array.from(new Matrix4().elements);

/** Writes the file of a family, without its armature. */
export function fbxFile(
  family: Family,
  { version = 7400, unitScaleFactor = 1, clip, skin: isSkinned = true }: FbxOptions = {},
) {
  const rig = read(family);
  const ids = (first: number) => (i: number) => BigInt(first + i);
  const [model, cluster, curve] = [ids(1000), ids(2000), ids(10_000)];
  const objects: Node[] = [];
  const links: Node[] = [];
  const link = (child: bigint, parent: bigint, property?: string) =>
    links.push(node("C", property === undefined ? ["OO", child, parent] : ["OP", child, parent, property]));

  for (const [j, { name, parent, translation, rotation }] of rig.joints.entries()) {
    const properties = [
      node("P", ["InheritType", "enum", "", "", { int: 1 }]),
      p70("PreRotation", "Vector3D", ...degrees(rotation)),
      p70("Lcl Translation", "Lcl Translation", ...translation.toArray()),
      p70("Lcl Rotation", "Lcl Rotation", 0, 0, 0),
    ];
    objects.push(object("Model", model(j), name, "Model", "LimbNode", [node("Properties70", [], properties)]));
    link(model(j), parent < 0 ? 0n : model(parent));
  }

  for (const [m, triangles] of isSkinned ? rig.meshes.entries() : []) {
    const [geometry, body, skin] = [BigInt(100 + m), BigInt(200 + m), BigInt(300 + m)];
    const name = ["Body", "Joints"][m]!;
    const polygons = triangles.map((vertex, i) => (i % 3 === 2 ? ~vertex : vertex));
    objects.push(
      object("Geometry", geometry, name, "Geometry", "Mesh", [
        node("Vertices", [Float64Array.from(rig.positions)]),
        node("PolygonVertexIndex", [polygons]),
      ]),
      object("Model", body, name, "Model", "Mesh"),
      object("Deformer", skin, "", "Deformer", "Skin"),
    );
    link(geometry, body);
    link(body, 0n);
    link(skin, geometry);
    for (const [j, { matrix }] of rig.joints.entries()) {
      const id = cluster(1000 * m + j);
      const { indices, weights } = rig.weightsOf(j);
      objects.push(
        object("Deformer", id, "", "SubDeformer", "Cluster", [
          node("Indexes", [indices]),
          node("Weights", [weights]),
          node("Transform", [IDENTITY]),
          node("TransformLink", [Float64Array.from(matrix.elements)]),
        ]),
      );
      link(id, skin);
      link(model(j), id);
    }
  }

  if (clip) {
    const [stack, layer] = [1n, 2n];
    objects.push(object("AnimationStack", stack, clip.name, "AnimStack", ""));
    objects.push(object("AnimationLayer", layer, "Base", "AnimLayer", ""));
    link(stack, 0n);
    link(layer, stack);
    let next = 0;
    for (const track of clip.tracks) {
      const [target, path] = track.name.split(".") as [string, string];
      const j = rig.joints.findIndex(({ name }) => PropertyBinding.sanitizeNodeName(name) === target);
      const turns = path === "quaternion";
      const channels = turns ? turnsFrom(rig.joints[j]!.rotation, track.values) : axesOf(track.values);
      const curves = curve(next++);
      objects.push(object("AnimationCurveNode", curves, turns ? "R" : "T", "AnimCurveNode", ""));
      link(curves, layer);
      link(curves, model(j), turns ? "Lcl Rotation" : "Lcl Translation");
      for (const [axis, values] of channels.entries()) {
        const id = curve(next++);
        objects.push(
          object("AnimationCurve", id, "", "AnimCurve", "", [
            node("KeyTime", [BigInt64Array.from(track.times, (time) => BigInt(Math.round(time * Number(TICKS))))]),
            node("KeyValueFloat", [Float32Array.from(values)]),
          ]),
        );
        link(id, curves, `d|${"XYZ"[axis]}`);
      }
    }
  }

  const settings = [
    // Without its turned armature the rig stands along +Z.
    node("P", ["UpAxis", "int", "Integer", "", { int: family.armature.w === 1 ? 1 : 2 }]),
    node("P", ["UnitScaleFactor", "double", "Number", "", unitScaleFactor]),
  ];
  return encoded(version, [
    node("FBXHeaderExtension", [], [node("FBXVersion", [{ int: version }])]),
    node("GlobalSettings", [], [node("Properties70", [], settings)]),
    node("Objects", [], objects),
    node("Connections", [], links),
  ]);
}

/** Returns the rig of a family as in its GLB, without the armature. */
function read(family: Family) {
  const { json, binary } = chunksOf(makeRig(family).glb);
  const { nodes, skins, meshes, accessors, bufferViews } = json as unknown as {
    nodes: { name: string; translation: number[]; rotation: number[]; children?: number[] }[];
    skins: { joints: number[]; inverseBindMatrices: number }[];
    meshes: { primitives: { attributes: Record<string, number>; indices: number }[] }[];
    accessors: { bufferView: number }[];
    bufferViews: { byteOffset: number; byteLength: number }[];
  };
  const bytes = (accessor: number) => {
    const { byteOffset, byteLength } = bufferViews[accessors[accessor]!.bufferView]!;
    return binary.slice(byteOffset, byteOffset + byteLength);
  };
  const { attributes, indices } = meshes[0]!.primitives[0]!;
  const inverses = new Float32Array(bytes(skins[0]!.inverseBindMatrices).buffer);
  const joints = skins[0]!.joints.map((j) => ({
    name: nodes[j]!.name,
    parent: skins[0]!.joints.findIndex((other) => nodes[other]!.children?.includes(j)),
    translation: new Vector3().fromArray(nodes[j]!.translation),
    rotation: new Quaternion().fromArray(nodes[j]!.rotation),
    matrix: new Matrix4().fromArray(inverses, 16 * j).invert(),
  }));
  const [owners, shares] = [bytes(attributes.JOINTS_0!), new Float32Array(bytes(attributes.WEIGHTS_0!).buffer)];
  const triangles = Int32Array.from(new Uint16Array(bytes(indices).buffer));
  const middle = 3 * Math.floor(triangles.length / 6);
  return {
    joints,
    positions: new Float32Array(bytes(attributes.POSITION!).buffer),
    meshes: [triangles.subarray(0, middle), triangles.subarray(middle)],
    weightsOf(joint: number) {
      const slots = [...owners.keys()].filter((i) => owners[i] === joint && shares[i]! > 0);
      return {
        indices: Int32Array.from(slots, (i) => i >> 2),
        weights: Float64Array.from(slots, (i) => shares[i]!),
      };
    },
  };
}

/** FBX rotates about X, then Y, then Z. */
function degrees(rotation: Quaternion): [number, number, number] {
  const { x, y, z } = new Euler().setFromQuaternion(rotation, "ZYX");
  return [x, y, z].map((angle) => (angle * 180) / Math.PI) as [number, number, number];
}

/** Returns rotations as angles from the rest; each angle is the equivalent one that is nearest to the one before. */
function turnsFrom(rest: Quaternion, values: ArrayLike<number>): number[][] {
  const angles: number[][] = [[], [], []];
  const back = rest.clone().invert();
  for (let i = 0; i < values.length; i += 4) {
    const turned = degrees(new Quaternion().fromArray(values as number[], i).premultiply(back));
    for (const [axis, angle] of turned.entries()) {
      const before = angles[axis]!.at(-1) ?? 0;
      angles[axis]!.push(angle + 360 * Math.round((before - angle) / 360));
    }
  }
  return angles;
}

const axesOf = (values: ArrayLike<number>): number[][] =>
  [0, 1, 2].map((axis) => Array.from(values).filter((_, i) => i % 3 === axis));

/** Returns the bytes of the records. */
function encoded(version: number, nodes: readonly Node[]): Uint8Array<ArrayBuffer> {
  const parts: Uint8Array[] = [];
  let length = 0;
  const put = (...bytes: Uint8Array[]) => {
    for (const each of bytes) length += parts.push(each) && each.length;
  };
  const text = (value: string) => Buffer.from(value, "latin1");
  const word = (value: number) => new Uint8Array(Uint32Array.of(value).buffer);
  const raw = (values: Exclude<Property, bigint | string | number | { int: number }> | Float64Array) =>
    new Uint8Array(values.buffer, values.byteOffset, values.byteLength);
  const property = (value: Property) => {
    if (typeof value === "string") put(text("S"), word(Buffer.byteLength(value, "latin1")), text(value));
    else if (typeof value === "bigint") put(text("L"), raw(BigInt64Array.of(value)));
    else if (typeof value === "number") put(text("D"), raw(Float64Array.of(value)));
    else if ("int" in value) put(text("I"), word(value.int));
    else {
      const type =
        value instanceof Float64Array
          ? "d"
          : value instanceof Float32Array
            ? "f"
            : value instanceof Int32Array
              ? "i"
              : "l";
      put(text(type), word(value.length), word(0), word(value.byteLength), raw(value));
    }
  };
  const record = ({ name, properties, children }: Node) => {
    const [end, listLength] = [new Uint8Array(4), new Uint8Array(4)];
    put(end, word(properties.length), listLength, Uint8Array.of(name.length), text(name));
    const start = length;
    for (const each of properties) property(each);
    listLength.set(word(length - start));
    for (const child of children) record(child);
    if (children.length > 0) put(new Uint8Array(13));
    end.set(word(length));
  };
  put(text("Kaydara FBX Binary  \0\x1a\0"), word(version));
  for (const each of nodes) record(each);
  // The end of the records, and a footer: 16 bytes of a mark, the version, and zeros.
  put(new Uint8Array(13), new Uint8Array(16));
  put(new Uint8Array(-length & 15), new Uint8Array(4), word(version), new Uint8Array(136));
  return Uint8Array.from(Buffer.concat(parts));
}
