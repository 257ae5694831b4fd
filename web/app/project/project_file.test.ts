import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { zipOf } from "../../../tests/zip";
import { POSE_FLOATS, ROLES } from "../../humanoid";
import { initialState, toHash } from "../state/state";
import { LIMITS, type Project, ProjectError, readProject, VERSION, writeProject } from "./project_file";

const DIGEST = "0123456789abcdef".repeat(4);
const MANIFEST = { format: "strut-project", version: VERSION, state: "styles=old:1", inputs: [] };
const bytesOf = (text: string) => new TextEncoder().encode(text);

/** A project with every kind of content. */
const FULL: Project = {
  state: "input=walk&styles=old:1,proud:0.5",
  inputs: [
    { name: "walk", file: new Blob([bytesOf("HIERARCHY\n")]), reading: { up: "z" } },
    {
      name: "made",
      file: new Blob([bytesOf("HIERARCHY\n".repeat(50))]),
      exact: {
        poses: Float32Array.from({ length: 2 * POSE_FLOATS }, (_, i) => i / 7),
        proportions: Float32Array.from({ length: 3 * ROLES.length }, (_, i) => i / 3),
        rateHz: 60,
      },
    },
  ],
  database: { name: "mine", file: new Blob(["STRUTDB"]) },
  character: { name: "bot.glb", size: 5, sha256: DIGEST, file: new Blob(["glTF!"]), roles: { hips: "Bip01" } },
};

/** An archive with this `project.json` and other files. */
function archive(manifest: unknown, others: Record<string, string | Uint8Array> = {}): Blob {
  const text = typeof manifest === "string" ? manifest : JSON.stringify(manifest);
  const files = [{ name: "project.json", content: text }];
  return new Blob([zipOf([...files, ...Object.entries(others).map(([name, content]) => ({ name, content }))])]);
}

const why = async (file: Blob): Promise<string> => {
  try {
    await readProject(file);
  } catch (thrown) {
    expect(thrown).toBeInstanceOf(ProjectError);
    return (thrown as Error).message;
  }
  throw new Error("it was read");
};

/** A project with blobs converted to bytes, for comparison. */
async function plain(project: Project) {
  const bytes = async (file: Blob | undefined) => file && [...new Uint8Array(await file.arrayBuffer())];
  const { database, character } = project;
  return {
    ...project,
    inputs: await Promise.all(project.inputs.map(async (input) => ({ ...input, file: await bytes(input.file) }))),
    database: database && { ...database, file: await bytes(database.file) },
    character: character && { ...character, file: await bytes(character.file) },
  };
}

describe("a project file", () => {
  it("is read as it was written, to the bit", async () => {
    const file = await writeProject(FULL);
    expect(await plain(await readProject(file))).toEqual(await plain(FULL));
    expect(await file.arrayBuffer()).toEqual(await (await writeProject(FULL)).arrayBuffer());
  });

  it("may hold the state alone, or a character by reference", async () => {
    const state = toHash({ ...initialState(), styles: [{ name: "old", weight: 1 }] });
    expect(await readProject(await writeProject({ state, inputs: [] }))).toEqual({ state, inputs: [] });
    const character = { name: "bot.vrm", size: 9, sha256: DIGEST };
    expect((await readProject(await writeProject({ state, inputs: [], character }))).character).toEqual(character);
  });

  it("holds whatever names and bytes there are", async () => {
    const name = fc
      .string({ unit: "grapheme", minLength: 1, maxLength: 60 })
      // biome-ignore lint/suspicious/noControlCharactersInRegex: they are refused
      .filter((text) => text.trim() !== "" && !/[\u0000-\u001f\u007f]/.test(text));
    const input = fc.record({ name, bytes: fc.uint8Array({ maxLength: 300 }) });
    const inputs = fc.uniqueArray(input, { maxLength: 5, selector: (one) => one.name });
    await fc.assert(
      fc.asyncProperty(inputs, fc.string({ maxLength: 200 }), name, async (all, state, database) => {
        const project: Project = {
          state,
          inputs: all.map((one) => ({ name: one.name, file: new Blob([Uint8Array.from(one.bytes)]) })),
          database: { name: database, file: new Blob([database]) },
        };
        expect(await plain(await readProject(await writeProject(project)))).toEqual(await plain(project));
      }),
      { numRuns: 80 },
    );
  });

  it("stops when it is cancelled", async () => {
    const controller = new AbortController();
    controller.abort();
    await expect(readProject(await writeProject(FULL), { signal: controller.signal })).rejects.toThrow(DOMException);
    await expect(writeProject(FULL, { signal: controller.signal })).rejects.toThrow(DOMException);
  });
});

