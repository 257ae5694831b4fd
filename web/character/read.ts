/**
 * Reads models: GLB, VRM 0 and 1, VRM Animation, FBX. A file is checked before three.js reads it, and loads no external
 * files (`shared/spec/embedding.md` section 6).
 */
import {
  Group,
  LoadingManager,
  type Material,
  type Mesh,
  type MeshPhongMaterial,
  type Object3D,
  type Texture,
} from "three";
import { cancelled, type ErrorParts, StrutError } from "../engine/errors";
import { originOf } from "./bind";
import { converted } from "./convert";
import { checkFbx } from "./fbx_check";
import { chunksOf } from "./glb_patch";
import { checkGltf, usesDraco } from "./gltf_check";
import type { GltfLike, Origin, VrmLike } from "./types";
import { type GltfJson, isRecord, vrmOf } from "./vrm_humanoid";

/** Largest file, bytes. */
const MAX_BYTES = 128 * 1024 * 1024;
/** Maximum number of triangles of a model. */
const MAX_TRIANGLES = 2_000_000;
/** Sum of the channels of a colour below which it counts as black, and the grey that replaces it. */
const [DARK, GREY] = [0.1, 0.6];
/** Material extensions that many files have and three.js does not display. */
const UNSHOWN_MATERIALS = ["KHR_materials_pbrSpecularGlossiness", "KHR_techniques_webgl", "KHR_materials_common"];
/** Oldest FBX that three.js reads. */
const MIN_FBX = 7000;

/**
 * Source of a character: a URL, the file as a `Blob` or its bytes, or several files of which one is a `.gltf` and the
 * others the files that it names.
 */
export type CharacterSource = string | URL | ArrayBuffer | ArrayBufferView | Blob | readonly File[];

/** Imports `@pixiv/three-vrm`. Resolves with `undefined`, or rejects, if the page does not have it. */
export type ImportVrm = () => Promise<{ VRMLoaderPlugin: new (parser: never) => unknown } | undefined>;

/** Options of reading a model. */
export interface ReadOptions {
  /** Receives the document of a glTF before anything else of it is read. */
  inspect?: (document: GltfJson) => void | Promise<void>;
  /** Whether {@link ReadModel.glb} is needed for a model of another format. */
  wantsGlb?: boolean;
  importVrm?: ImportVrm | undefined;
}

/**
 * Reads a file.
 * @throws StrutError `bad-file` if it is invalid, and errors of `inspect`
 */
export async function readModel(file: Uint8Array<ArrayBuffer>, options: ReadOptions): Promise<ReadModel> {
  const model = await (isFbx(file) ? readFbx(file, options) : readGlb(file, options));
  try {
    checkTriangles(model.origin.object);
    return model;
  } catch (thrown) {
    free(model.origin.object);
    throw thrown;
  }
}

/** A file as read by three.js. */
export interface ReadModel {
  readonly origin: Origin;
  /** The model as binary glTF; `undefined` if it cannot be converted. */
  readonly glb: Uint8Array | undefined;
  /** Metres per unit of the model, if its format defines it. */
  readonly metresPerUnit: number | undefined;
}

/**
 * The bytes of a source.
 * @throws StrutError `bad-file` if it is too large or not a source, `load` if it cannot be loaded, `cancelled`
 */
export async function bytesOf(
  source: CharacterSource,
  signal: AbortSignal | undefined,
): Promise<Uint8Array<ArrayBuffer>> {
  try {
    return await packedIfSplit(await sourceBytes(source, signal), source, signal);
  } catch (cause) {
    if (signal?.aborted) throw cancelled(signal.reason);
    if (cause instanceof StrutError) throw cause;
    const message = "The file could not be loaded.";
    const hint = "Check the URL, and that the server allows requests from other pages (CORS).";
    throw new StrutError({ code: "load", message, hint }, cause);
  }
}

