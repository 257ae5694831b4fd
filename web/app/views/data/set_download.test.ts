import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import { createServer, type Server } from "node:http";
import type { AddressInfo } from "node:net";
import { join } from "node:path";
import { afterEach, beforeEach, describe, expect, test, vi } from "vitest";
import { recordings, root } from "../../../../tests/recordings";
import type { Progress } from "../../../client/protocol";
import { type PublicSet, parseCatalogue, type SetFile } from "./catalogue";
import { type FileCache, fetchSet, filesKept, forgetSet, forgetUnlisted } from "./set_download";

/** A cache in memory. */
class FakeCache implements FileCache {
  readonly kept = new Map<string, ArrayBuffer>();
  async match(url: string): Promise<Response | undefined> {
    const bytes = this.kept.get(url);
    return bytes && new Response(bytes);
  }
  async put(url: string, response: Response): Promise<void> {
    this.kept.set(url, await response.arrayBuffer());
  }
  async delete(url: string): Promise<boolean> {
    return this.kept.delete(url);
  }
  async keys() {
    return [...this.kept.keys()].map((url) => ({ url }));
  }
}

const sets = parseCatalogue(JSON.parse(readFileSync(join(root, "public/catalog.json"), "utf8")));
const data = recordings();

let server: Server;
let cache: FakeCache;
let asked: string[];
/** The server's answers; by default recordings. */
let answer: (path: string) => Buffer | number;
beforeEach(async () => {
  cache = new FakeCache();
  asked = [];
  answer = (path) => Buffer.from(`clip ${path}`);
  server = createServer((request, response) => {
    asked.push(request.url!);
    const body = answer(decodeURI(request.url!));
    response.statusCode = typeof body === "number" ? body : 200;
    response.end(typeof body === "number" ? "" : body);
  });
  await new Promise<void>((resolve) => server.listen(0, "127.0.0.1", resolve));
});
afterEach(() => {
  vi.restoreAllMocks();
  server.close();
});

const base = () => `http://127.0.0.1:${(server.address() as AddressInfo).port}/`;
const small = (files: (string | SetFile)[]): PublicSet => ({
  ...sets[0]!,
  name: "Small",
  base: base(),
  files: files.map((file) => (typeof file === "string" ? { path: file } : file)),
});

describe("a set", () => {
  test("is fetched once and kept", async () => {
    const set = small(["a b.bvh", "sub/ä.bvh"]);
    const files = await fetchSet(set, cache);
    expect(files.map(({ path }) => path)).toEqual(["Small/a b.bvh", "Small/sub/ä.bvh"]);
    expect(await files[1]!.file.text()).toBe("clip /sub/ä.bvh");
    expect(await filesKept(set, cache)).toBe(2);
    await fetchSet(set, cache);
    expect(asked).toHaveLength(2);
    await forgetSet(set, cache);
    expect(await filesKept(set, cache)).toBe(0);
  });

  test("is fetched without cookies, and without saying from where", async () => {
    const fetched = vi.spyOn(globalThis, "fetch");
    await fetchSet(small(["a.bvh", "b.bvh"]), cache);
    expect(fetched).toHaveBeenCalledTimes(2);
    for (const [, init] of fetched.mock.calls)
      expect(init).toMatchObject({ credentials: "omit", referrerPolicy: "no-referrer" });
  });

  test("whose files have hashes is kept as far as they are the files that were meant", async () => {
    const sha256 = (text: string) => createHash("sha256").update(text).digest("hex");
    const set = small([
      { path: "a.bvh", sha256: sha256("clip /a.bvh") },
      { path: "b.bvh", sha256: sha256("clip as it was") },
    ]);
    await expect(fetchSet(set, cache)).rejects.toMatchObject({
      code: "bad-file",
      message: "b.bvh differs from the file in the list of public data sets, and was discarded.",
      hint: expect.stringContaining(`Get the files from ${set.page}`),
    });
    expect(cache.kept.has(`${base()}b.bvh`)).toBe(false);
    answer = (path) => Buffer.from(path === "/b.bvh" ? "clip as it was" : `clip ${path}`);
    const files = await fetchSet(set, cache);
    expect(await files[1]!.file.text()).toBe("clip as it was");
  });

  test("that the catalogue names no more leaves the cache", async () => {
    const [old, listed] = [small(["old.bvh"]), small(["a.bvh"])];
    await fetchSet(old, cache);
    await fetchSet(listed, cache);
    await forgetUnlisted([listed], cache);
    expect([await filesKept(old, cache), await filesKept(listed, cache)]).toEqual([0, 1]);
  });

  test("that was cancelled goes on with what is missing", async () => {
    const set = small(Array.from({ length: 30 }, (_, i) => `${i}.bvh`));
    const controller = new AbortController();
    const onProgress = ({ label }: Progress) => /^Small: 1\d files of 30/.test(label) && controller.abort();
    await expect(fetchSet(set, cache, { signal: controller.signal, onProgress })).rejects.toMatchObject({
      code: "cancelled",
    });
    const kept = await filesKept(set, cache);
    expect(kept).toBeGreaterThanOrEqual(10);
    expect(kept).toBeLessThan(30);
    const before = new Set(cache.kept.keys());
    asked = [];
    const told: number[] = [];
    expect(await fetchSet(set, cache, { onProgress: ({ fraction }) => told.push(fraction) })).toHaveLength(30);
    expect(asked.filter((path) => before.has(new URL(path, base()).href))).toEqual([]);
    expect(told.at(-1)).toBe(1);
    expect([...told].sort((a, b) => a - b)).toEqual(told);
  });

  test("that is not there, or not to be had, gives a sentence that says what to do", async () => {
    const set = small(["a.bvh", "b.bvh"]);
    answer = (path) => (path === "/b.bvh" ? 404 : Buffer.from("clip"));
    await expect(fetchSet(set, cache)).rejects.toMatchObject({
      message: expect.stringMatching(/^127\.0\.0\.1:\d+ answered 404 for b\.bvh\.$/),
      hint: expect.stringContaining(`Get the files from ${set.page}`),
    });
    await expect(fetchSet({ ...set, base: "http://127.0.0.1:9/" }, new FakeCache())).rejects.toMatchObject({
      message: "127.0.0.1:9 cannot be reached, or does not allow other pages to read its files.",
    });
  });

  test.skipIf(!data)("of the catalogue arrives as it is served", async () => {
    for (const id of ["bandai-namco-1", "bandai-namco-2"]) {
      const set = sets.find((s) => s.id === id)!;
      answer = (path) => readFileSync(join(data!, id, path));
      const files = await fetchSet({ ...set, base: base() }, cache);
      expect(files.reduce((sum, { file }) => sum + file.size, 0)).toBe(set.bytes);
      cache.kept.clear();
    }
  });
});
