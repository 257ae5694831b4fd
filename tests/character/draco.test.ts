/**
 * Draco-compressed characters. `tests/rigs/mixamo_draco.glb` is the rig "Mixamo in cm" of `tests/rigs/rig.ts`, written
 * by `gltf-transform draco` (glTF-Transform 4.5, draco3dgltf 1.5.7) with 14 bits per position, 10 per normal and 8 per
 * other value.
 */
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import fc from "fast-check";
import type { BufferAttribute, BufferGeometry, Object3D, SkinnedMesh } from "three";
import { Vector3 } from "three";
import { afterEach, expect, test, vi } from "vitest";
import { chunksOf } from "../../web/character/glb_patch";
import { loadCharacter } from "../../web/character/load";
import { placeAssets } from "../../web/engine/assets";
import { DracoDecoder, EXPORTS } from "../../web/engine/character/draco";
import { StrutError } from "../../web/engine/errors";
import { POSE_FLOATS } from "../../web/humanoid";
import { movingAnimation } from "../humanoid_animation";
import { FAMILIES } from "../rigs/families";
import { glbOf } from "../rigs/glb";
import { makeRig } from "../rigs/rig";
import { farthest, pairs } from "./compare";

const NAME = "KHR_draco_mesh_compression";
const packed = new Uint8Array(readFileSync(new URL("../rigs/mixamo_draco.glb", import.meta.url)));
const plain = makeRig(FAMILIES.find(({ name }) => name === "Mixamo in cm")!).glb;
const MODULE = createRequire(import.meta.url).resolve("three/examples/jsm/libs/draco/gltf/draco_decoder.wasm");

interface Packed {
  bufferView: number;
  attributes: Record<string, number>;
}
interface Primitive {
  attributes: Record<string, number>;
  indices?: number;
  mode?: number;
  extensions?: { [NAME]: Packed };
}
interface Document {
  buffers: { byteLength: number }[];
  bufferViews: { buffer: number; byteOffset?: number; byteLength: number }[];
  accessors: { bufferView?: number; type: string; componentType: number; count: number }[];
  meshes: { primitives: Primitive[] }[];
  extensionsUsed?: string[];
  extensionsRequired?: string[];
}

/** Returns the compressed file with changes. */
function changed(
  change: (document: Document, primitive: Primitive, binary: Uint8Array) => void,
): Uint8Array<ArrayBuffer> {
  const { json, binary } = chunksOf(packed.slice());
  const document = json as unknown as Document;
  change(document, document.meshes[0]!.primitives[0]!, binary);
  return glbOf(document, binary);
}

const extensionOf = (primitive: Primitive) => primitive.extensions![NAME];

/** Returns the stream of the only mesh, in the buffer. */
function streamOf({ bufferViews }: Document, primitive: Primitive, binary: Uint8Array): Uint8Array {
  const { byteOffset = 0, byteLength } = bufferViews[extensionOf(primitive).bufferView]!;
  return binary.subarray(byteOffset, byteOffset + byteLength);
}

const refusal = (file: Uint8Array<ArrayBuffer>) =>
  loadCharacter(file).then(
    (character) => {
      character.dispose();
      return "loaded";
    },
    (error: StrutError) => {
      if (!(error instanceof StrutError)) throw error;
      return `${error.code}: ${error.message}`;
    },
  );

afterEach(() => {
  vi.restoreAllMocks();
});

function geometryOf(object: Object3D): BufferGeometry {
  const skins: SkinnedMesh[] = [];
  object.traverse((node) => {
    if ((node as SkinnedMesh).isSkinnedMesh) skins.push(node as SkinnedMesh);
  });
  return skins[0]!.geometry;
}

test("the names of the decoder's functions are those of its own script", () => {
  const script = readFileSync(MODULE.replace("draco_decoder.wasm", "draco_wasm_wrapper.js"), "utf8").replaceAll(
    "\n",
    "",
  );
  for (const [name, short] of Object.entries(EXPORTS)) expect(script).toContain(`a._${name}=a.asm.${short})`);
});