async function sourceBytes(source: CharacterSource, signal: AbortSignal | undefined): Promise<Uint8Array<ArrayBuffer>> {
  if (typeof source === "string" || source instanceof URL) return fetched(source, signal);
  // Checked by structure, not by class: another frame has classes of its own.
  if (ArrayBuffer.isView(source)) {
    const { buffer, byteOffset, byteLength } = source;
    return checkedSize(byteLength, async () => new Uint8Array(buffer, byteOffset, byteLength).slice().buffer);
  }
  if (Array.isArray(source)) return sourceBytes(documentOf(source), signal);
  const { byteLength, size, arrayBuffer } = source as Partial<ArrayBuffer & Blob>;
  if (typeof byteLength === "number") return checkedSize(byteLength, async () => source as ArrayBuffer);
  if (typeof size === "number" && typeof arrayBuffer === "function")
    return checkedSize(size, () => (source as Blob).arrayBuffer());
  const message = "A character must be a URL, a file or its bytes.";
  throw new StrutError({ code: "bad-input", message, hint: "" });
}

async function fetched(address: string | URL, signal: AbortSignal | undefined): Promise<Uint8Array<ArrayBuffer>> {
  const response = await fetch(address, signal ? { signal } : {});
  if (!response.ok) {
    const message = `The file could not be loaded: the server answered ${response.status}.`;
    throw new StrutError({ code: "load", message, hint: "Check the URL." });
  }
  return checkedSize(Number(response.headers.get("Content-Length") ?? 0), () => response.arrayBuffer());
}

/** The `.gltf` among several files. @throws StrutError `bad-file` if there is none */
function documentOf(files: readonly File[]): File {
  const document = files.find(({ name }) => /\.gltf$/i.test(name)) ?? (files.length === 1 ? files[0] : undefined);
  if (document) return document;
  throw badFile("None of these files is a .gltf.", "Give one file, or a .gltf with the files that it names.");
}

