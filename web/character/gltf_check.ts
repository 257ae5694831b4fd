/**
 * Checks a glTF document before three.js reads it: an accessor beyond its buffer would make it throw a `RangeError` at
 * best (`shared/spec/embedding.md` section 6).
 */
import { StrutError } from "../engine/errors";
import { isRecord } from "./vrm_humanoid";

/** Bytes of a component, by its type. */
const COMPONENT_BYTES: Readonly<Record<number, number>> = { 5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4 };
/** Components of an element, by its type. */
export const COMPONENTS: Readonly<Record<string, number>> = {
  SCALAR: 1,
  VEC2: 2,
  VEC3: 3,
  VEC4: 4,
  MAT2: 4,
  MAT3: 9,
  MAT4: 16,
};
/** Lists whose elements have names. */
const NAMED = ["scenes", "nodes", "meshes", "skins", "materials", "animations", "cameras", "textures", "images"];
/** Accessor type of an animation channel, by its path. */
const TYPE_OF_PATH: Readonly<Record<string, string>> = {
  translation: "VEC3",
  rotation: "VEC4",
  scale: "VEC3",
  weights: "SCALAR",
};
/** Maximum number of elements of an accessor: six indices per vertex of two million triangles. */
const MAX_COUNT = 12_000_000;
/** Maximum number of values in arrays without data, which are zero or compressed, and maximum number of decoded values. */
export const MAX_NUMBERS = 16_000_000;
/** Maximum number of nodes of a document: three.js takes seconds for more. */
const MAX_NODES = 16_384;
/** Deepest nesting of nodes: more would overflow the stack of recursive functions. */
const MAX_DEPTH = 1024;
/** Largest side of an image, pixels. */
const MAX_PIXELS = 8192;
/** The compression of meshes that `draco.ts` decodes. */
export const DRACO = "KHR_draco_mesh_compression";
/** The texture format for which three.js needs additional files. */
const KTX2 = "KHR_texture_basisu";
/** Compressions of arrays that three.js's own decoder reads. */
const PACKED = ["EXT_meshopt_compression", "KHR_meshopt_compression"];

/**
 * Checks a document and its references to its buffer.
 * @param binary the buffer in the file
 * @throws StrutError `bad-file` if it is invalid; the message says why
 */
export function checkGltf(json: Record<string, unknown>, binary: Uint8Array): void {
  const required = Array.isArray(json.extensionsRequired) ? (json.extensionsRequired as unknown[]) : [];
  if (required.includes(KTX2))
    throw broken(
      `The textures of this model are KTX2 files (${KTX2}), which cannot be read here.`,
      "Export it with textures of PNG, JPEG or WebP.",
    );
  // Names of other types make three.js fail with errors that cannot be caught.
  for (const list of NAMED)
    if (records(json, list).some(({ name }) => name !== undefined && typeof name !== "string"))
      throw broken("A name in this model is not a text.");
  const views = records(json, "bufferViews");
  for (const [i, buffer] of records(json, "buffers").entries()) {
    if (typeof buffer.uri === "string" && !buffer.uri.startsWith("data:"))
      throw broken("This model keeps a part of itself in another file.", "Export it as one .glb file.");
    if (i === 0 && buffer.uri === undefined && !(size(buffer.byteLength) <= binary.length))
      throw broken("This model declares more data than the file contains.");
  }
  for (const image of records(json, "images")) {
    if (typeof image.uri === "string" && !image.uri.startsWith("data:"))
      throw broken("This model keeps its textures in other files.", "Export it as one .glb file.");
    const view = views[Number(image.bufferView)];
    if (view && view.buffer === 0) checkImage(binary.subarray(Number(view.byteOffset ?? 0)));
  }
  const bufferBytes = records(json, "buffers").map(({ byteLength }) => size(byteLength));
  for (const view of views) {
    const end = size(view.byteOffset ?? 0) + size(view.byteLength);
    if (!(end <= (bufferBytes[Number(view.buffer)] ?? -1)))
      throw broken("A buffer view of this model is out of range.");
    for (const name of PACKED)
      checkPacked(isRecord(view.extensions) ? view.extensions[name] : undefined, view, bufferBytes);
  }
  const accessors = records(json, "accessors");
  let zeros = 0;
  for (const accessor of accessors) {
    checkAccessor(accessor, views);
    if (accessor.bufferView === undefined) zeros += size(accessor.count) * COMPONENTS[String(accessor.type)]!;
  }
  if (zeros > MAX_NUMBERS) throw broken("The arrays of this model are too long.");
  for (const animation of records(json, "animations")) checkAnimation(animation, accessors);
  checkNodes(records(json, "nodes"));
}

/** A packed array must lie in its buffer, and unpack to its declared size. */
function checkPacked(packed: unknown, view: Record<string, unknown>, bufferBytes: readonly number[]): void {
  if (packed === undefined) return;
  const { buffer, byteOffset, byteLength, byteStride, count } = isRecord(packed) ? packed : {};
  const end = size(byteOffset ?? 0) + size(byteLength);
  const isInside = end <= (bufferBytes[Number(buffer)] ?? -1);
  if (!isInside || !(size(count) * size(byteStride) <= size(view.byteLength)))
    throw broken("A compressed part of this model does not match its data.");
}

