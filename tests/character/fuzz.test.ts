/**
 * Damaged models: each must load, or be refused by a typed error with a message within 5 s, and leave no resources
 * behind.
 */
import { readFileSync } from "node:fs";
import fc from "fast-check";
import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { chunksOf } from "../../web/character/glb_patch";
import { loadCharacter, loadMotions } from "../../web/character/load";
import { characterPackage } from "../../web/engine/character/wasm";
import { StrutError } from "../../web/engine/errors";
import { vrmAnimation } from "../../web/formats/vrma";
import { movingAnimation } from "../humanoid_animation";
import { FAMILIES } from "../rigs/families";
import { fbxFile } from "../rigs/fbx";
import { glbOf } from "../rigs/glb";
import { makeRig } from "../rigs/rig";

const SEED = 20_261_123;

const { times, ...moving } = movingAnimation();
const motion = { ...moving, timeOut: times };

/** Valid files, each with a motion. */
const files = await (async () => {
  const out: { name: string; file: Uint8Array }[] = [];
  for (const family of [FAMILIES[0]!, FAMILIES[1]!, FAMILIES[2]!]) {
    const character = await loadCharacter(makeRig(family).glb.buffer);
    out.push({ name: family.name, file: character.toGLB(motion) });
    if (family === FAMILIES[2]) out.push({ name: "FBX", file: fbxFile(family, { clip: character.toClip(motion) }) });
    character.dispose();
  }
  const packed = await loadCharacter(readFileSync(new URL("../rigs/mixamo_draco.glb", import.meta.url)));
  out.push({ name: "Draco", file: packed.toGLB(motion) });
  packed.dispose();
  out.push({ name: "VRMA", file: vrmAnimation({ ...moving, times }) });
  return out;
})();

beforeEach(() => {
  // three.js prints many messages about damaged files.
  for (const method of ["warn", "error", "info"] as const) vi.spyOn(console, method).mockImplementation(() => {});
});

afterEach(() => {
  vi.restoreAllMocks();
});

/** Returns the outcome of loading a file. */
async function outcome(file: Uint8Array): Promise<string> {
  const buffer = () => Uint8Array.from(file).buffer;
  const said: string[] = [];
  for (const open of [
    async () => {
      const character = await loadCharacter(
        buffer(),
        { accept: () => true, glb: false },
        () => import("@pixiv/three-vrm"),
      );
      try {
        character.apply(motion.poses.subarray(0, 87));
        character.update(1 / 60);
        for (const found of character.motions.slice(0, 2)) found.poses();
      } finally {
        character.dispose();
      }
    },
    async () => {
      for (const found of (await loadMotions(buffer())).slice(0, 2)) found.toBVH();
    },
  ])
    try {
      await open();
      said.push("loaded");
    } catch (error) {
      if (!(error instanceof StrutError)) throw error;
      if (error.code === "fault") throw error;
      expect(error.message).toMatch(/^[A-Z].*\.$/s);
      said.push(error.code);
    }
  return said.join();
}

/** Tests damaged files. */
async function holds<T>(damage: fc.Arbitrary<T>, damaged: (how: T) => Uint8Array, runs: number): Promise<void> {
  const { Character } = await characterPackage.load();
  // Every binding requests its roles once.
  const [made, freed] = [vi.spyOn(Character.prototype, "roles"), vi.spyOn(Character.prototype, "free")];
  const outcomes = new Map<string, number>();
  let slowest = 0;
  await fc.assert(
    fc.asyncProperty(damage, async (how) => {
      const file = damaged(how);
      const start = performance.now();
      const said = await outcome(file);
      slowest = Math.max(slowest, performance.now() - start);
      outcomes.set(said, (outcomes.get(said) ?? 0) + 1);
    }),
    { seed: SEED, numRuns: runs, endOnFailure: true },
  );
  vi.mocked(console.info).mockRestore();
  console.info(
    `${runs} files: ${[...outcomes].map((each) => each.join(" ")).join("; ")}; slowest ${slowest.toFixed(0)} ms`,
  );
  expect(freed).toHaveBeenCalledTimes(made.mock.calls.length);
}

const anyFile = fc.nat({ max: files.length - 1 });
/** A position in a file, uniformly distributed. */
const anywhere = fc.noBias(fc.nat());