test("the mesh is that of the file without compression, within its bits", async () => {
  const [one, other] = [await loadCharacter(plain.slice()), await loadCharacter(packed.slice())];
  const [was, is] = [geometryOf(one.object), geometryOf(other.object)];
  expect(is.index!.count).toBe(was.index!.count);
  expect(is.getAttribute("position").count).toBe(was.getAttribute("position").count);
  const { skinIndex: joints } = is.attributes;
  expect(joints).toMatchObject({ itemSize: 4, normalized: false });
  expect(joints!.array).toBeInstanceOf(Uint8Array);
  // Vertices are in another order: each corresponds to the nearest one in position, joints and weights.
  const size = new Vector3();
  was.computeBoundingBox();
  was.boundingBox!.getSize(size);
  const step = Math.max(size.x, size.y, size.z) / 2 ** 14;
  const read = (geometry: BufferGeometry, name: string, i: number) => {
    const attribute = geometry.getAttribute(name) as BufferAttribute;
    return Array.from({ length: attribute.itemSize }, (_, k) => attribute.getComponent(i, k));
  };
  const off = (name: string, i: number, j: number) =>
    Math.max(...read(is, name, i).map((value, k) => Math.abs(value - read(was, name, j)[k]!)));
  const cells = new Map<string, number[]>();
  const cellOf = (at: readonly number[]) => at.map((x) => Math.round(x / (16 * step)));
  for (let j = 0; j < was.getAttribute("position").count; j++) {
    const key = cellOf(read(was, "position", j)).join();
    cells.set(key, [...(cells.get(key) ?? []), j]);
  }
  const around = [-1, 0, 1];
  for (let i = 0; i < is.getAttribute("position").count; i++) {
    const [x, y, z] = cellOf(read(is, "position", i)) as [number, number, number];
    const near = around.flatMap((a) =>
      around.flatMap((b) => around.flatMap((c) => cells.get([x + a, y + b, z + c].join()) ?? [])),
    );
    const same = near.filter(
      (j) =>
        off("position", i, j) <= step &&
        off("skinIndex", i, j) === 0 &&
        off("skinWeight", i, j) <= 2 / 255 &&
        off("normal", i, j) <= 0.02,
    );
    expect(same.length, `vertex ${i}`).toBeGreaterThan(0);
  }
  one.dispose();
  other.dispose();
});

test("the character is bound as that without compression, and performs as it does", async () => {
  const [one, other] = [await loadCharacter(plain.slice()), await loadCharacter(packed.slice())];
  expect(other.roles).toEqual(one.roles);
  expect(other.joints).toEqual(one.joints);
  expect(other.warnings).toEqual([]);
  for (const [i, place] of other.proportions.entries()) expect(place).toBeCloseTo(one.proportions[i]!, 5);
  const { times: _, ...moving } = movingAnimation();
  for (const character of [one, other]) {
    character.setBody(moving.proportions);
    character.apply(moving.poses.subarray(30 * POSE_FLOATS, 31 * POSE_FLOATS));
    character.object.updateMatrixWorld(true);
  }
  const { millimetres, degrees } = farthest(pairs(one.object, other.object), { millimetres: 0, degrees: 0 });
  expect(millimetres).toBeLessThan(0.5);
  expect(degrees).toBeLessThan(0.05);
  one.dispose();
  other.dispose();
});

test("an export has the file's own bytes, compressed as they are, and is read again", async () => {
  const character = await loadCharacter(packed.slice());
  const { times, ...moving } = movingAnimation();
  const out = character.toGLB({ ...moving, timeOut: times });
  character.dispose();
  expect(
    Buffer.compare(chunksOf(out).binary.subarray(0, chunksOf(packed).binary.length), chunksOf(packed).binary),
  ).toBe(0);
  const again = await loadCharacter(out);
  expect(again.motions.map(({ name }) => name)).toEqual(["moving"]);
  again.dispose();
});

test("a file that has its arrays without compression as well needs no decoder", async () => {
  const load = vi.spyOn(DracoDecoder, "load");
  const { json, binary } = chunksOf(plain.slice());
  const document = json as unknown as Document;
  const [primitive] = document.meshes[0]!.primitives;
  primitive!.extensions = { [NAME]: { bufferView: 0, attributes: { POSITION: 0 } } };
  document.extensionsUsed = [NAME];
  expect(await refusal(glbOf(document, binary))).toBe("loaded");
  expect(load).not.toHaveBeenCalled();
  // A file that declares the extension and does not use it.
  delete primitive!.extensions;
  expect(await refusal(glbOf(document, binary))).toBe("loaded");
  // A file that uses the extension and does not declare it.
  expect(await refusal(changed((d) => (d.extensionsUsed = d.extensionsRequired = [])))).toBe("loaded");
});

test("meshes that share their arrays are decoded once", async () => {
  const decode = vi.spyOn(DracoDecoder.prototype, "decode");
  const twice = changed((d, primitive) => d.meshes[0]!.primitives.push(structuredClone(primitive)));
  expect(await refusal(twice)).toBe("loaded");
  expect(decode).toHaveBeenCalledTimes(1);
});

