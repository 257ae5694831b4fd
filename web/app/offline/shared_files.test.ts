import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { receiveShared, takeShared } from "./shared_files";

const FOLDER = "https://example.org/strut/";

/** A browser's caches, by name. */
let stores: Map<string, Map<string, Response>>;
beforeEach(() => {
  stores = new Map();
  vi.stubGlobal("caches", {
    delete: async (name: string) => stores.delete(name),
    open: async (name: string) => {
      const store = stores.get(name) ?? new Map<string, Response>();
      stores.set(name, store);
      return {
        put: async (url: string, response: Response) => void store.set(url, response),
        keys: async () => [...store.keys()].map((url) => ({ url })),
        match: async ({ url }: { url: string }) => store.get(url),
      };
    },
  });
});
afterEach(() => vi.unstubAllGlobals());

/** Sends files as another app does. */
async function share(...names: string[]): Promise<void> {
  const body = new FormData();
  for (const name of names) body.append("files", new File([`motion of ${name}`], name));
  await receiveShared(new Request(`${FOLDER}shared`, { method: "POST", body }), FOLDER);
}

/** Names and contents of the files that the page takes. */
const taken = async () =>
  Promise.all((await takeShared(FOLDER)).map(async (file) => [file.name, await file.text()] as const));

it("files that are shared are taken once", async () => {
  await share("my walk.bvh", "50%.bvh");
  expect(await taken()).toEqual([
    ["my walk.bvh", "motion of my walk.bvh"],
    ["50%.bvh", "motion of 50%.bvh"],
  ]);
  expect(await taken()).toEqual([]);
});

it("files of a later form replace those that were not taken", async () => {
  await share("planted.bvh", "planted too.bvh");
  await share("mine.bvh");
  expect(await taken()).toEqual([["mine.bvh", "motion of mine.bvh"]]);
});