test("bytes are changed", async () => {
  const bytes = fc.array(fc.tuple(anywhere, fc.nat({ max: 255 })), {
    minLength: 1,
    maxLength: 40,
  });
  await holds(
    fc.tuple(anyFile, bytes),
    ([i, changes]) => {
      const file = files[i]!.file.slice();
      for (const [at, value] of changes) file[at % file.length] = value;
      return file;
    },
    100,
  );
});

test("bytes near the beginning are changed", async () => {
  await holds(
    fc.tuple(
      anyFile,
      fc.array(fc.tuple(fc.nat({ max: 3000 }), fc.integer({ min: 0, max: 255 })), { minLength: 1, maxLength: 6 }),
    ),
    ([i, changes]) => {
      const file = files[i]!.file.slice();
      for (const [at, value] of changes) file[at] = value;
      return file;
    },
    60,
  );
});

test("files end early", async () => {
  await holds(fc.tuple(anyFile, anywhere), ([i, end]) => files[i]!.file.slice(0, end % files[i]!.file.length), 60);
});

/** Replacements of lengths, offsets and keys. */
const ODD = [0, 1, -1, 7, 255, 65_536, 2 ** 31, 2 ** 32 - 1, 1e30, -1e30, Infinity, Number.NaN, 1e-40];

test("numbers of FBX are others", async () => {
  const fbx = files.find(({ name }) => name === "FBX")!.file;
  const change = fc.tuple(anywhere, fc.constantFrom(...ODD), fc.constantFrom("uint32", "float32", "float64"));
  await holds(
    fc.array(change, { minLength: 1, maxLength: 12 }),
    (changes) => {
      const file = fbx.slice();
      const view = new DataView(file.buffer);
      for (const [at, value, as] of changes) {
        const offset = 27 + (at % (file.length - 40));
        if (as === "uint32") view.setUint32(offset, value, true);
        else if (as === "float32") view.setFloat32(offset, value, true);
        else view.setFloat64(offset, value, true);
      }
      return file;
    },
    60,
  );
});

/** Replacements of fields of a document. */
const STRANGE = [
  null,
  -1,
  0,
  1,
  3,
  1e9,
  2 ** 53,
  0.5,
  "",
  "x",
  "SCALAR",
  5126,
  [],
  [0],
  [-1],
  [1e9],
  {},
  { node: 0 },
  true,
  [[]],
];

test("fields of the documents are others", async () => {
  const glbs = files.filter(({ name }) => name !== "FBX");
  const change = fc.tuple(
    fc.array(anywhere, { minLength: 1, maxLength: 7 }),
    fc.option(fc.constantFrom(...STRANGE), { nil: undefined }),
  );
  await holds(
    fc.tuple(fc.integer({ min: 0, max: glbs.length - 1 }), fc.array(change, { minLength: 1, maxLength: 5 })),
    ([i, changes]) => {
      const { json, binary } = chunksOf(glbs[i]!.file);
      const document = structuredClone(json);
      for (const [path, value] of changes) replace(document, path, value);
      return glbOf(document, binary);
    },
    200,
  );
});

test("accessors lie", async () => {
  const glbs = files.filter(({ name }) => name !== "FBX");
  const field = fc.constantFrom("count", "byteOffset", "componentType", "type", "bufferView", "sparse", "normalized");
  await holds(
    fc.tuple(fc.integer({ min: 0, max: glbs.length - 1 }), fc.nat(), field, fc.constantFrom(...STRANGE)),
    ([i, at, key, value]) => {
      const { json, binary } = chunksOf(glbs[i]!.file);
      const document = structuredClone(json) as { accessors: Record<string, unknown>[] };
      document.accessors[at % document.accessors.length]![key] = value;
      return glbOf(document, binary);
    },
    150,
  );
});

/** Replaces or removes the value at a path; each step selects one of the entries there. */
function replace(parent: object, [step, ...rest]: readonly number[], value: unknown): void {
  const keys = Object.keys(parent);
  const key = keys[step! % keys.length];
  if (key === undefined) return;
  const fields = parent as Record<string, unknown>;
  const child = fields[key];
  if (rest.length > 0 && typeof child === "object" && child !== null && Object.keys(child).length > 0)
    replace(child, rest, value);
  else if (value === undefined) delete fields[key];
  else fields[key] = structuredClone(value);
}