test("damaged and lying files are refused in words", async () => {
  const DAMAGED = "bad-file: A compressed mesh of this model is damaged.";
  const lies: [what: (document: Document, primitive: Primitive, binary: Uint8Array) => void, said: string][] = [
    [(d, p) => (d.bufferViews[extensionOf(p).bufferView]!.byteLength = 4000), DAMAGED],
    [(d, p) => (d.bufferViews[extensionOf(p).bufferView]!.byteLength = 0), DAMAGED],
    [(...all) => streamOf(...all).fill(0), DAMAGED],
    [(...all) => streamOf(...all).fill(255, 11, 60), DAMAGED],
    // Streams as of 2017.
    [
      (...all) => (streamOf(...all)[6] = 1),
      "bad-file: The meshes of this model are compressed with Draco's format 2.1; only 2.2 is supported.",
    ],
    [(_, p) => (extensionOf(p).bufferView = 1e9), DAMAGED],
    [(_, p) => (extensionOf(p).attributes.JOINTS_0 = 77), DAMAGED],
    [(_, p) => (extensionOf(p).attributes.JOINTS_0 = -1), DAMAGED],
    [(_, p) => (extensionOf(p).attributes.JOINTS_0 = 0), DAMAGED],
    [(_, p) => (p.attributes.JOINTS_0 = 1e9), DAMAGED],
    [(_, p) => (p.extensions = { [NAME]: null as unknown as Packed }), DAMAGED],
    [(_, p) => (p.mode = 5), "bad-file: A compressed mesh of this model is not a list of triangles."],
    [
      (d, p) => (d.bufferViews[extensionOf(p).bufferView]!.byteLength = 1e9),
      "bad-file: A buffer view of this model is out of range.",
    ],
    [(d, p) => (d.accessors[p.indices!]!.count = 1e9), "bad-file: An array of this model has no type, or is too long."],
  ];
  for (const [lie, said] of lies) expect(await refusal(changed(lie)), lie.toString()).toBe(said);
});

test("a mesh that is longer than it may be is refused", async () => {
  const { json, binary } = chunksOf(packed);
  const document = json as unknown as Document;
  const stream = streamOf(document, document.meshes[0]!.primitives[0]!, binary);
  const decoder = await DracoDecoder.load();
  const wanted = [{ id: 0, componentType: 5126, width: 3 }];
  const { points, indices } = decoder.decode(stream, wanted, 16e6);
  const numbers = 3 * points + indices.length;
  expect(() => decoder.decode(stream, wanted, numbers - 1)).toThrow(
    "The compressed meshes of this model are too large.",
  );
  expect(decoder.decode(stream, wanted, numbers).indices).toEqual(indices);
});

test("changed bytes end in a model or a sentence, soon", async () => {
  const changes = fc.array(fc.tuple(fc.noBias(fc.nat()), fc.nat({ max: 255 })), { minLength: 1, maxLength: 8 });
  const said = new Map<string, number>();
  await fc.assert(
    fc.asyncProperty(changes, fc.boolean(), fc.option(fc.noBias(fc.nat())), async (bytes, isNear, end) => {
      const file = changed((document, primitive, binary) => {
        const stream = streamOf(document, primitive, binary);
        for (const [at, value] of bytes) stream[at % (isNear ? 80 : stream.length)] = value;
        const view = document.bufferViews[extensionOf(primitive).bufferView]!;
        if (end !== null) view.byteLength = end % stream.length;
      });
      const start = performance.now();
      const outcome = await refusal(file);
      expect(performance.now() - start).toBeLessThan(5000);
      expect(outcome).toMatch(/^loaded$|^bad-file: [A-Z].*\.$/);
      said.set(outcome, (said.get(outcome) ?? 0) + 1);
    }),
    { seed: 20_261_129, numRuns: 150, endOnFailure: true },
  );
  console.info([...said].map((each) => each.join(" ")).join("; "));
});

test("without the decoder the error says which file is missing, and what helps", async () => {
  const missing = new URL("nowhere/draco_decoder.wasm", import.meta.url);
  placeAssets({ "draco_decoder.wasm": missing });
  await expect(loadCharacter(packed.slice())).rejects.toMatchObject({
    code: "load",
    message: `The decoder of Draco meshes could not be loaded: there is no file ${missing.pathname}.`,
    hint: expect.stringContaining("without Draco"),
  });
  placeAssets({ "draco_decoder.wasm": new Uint8Array(readFileSync(MODULE)) });
  expect(await refusal(packed.slice())).toBe("loaded");
});
