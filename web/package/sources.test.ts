import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { runInNewContext } from "node:vm";
import { afterAll, beforeAll, describe, expect, test, vi } from "vitest";
import { builtInName, readSource } from "./sources";
import type { Source } from "./types";

const BVH = "HIERARCHY\nROOT Hips\n";

/** The text and the name of a source. */
async function read(source: Source): Promise<[name: string, text: string]> {
  const { name, bytes } = await readSource(source, "motion");
  return [name, new TextDecoder().decode(bytes)];
}

describe("a source", () => {
  let folder: string;
  beforeAll(() => {
    folder = mkdtempSync(join(tmpdir(), "strut-source-"));
    writeFileSync(join(folder, "a walk.bvh"), BVH);
  });
  afterAll(() => rmSync(folder, { recursive: true }));

  test("is text, bytes, a file, or an address of one", async () => {
    const bytes = new TextEncoder().encode(BVH);
    expect(await read(BVH)).toEqual(["", BVH]);
    expect(await read(bytes)).toEqual(["", BVH]);
    expect(await read(bytes.buffer)).toEqual(["", BVH]);
    expect(await read(new Blob([BVH]))).toEqual(["", BVH]);
    expect(await read(new File([BVH], "my walk.v2.bvh"))).toEqual(["my walk.v2", BVH]);
    expect(await read(pathToFileURL(join(folder, "a walk.bvh")))).toEqual(["a walk", BVH]);
    expect(await read(join(folder, "a walk.bvh"))).toEqual(["a walk", BVH]);
    expect(await read(`data:text/plain,${encodeURIComponent(BVH)}`)).toEqual(["", BVH]);
  });

  test("is the part of a larger buffer that it is a view of", async () => {
    const bytes = new TextEncoder().encode(`xx${BVH}xx`);
    expect(await read(bytes.subarray(2, -2))).toEqual(["", BVH]);
  });

  test("may come from a frame, whose classes are others", async () => {
    const foreign = runInNewContext("new ArrayBuffer(3)") as ArrayBuffer;
    expect(foreign instanceof ArrayBuffer).toBe(false);
    expect((await readSource(foreign, "motion")).bytes.byteLength).toBe(3);
  });

  test.each([
    [undefined, "The motion cannot be Undefined."],
    [42, "The motion cannot be Number."],
    [{}, "The motion cannot be Object."],
    ["http://", "The motion 'http://' is not a URL."],
  ])("is not %o", async (source, message) => {
    const reading = readSource(source as unknown as Source, "motion");
    await expect(reading).rejects.toMatchObject({ code: "bad-input", message });
  });

  test("that is not there is a sentence", async () => {
    await expect(readSource("missing.bvh", "motion")).rejects.toMatchObject({
      code: "load",
      message: expect.stringMatching(/^The motion file:.*missing\.bvh could not be loaded: there is no such file\.$/),
    });
  });

  test("is not read for somebody who has given up", async () => {
    const signal = AbortSignal.abort("enough");
    await expect(readSource(BVH, "motion", signal)).rejects.toMatchObject({ code: "cancelled", cause: "enough" });
  });

  test("has a built-in name after strut:", () => {
    expect(builtInName("strut:neutral-walk")).toBe("neutral-walk");
    expect(builtInName("https://x/strut:walk")).toBeUndefined();
    expect(builtInName(new URL("https://x/"))).toBeUndefined();
  });
});

test("a percent sign in an address stands for itself where it begins no code", async () => {
  vi.stubGlobal("fetch", async () => new Response("HIERARCHY"));
  expect(await readSource("https://example.org/50%.bvh", "motion")).toMatchObject({ name: "50%" });
  vi.unstubAllGlobals();
});