/** A `.gltf` with its files packed into one binary file; other files unchanged. */
async function packedIfSplit(
  bytes: Uint8Array<ArrayBuffer>,
  source: CharacterSource,
  signal: AbortSignal | undefined,
): Promise<Uint8Array<ArrayBuffer>> {
  // A document begins like JSON; all other formats have a signature.
  if (!/^\uFEFF?\s*\{/.test(new TextDecoder().decode(bytes.subarray(0, 64)))) return bytes;
  const { packedGltf, packedWith } = await import("./pack_gltf");
  if (Array.isArray(source)) {
    const files = (source as readonly File[]).map((file) => ({
      path: file.webkitRelativePath || file.name,
      bytes: async () => checkedSize(file.size, () => file.arrayBuffer()),
    }));
    const document = files[source.indexOf(documentOf(source))]!;
    return packedWith(document, files);
  }
  const base = typeof source === "string" || source instanceof URL ? addressOf(source) : undefined;
  return packedGltf(bytes, async (uri) => {
    // Only files in the document's folder or below it.
    const address = base && /^(?![/\\]|[a-z][a-z0-9+.-]*:)/i.test(uri) ? new URL(encodeURI(uri), base) : undefined;
    if (!address?.href.startsWith(new URL(".", base).href)) return undefined;
    return fetched(address, signal).catch((thrown: unknown) => {
      if (signal?.aborted || (thrown instanceof StrutError && thrown.code === "bad-file")) throw thrown;
      return undefined;
    });
  });
}

function addressOf(source: string | URL): URL {
  return new URL(source, typeof document === "object" ? document.baseURI : undefined);
}

/** @throws StrutError `bad-file` if a file is larger than the limit; checked before reading if its size is known */
async function checkedSize(bytes: number, read: () => Promise<ArrayBuffer>): Promise<Uint8Array<ArrayBuffer>> {
  if (bytes > MAX_BYTES) throw tooLarge(bytes);
  const buffer = await read();
  if (buffer.byteLength > MAX_BYTES) throw tooLarge(buffer.byteLength);
  return new Uint8Array(buffer);
}

function tooLarge(bytes: number): StrutError {
  const megabytes = Math.ceil(bytes / (1024 * 1024));
  return badFile(`This file has ${megabytes} MB; the limit is 128 MB.`, "Make its textures smaller.");
}

/** Whether these are the bytes of an FBX file, binary or text. */
function isFbx(file: Uint8Array): boolean {
  const head = new TextDecoder("latin1").decode(file.subarray(0, 64));
  return head.startsWith("Kaydara FBX Binary") || /^;\s*FBX/.test(head);
}

/** The version of an FBX file, as 7400 for 7.4; 0 if it is missing. */
function fbxVersion(file: Uint8Array): number {
  const head = new TextDecoder("latin1").decode(file.subarray(0, 2048));
  if (!head.startsWith("Kaydara")) return Number(/FBXVersion:\s*(\d+)/.exec(head)?.[1] ?? 0);
  return file.length < 27 ? 0 : new DataView(file.buffer, file.byteOffset).getUint32(23, true);
}

async function readFbx(file: Uint8Array<ArrayBuffer>, { wantsGlb }: ReadOptions): Promise<ReadModel> {
  const version = fbxVersion(file);
  if (version < MIN_FBX) {
    const shown = version > 0 ? `FBX ${version / 1000}` : "FBX of an unknown version";
    throw badFile(`This file is ${shown}. Expected version 7 or newer.`, "Export it as FBX 2011 or newer, or as GLB.");
  }
  const { FBXLoader } = await import("three/addons/loaders/FBXLoader.js");
  const { unzlibSync } = await import("three/addons/libs/fflate.module.js");
  await reading(async () => checkFbx(file, (packed) => unzlibSync(packed)));
  const manager = closedManager();
  const textures = ended(manager);
  const inner = await reading(async () => new FBXLoader(manager).parse(file.buffer, ""));
  await textures();
  const { unitScaleFactor } = inner.userData;
  const metresPerUnit = typeof unitScaleFactor === "number" && unitScaleFactor > 0 ? unitScaleFactor / 100 : 0.01;
  // The file's own axes are converted inside, and the object that the page places is in metres.
  const object = new Group();
  object.add(inner);
  object.scale.setScalar(metresPerUnit);
  object.animations = inner.animations;
  const origin = { ...originOf(object), notes: textureNotes(dropEmptyTextures(object)) };
  // Without it the character can still perform.
  const glb = wantsGlb ? await converted(object).catch(() => undefined) : undefined;
  return { origin: glb ? { ...origin, indexOf: glb.indexOf } : origin, glb: glb?.file, metresPerUnit };
}

/** Returns a wait for everything that a manager has started to load, whether loading succeeds or not. */
function ended(manager: LoadingManager): () => Promise<void> {
  let hasBegun = false;
  manager.onStart = () => {
    hasBegun = true;
  };
  const end = new Promise<void>((resolve) => {
    manager.onLoad = resolve;
  });
  return async () => {
    if (hasBegun) await end;
  };
}

/**
 * Removes textures that could not be loaded, such as those in other files: they would be black, and missing in exports.
 * Materials that would be black without them become grey. Returns the number of removed textures.
 */
function dropEmptyTextures(object: Object3D): number {
  const lost = new Set<Texture>();
  for (const material of materialsOf(object))
    for (const [key, value] of Object.entries(material) as [string, unknown][]) {
      if (!isTexture(value) || value.image) continue;
      lost.add(value);
      (material as unknown as Record<string, unknown>)[key] = null;
      const { color } = material as Partial<MeshPhongMaterial>;
      if (key === "map" && color && color.r + color.g + color.b < DARK) color.setScalar(GREY);
    }
  return lost.size;
}

/** Sentences on missing textures. */
function textureNotes(lost: number): string[] {
  if (lost === 0) return [];
  const [some, are, them] = lost === 1 ? ["One texture", "it is", "it"] : [`${lost} textures`, "they are", "them"];
  return [
    `${some} could not be loaded: ${are} in another file, or the page's policy forbids ${them} (connect-src blob:).`,
  ];
}

/** Sentences on materials of a document that three.js cannot display. */
function materialNotes({ extensionsUsed }: GltfJson): string[] {
  const used = Array.isArray(extensionsUsed) ? (extensionsUsed as unknown[]).map(String) : [];
  const unknown = used.filter((name) => UNSHOWN_MATERIALS.includes(name));
  return unknown.map((name) => `Materials of this model use ${name}, which is not supported.`);
}

async function readGlb(file: Uint8Array<ArrayBuffer>, { inspect, importVrm }: ReadOptions): Promise<ReadModel> {
  const { json, binary } = chunksOf(file);
  checkGltf(json, binary);
  const document = json as GltfJson;
  await inspect?.(document);
  const { GLTFLoader } = await import("three/addons/loaders/GLTFLoader.js");
  const manager = closedManager();
  let lost = 0;
  manager.onError = () => {
    lost++;
  };
  const loader = new GLTFLoader(manager);
  const used = Array.isArray(document.extensionsUsed) ? (document.extensionsUsed as unknown[]) : [];
  // three.js's own decoder, which few files need.
  if (used.some((name) => /meshopt_compression$/.test(String(name))))
    loader.setMeshoptDecoder((await import("three/addons/libs/meshopt_decoder.module.js")).MeshoptDecoder);
  const plugin = vrmOf(document) && (await vrmPlugin(importVrm));
  if (plugin) loader.register(plugin as never);
  const plain = usesDraco(json) ? await (await import("./draco")).withoutDraco({ json, binary }) : file;
  const gltf: GltfLike = await reading(() => loader.parseAsync(plain.buffer, ""));
  if (!gltf.scene) throw badFile("This model has no scene.", "Export it again.");
  const vrm = gltf.userData?.vrm as VrmLike | undefined;
  const notes = [...textureNotes(lost), ...materialNotes(document)];
  const origin = { ...originOf(gltf), notes };
  return { origin: vrm ? { ...origin, vrm } : origin, glb: file, metresPerUnit: undefined };
}

/** three-vrm's loader plugin, if the page has it: it makes hair and clothes swing. */
async function vrmPlugin(importVrm: ImportVrm | undefined): Promise<((parser: unknown) => unknown) | undefined> {
  try {
    const module = await importVrm?.();
    return module && ((parser) => new module.VRMLoaderPlugin(parser as never));
  } catch {
    return undefined;
  }
}

/** A loading manager that refuses external references: files may only refer to their own contents. */
function closedManager(): LoadingManager {
  const manager = new LoadingManager();
  manager.setURLModifier((url) => (/^(blob|data):/.test(url) ? url : "data:,"));
  return manager;
}

/** Runs a reader on an untrusted file and replaces three.js's errors, which mean little to users. */
export async function reading<T>(read: () => Promise<T>): Promise<T> {
  try {
    return await read();
  } catch (cause) {
    throw cause instanceof StrutError ? cause : new StrutError(DAMAGED, cause);
  }
}

const DAMAGED: ErrorParts = {
  code: "bad-file",
  message: "This model is damaged, or has unsupported parts.",
  hint: "Export it again as GLB.",
};

function badFile(message: string, hint: string): StrutError {
  return new StrutError({ code: "bad-file", message, hint });
}

/** @throws StrutError `bad-file` if there are too many triangles to draw */
function checkTriangles(object: Object3D): void {
  let triangles = 0;
  object.traverse((node) => {
    const { geometry } = node as Mesh;
    if (geometry?.attributes.position) triangles += (geometry.index ?? geometry.attributes.position).count / 3;
  });
  if (triangles <= MAX_TRIANGLES) return;
  throw badFile("This model has more than two million triangles.", "Simplify its meshes.");
}

/** Frees a model's GPU resources. */
export function free(object: Object3D): void {
  object.traverse((node) => {
    (node as Partial<Mesh>).geometry?.dispose();
  });
  for (const material of materialsOf(object)) {
    for (const value of Object.values(material) as unknown[]) if (isTexture(value)) value.dispose();
    material.dispose();
  }
  object.removeFromParent();
}

function materialsOf(object: Object3D): Set<Material> {
  const materials = new Set<Material>();
  object.traverse((node) => {
    const { material } = node as Partial<Mesh>;
    for (const each of material ? [material].flat() : []) materials.add(each);
  });
  return materials;
}

const isTexture = (value: unknown): value is Texture => isRecord(value) && value.isTexture === true;
