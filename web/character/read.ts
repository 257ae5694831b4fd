/**
 * Reads models: GLB, VRM 0 and 1, VRM Animation, FBX. A file is checked before three.js reads it, and loads nothing from
 * elsewhere (`shared/spec/embedding.md` section 6).
 */
import { Group, LoadingManager, type Material, type Mesh, type Object3D, type Texture } from "three";
import { cancelled, type ErrorParts, StrutError } from "../engine/errors";
import { originOf } from "./bind";
import { converted } from "./convert";
import { checkFbx } from "./fbx_check";
import { chunksOf } from "./glb_patch";
import { checkGltf } from "./gltf_check";
import type { GltfLike, Origin, VrmLike } from "./types";
import { type GltfJson, isRecord, vrmOf } from "./vrm_humanoid";

/** Largest file, bytes. */
const MAX_BYTES = 128 * 1024 * 1024;
/** Most triangles of a model. */
const MAX_TRIANGLES = 2_000_000;
/** Oldest FBX that three.js reads. */
const MIN_FBX = 7000;

/** Where a character comes from: an address, or the file. */
export type CharacterSource = string | URL | ArrayBuffer | Blob;

/** Imports `@pixiv/three-vrm`; gives nothing, or rejects, where the page does not have it. */
export type ImportVrm = () => Promise<{ VRMLoaderPlugin: new (parser: never) => unknown } | undefined>;

/** How a model is read. */
export interface ReadOptions {
  /** Sees the document of a glTF before anything else of it is read. */
  inspect?: (document: GltfJson) => void | Promise<void>;
  /** Whether {@link ReadModel.glb} is wanted of a model of another format. */
  wantsGlb?: boolean;
  importVrm?: ImportVrm | undefined;
}

/**
 * Reads a file.
 * @throws StrutError `bad-file` with what is wrong with it, and what `inspect` throws
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

/** A file as three.js has it. */
export interface ReadModel {
  readonly origin: Origin;
  /** The model as binary glTF; `undefined` where it cannot be written so. */
  readonly glb: Uint8Array | undefined;
  /** Metres a unit of the model, where its format says so by itself. */
  readonly metresPerUnit: number | undefined;
}

/** The bytes of a source. @throws StrutError `bad-file` where it is too large, `load`, `cancelled` */
export async function bytesOf(
  source: CharacterSource,
  signal: AbortSignal | undefined,
): Promise<Uint8Array<ArrayBuffer>> {
  if (source instanceof ArrayBuffer) return checkedSize(source.byteLength, async () => source);
  if (source instanceof Blob) return checkedSize(source.size, () => source.arrayBuffer());
  let response: Response;
  try {
    response = await fetch(source, signal ? { signal } : {});
  } catch (cause) {
    if (signal?.aborted) throw cancelled(signal.reason);
    const message = "The file could not be loaded.";
    throw new StrutError(
      { code: "load", message, hint: "Check its address, and that its host allows other pages." },
      cause,
    );
  }
  if (!response.ok) {
    const message = `The file could not be loaded: the server answered ${response.status}.`;
    throw new StrutError({ code: "load", message, hint: "Check its address." });
  }
  return checkedSize(Number(response.headers.get("Content-Length") ?? 0), () => response.arrayBuffer());
}

/** @throws StrutError `bad-file` where a file is larger than it may be, before it is read where its size is known */
async function checkedSize(bytes: number, read: () => Promise<ArrayBuffer>): Promise<Uint8Array<ArrayBuffer>> {
  if (bytes > MAX_BYTES) throw tooLarge(bytes);
  const buffer = await read();
  if (buffer.byteLength > MAX_BYTES) throw tooLarge(buffer.byteLength);
  return new Uint8Array(buffer);
}

function tooLarge(bytes: number): StrutError {
  const megabytes = Math.ceil(bytes / (1024 * 1024));
  return badFile(`This file has ${megabytes} MB; at most 128 MB can be opened.`, "Make its textures smaller.");
}

/** Whether these are the bytes of an FBX file, binary or text. */
function isFbx(file: Uint8Array): boolean {
  const head = new TextDecoder("latin1").decode(file.subarray(0, 64));
  return head.startsWith("Kaydara FBX Binary") || /^;\s*FBX/.test(head);
}