function checkAccessor(accessor: Record<string, unknown>, views: readonly Record<string, unknown>[]): void {
  const bytes = COMPONENT_BYTES[Number(accessor.componentType)];
  const components = COMPONENTS[String(accessor.type)];
  const count = size(accessor.count);
  if (bytes === undefined || components === undefined || !(count <= MAX_COUNT))
    throw broken("An array of this model has no type, or is too long.");
  if (accessor.bufferView === undefined) return;
  const view = views[Number(accessor.bufferView)];
  const element = bytes * components;
  const stride = view?.byteStride === undefined ? element : size(view.byteStride);
  const end = size(accessor.byteOffset ?? 0) + (count > 0 ? stride * (count - 1) + element : 0);
  if (!view || stride < element || !(end <= size(view.byteLength)))
    throw broken("An array of this model is longer than its data.");
}

/** Every key must have as many values as are animated: three.js's mixer steps by this number, and never ends otherwise. */
function checkAnimation(animation: Record<string, unknown>, accessors: readonly Record<string, unknown>[]): void {
  const samplers = records(animation, "samplers");
  for (const { sampler, target } of records(animation, "channels")) {
    const { node, path } = isRecord(target) ? target : {};
    if (node === undefined) continue;
    const { input, output } = samplers[Number(sampler)] ?? {};
    const [times, values] = [accessors[Number(input)], accessors[Number(output)]];
    const share = size(values?.count) / size(times?.count);
    if (times?.type !== "SCALAR" || values?.type !== TYPE_OF_PATH[String(path)] || !(share >= 1 && share % 1 === 0))
      throw broken("An animation of this model has the wrong number of values for its keyframes.");
  }
}

/** Nodes are a forest: every node has at most one parent and is not its own descendant. */
function checkNodes(nodes: readonly Record<string, unknown>[]): void {
  if (nodes.length > MAX_NODES) throw broken("This model has too many nodes.");
  const parents = new Int32Array(nodes.length).fill(-1);
  for (const [i, { children }] of nodes.entries())
    for (const child of Array.isArray(children) ? (children as unknown[]) : []) {
      const index = Number(child);
      if (!(index in parents) || parents[index] !== -1) throw broken("The nodes of this model do not form a tree.");
      parents[index] = i;
    }
  // In a cycle no node is without a parent, and following parents never ends.
  const depth = new Int32Array(nodes.length);
  for (let i = 0; i < nodes.length; i++) {
    const path: number[] = [];
    let above = i;
    for (; above >= 0 && depth[above] === 0; above = parents[above]!)
      if (path.push(above) > MAX_DEPTH) throw broken("The nodes of this model do not form a tree, or it is too deep.");
    let deep = above < 0 ? 0 : depth[above]!;
    for (const node of path.reverse()) depth[node] = ++deep;
    if (deep > MAX_DEPTH) throw broken("The nodes of this model do not form a tree, or it is too deep.");
  }
}

/** @throws StrutError `bad-file` if a PNG or JPEG image is larger than GPUs support */
function checkImage(bytes: Uint8Array): void {
  const { width, height } = pngSize(bytes) ?? jpegSize(bytes) ?? { width: 0, height: 0 };
  if (Math.max(width, height) <= MAX_PIXELS) return;
  throw broken(
    `A texture of this model has ${width} × ${height} pixels; at most ${MAX_PIXELS} can be shown.`,
    "Make its textures smaller.",
  );
}

interface Size {
  width: number;
  height: number;
}

function pngSize(bytes: Uint8Array): Size | undefined {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (bytes.length < 24 || view.getUint32(0) !== 0x89504e47) return undefined;
  return { width: view.getUint32(16), height: view.getUint32(20) };
}

/** The size is in the first segment with a frame marker. */
function jpegSize(bytes: Uint8Array): Size | undefined {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (bytes.length < 4 || view.getUint16(0) !== 0xffd8) return undefined;
  for (let at = 2; at + 9 <= bytes.length; at += 2 + view.getUint16(at + 2)) {
    const marker = view.getUint16(at);
    const isFrame = marker >= 0xffc0 && marker <= 0xffcf && ![0xffc4, 0xffc8, 0xffcc].includes(marker);
    if (isFrame) return { width: view.getUint16(at + 7), height: view.getUint16(at + 5) };
    if (marker < 0xff00) return undefined;
  }
  return undefined;
}

/** A whole number from 0 up; `NaN` for anything else, which is out of every range. */
function size(value: unknown): number {
  return typeof value === "number" && Number.isSafeInteger(value) && value >= 0 ? value : Number.NaN;
}

/** Whether a document, or one of its primitives, declares Draco compression. */
export function usesDraco(json: Record<string, unknown>): boolean {
  const isListed = [json.extensionsUsed, json.extensionsRequired].some(
    (list) => Array.isArray(list) && list.includes(DRACO),
  );
  return isListed || primitivesOf(json).some(({ extensions }) => isRecord(extensions) && DRACO in extensions);
}

/** The primitives of all meshes. */
export function primitivesOf(json: Record<string, unknown>): Record<string, unknown>[] {
  return records(json, "meshes").flatMap(({ primitives }) =>
    Array.isArray(primitives) ? primitives.filter(isRecord) : [],
  );
}

/** A list of a document, empty if it is missing. @throws StrutError `bad-file` if it is not a list of objects */
export function records(json: Record<string, unknown>, key: string): Record<string, unknown>[] {
  const list = json[key];
  if (list === undefined) return [];
  if (!Array.isArray(list) || !list.every(isRecord)) throw broken(`The list of ${key} in this model is damaged.`);
  return list as Record<string, unknown>[];
}

function broken(message: string, hint = "Export the model again."): StrutError {
  return new StrutError({ code: "bad-file", message, hint });
}