describe("what is no project file of this version", () => {
  it("gets a sentence", async () => {
    expect(await why(new Blob())).toMatch(/not a Strut project/);
    expect(await why(new Blob(["HIERARCHY"]))).toMatch(/not a Strut project/);
    expect(await why(new Blob([zipOf([{ name: "walk.bvh", content: "HIERARCHY" }])]))).toMatch(/not a Strut project/);
    expect(await why(archive({ ...MANIFEST, format: "other" }))).toMatch(/not a Strut project/);
    expect(await why(archive({ ...MANIFEST, version: VERSION + 1 }))).toMatch(/newer version of Strut.*format is 2/);
    expect(await why(archive({ ...MANIFEST, version: 0 }))).toMatch(/format 0 is too old/);
    expect(await why(archive({ ...MANIFEST, version: "1" }))).toMatch(/“version”/);
    expect(await why(archive("{"))).toMatch(/is not JSON/);
    expect(await why(archive([]))).toMatch(/not a Strut project/);
  });

  it("is told apart from one that is damaged, wherever it was cut off", async () => {
    const whole = await writeProject(FULL);
    for (let length = 0; length < whole.size; length += 37)
      expect(await why(whole.slice(0, length)), `${length} bytes`).toMatch(/\.$/);
  });

  it("says which file is missing, wrong or there twice", async () => {
    const input = { name: "walk", file: "inputs/1.bvh" };
    expect(await why(archive({ ...MANIFEST, inputs: [input] }))).toMatch(/“inputs\/1.bvh” is missing/);
    expect(await why(archive({ ...MANIFEST, inputs: [{ name: "walk" }] }))).toMatch(/missing/);
    const twice = zipOf([
      { name: "project.json", content: JSON.stringify(MANIFEST) },
      { name: "project.json", content: "{}" },
    ]);
    expect(await why(new Blob([twice]))).toMatch(/contains “project.json” twice/);
    const files = { "inputs/1.bvh": "HIERARCHY" };
    const wrong: [manifest: object, field: RegExp][] = [
      [{ inputs: {} }, /“inputs”/],
      [{ inputs: [7] }, /inputs\[0\]/],
      [{ inputs: [{ ...input, name: "" }] }, /name/],
      [{ inputs: [{ ...input, name: "a\u0007b" }] }, /name/],
      [{ inputs: [{ ...input, name: "x".repeat(256) }] }, /name/],
      [{ inputs: [{ ...input, reading: "up~w" }] }, /reading/],
      [{ inputs: [{ ...input, reading: 3 }] }, /reading/],
      [{ inputs: [input, input] }, /“inputs”/],
      [{ inputs: [{ ...input, exact: { file: "inputs/1.bvh", proportions: [1], rateHz: 60 } }] }, /proportions/],
      [
        { inputs: [{ ...input, exact: { file: "inputs/1.bvh", proportions: new Array(63).fill(1), rateHz: 60 } }] },
        /exact\.file/,
      ],
      [{ inputs: [{ ...input, exact: { file: "inputs/1.bvh", proportions: new Array(63).fill(1) } }] }, /rateHz/],
      [{ state: 4 }, /“state”/],
      [{ state: "x".repeat(LIMITS.state + 1) }, /“state”/],
      [{ database: "mine" }, /“database”/],
      [{ database: { file: "inputs/1.bvh" } }, /database\.name/],
      [{ character: { name: "bot.exe", size: 1, sha256: DIGEST } }, /character\.name/],
      [{ character: { name: "bot.glb", size: -1, sha256: DIGEST } }, /character\.size/],
      [{ character: { name: "bot.glb", size: 1, sha256: "no" } }, /sha256/],
      [{ character: { name: "bot.glb", size: 1, sha256: DIGEST, roles: { tail: "Tail" } } }, /roles/],
    ];
    for (const [manifest, field] of wrong)
      expect(await why(archive({ ...MANIFEST, ...manifest }, files)), JSON.stringify(manifest)).toMatch(field);
    const many = Array.from({ length: LIMITS.inputs + 1 }, () => input);
    expect(await why(archive({ ...MANIFEST, inputs: many }, files))).toMatch(/501 motions; the limit is 500/);
  });

  it("names files of the archive only: no path leads out of it", async () => {
    for (const path of ["../../etc/passwd", "/etc/passwd", "__proto__", "constructor", "https://example.org/x.bvh"])
      expect(await why(archive({ ...MANIFEST, inputs: [{ name: "walk", file: path }] }))).toMatch(/is missing/);
  });

  it("unpacks no bomb, and no checksum that is wrong", async () => {
    const bomb = zipOf([
      { name: "project.json", content: JSON.stringify({ ...MANIFEST, inputs: [{ name: "walk", file: "b" }] }) },
      { name: "b", content: new Uint8Array(64 << 20), claimedBytes: 10 },
    ]);
    expect(await why(new Blob([bomb]))).toMatch(/damaged.*200 times/);
    const manifest = zipOf([{ name: "project.json", content: " ".repeat(LIMITS.manifest + 1) }]);
    expect(await why(new Blob([manifest]))).toMatch(/damaged.*1 MB/);
  });

  it("gets a sentence or is read, whichever of its bytes are others", async () => {
    const whole = new Uint8Array(await (await writeProject(FULL)).arrayBuffer());
    const change = fc.tuple(fc.nat(whole.length - 1), fc.nat(255));
    await fc.assert(
      fc.asyncProperty(fc.array(change, { minLength: 1, maxLength: 6 }), async (changes) => {
        const bytes = whole.slice();
        for (const [at, value] of changes) bytes[at] = value;
        const read = await readProject(new Blob([bytes])).catch((thrown: unknown) => thrown);
        if (read instanceof Error) {
          expect(read).toBeInstanceOf(ProjectError);
          expect(read.message).toMatch(/\.$/);
        } else expect((read as Project).inputs.length).toBeLessThanOrEqual(LIMITS.inputs);
      }),
      { numRuns: 400 },
    );
  });

  it("gets a sentence or is read, whatever its manifest says", async () => {
    const some = fc.anything({ maxDepth: 2, withBigInt: false });
    const input = fc.record(
      { name: some, file: fc.oneof(some, fc.constant("a")), reading: some },
      { requiredKeys: [] },
    );
    const manifest = fc.record(
      {
        state: some,
        inputs: fc.oneof(some, fc.array(fc.oneof(some, input), { maxLength: 3 })),
        database: fc.oneof(some, fc.record({ name: some, file: fc.constant("a") })),
        character: fc.oneof(some, fc.record({ name: some, size: some, sha256: some, roles: some, file: some })),
      },
      { requiredKeys: [] },
    );
    await fc.assert(
      fc.asyncProperty(manifest, async (one) => {
        const read = await readProject(archive({ ...MANIFEST, ...one }, { a: "HIERARCHY" })).catch((e: unknown) => e);
        if (read instanceof Error) expect(read).toBeInstanceOf(ProjectError);
        else expect(typeof (read as Project).state).toBe("string");
      }),
      { numRuns: 300 },
    );
  });
});