/** The version of an FBX file, as 7400 for 7.4; 0 where it does not say. */
function fbxVersion(file: Uint8Array): number {
  const head = new TextDecoder("latin1").decode(file.subarray(0, 2048));
  if (!head.startsWith("Kaydara")) return Number(/FBXVersion:\s*(\d+)/.exec(head)?.[1] ?? 0);
  return file.length < 27 ? 0 : new DataView(file.buffer, file.byteOffset).getUint32(23, true);
}

async function readFbx(file: Uint8Array<ArrayBuffer>, { wantsGlb }: ReadOptions): Promise<ReadModel> {
  const version = fbxVersion(file);
  if (version < MIN_FBX) {
    const shown = version > 0 ? `FBX ${version / 1000}` : "FBX of an unknown version";
    throw badFile(
      `This file is ${shown}; version 7 or newer was expected.`,
      "Export it as FBX 2011 or newer, or as GLB.",
    );
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
  // The file's own axes are turned inside, and the object that the page places has metres.
  const object = new Group();
  object.add(inner);
  object.scale.setScalar(metresPerUnit);
  object.animations = inner.animations;
  dropEmptyTextures(object);
  const origin = originOf(object);
  // Without it the character performs all the same.
  const glb = wantsGlb ? await converted(object).catch(() => undefined) : undefined;
  return { origin: glb ? { ...origin, indexOf: glb.indexOf } : origin, glb: glb?.file, metresPerUnit };
}

/** A wait for all that a manager has begun to load, whether it could be loaded or not. */
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

/** Takes away textures that could not be loaded, such as those in other files: they would be black, and in no file. */
function dropEmptyTextures(object: Object3D): void {
  for (const material of materialsOf(object))
    for (const [key, value] of Object.entries(material) as [string, unknown][])
      if (isTexture(value) && !value.image) (material as unknown as Record<string, unknown>)[key] = null;
}

async function readGlb(file: Uint8Array<ArrayBuffer>, { inspect, importVrm }: ReadOptions): Promise<ReadModel> {
  const { json, binary } = chunksOf(file);
  checkGltf(json, binary);
  const document = json as GltfJson;
  await inspect?.(document);
  const { GLTFLoader } = await import("three/addons/loaders/GLTFLoader.js");
  const loader = new GLTFLoader(closedManager());
  const plugin = vrmOf(document) && (await vrmPlugin(importVrm));
  if (plugin) loader.register(plugin as never);
  const gltf: GltfLike = await reading(() => loader.parseAsync(file.buffer, ""));
  if (!gltf.scene) throw badFile("There is no scene in this model.", "Export it again.");
  const vrm = gltf.userData?.vrm as VrmLike | undefined;
  const origin = originOf(gltf);
  return { origin: vrm ? { ...origin, vrm } : origin, glb: file, metresPerUnit: undefined };
}

/** three-vrm's plugin of the loader where the page has it: it makes hair and clothes swing. */
async function vrmPlugin(importVrm: ImportVrm | undefined): Promise<((parser: unknown) => unknown) | undefined> {
  try {
    const module = await importVrm?.();
    return module && ((parser) => new module.VRMLoaderPlugin(parser as never));
  } catch {
    return undefined;
  }
}

/** Files refer to nothing outside: only what they hold themselves is read. */
function closedManager(): LoadingManager {
  const manager = new LoadingManager();
  manager.setURLModifier((url) => (/^(blob|data):/.test(url) ? url : "data:,"));
  return manager;
}

/** Runs what reads a file, which may be anything: what is thrown by three.js says little to people. */
export async function reading<T>(read: () => Promise<T>): Promise<T> {
  try {
    return await read();
  } catch (cause) {
    throw cause instanceof StrutError ? cause : new StrutError(DAMAGED, cause);
  }
}

const DAMAGED: ErrorParts = {
  code: "bad-file",
  message: "This model is damaged, or has parts that cannot be read.",
  hint: "Export it again as GLB, without compression of meshes.",
};

function badFile(message: string, hint: string): StrutError {
  return new StrutError({ code: "bad-file", message, hint });
}

/** @throws StrutError `bad-file` where there are more triangles than can be drawn */
function checkTriangles(object: Object3D): void {
  let triangles = 0;
  object.traverse((node) => {
    const { geometry } = node as Mesh;
    if (geometry?.attributes.position) triangles += (geometry.index ?? geometry.attributes.position).count / 3;
  });
  if (triangles <= MAX_TRIANGLES) return;
  throw badFile("This model has more than two million triangles.", "Simplify its meshes.");
}

/** Frees what a model holds on the graphics card. */
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
