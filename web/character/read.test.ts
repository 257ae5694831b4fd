import { runInNewContext } from "node:vm";
import { afterEach, describe, expect, it, vi } from "vitest";
import { bytesOf, type CharacterSource } from "./read";

afterEach(() => vi.unstubAllGlobals());

const BYTES = [1, 2, 3];
const read = async (source: CharacterSource) => [...(await bytesOf(source, undefined))];

/** A response that breaks off. */
const broken = () =>
  new Response(
    new ReadableStream({
      pull(controller) {
        controller.error(new TypeError("network error"));
      },
    }),
  );

describe("the source of a character", () => {
  it("is bytes, a view of some of them, or a file", async () => {
    vi.stubGlobal("fetch", () => Promise.reject(new Error("no address")));
    expect(await read(Uint8Array.from(BYTES).buffer)).toEqual(BYTES);
    expect(await read(Uint8Array.from([0, ...BYTES, 0]).subarray(1, -1))).toEqual(BYTES);
    expect(await read(new Blob([Uint8Array.from(BYTES)]))).toEqual(BYTES);
  });

  it("may come from another frame, which has classes of its own", async () => {
    const foreign = runInNewContext("Uint8Array.from([1, 2, 3]).buffer") as ArrayBuffer;
    expect(foreign instanceof ArrayBuffer).toBe(false);
    expect(await read(foreign)).toEqual(BYTES);
    const { size, arrayBuffer } = { size: 3, arrayBuffer: async () => Uint8Array.from(BYTES).buffer };
    expect(await read({ size, arrayBuffer } as Blob)).toEqual(BYTES);
  });

  it("is reported in a sentence if the download breaks off", async () => {
    vi.stubGlobal("fetch", async () => broken());
    await expect(read("https://example.org/figure.glb")).rejects.toMatchObject({
      code: "load",
      message: "The file could not be loaded.",
    });
  });

  it("is reported as cancelled if it is aborted during the download", async () => {
    const abort = new AbortController();
    vi.stubGlobal("fetch", async () => {
      abort.abort("enough");
      return broken();
    });
    const reading = bytesOf("https://example.org/figure.glb", abort.signal);
    await expect(reading).rejects.toMatchObject({ code: "cancelled", cause: "enough" });
  });
});
