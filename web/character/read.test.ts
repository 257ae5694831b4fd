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

  it("may come from a frame, whose classes are others", async () => {
    const foreign = runInNewContext("Uint8Array.from([1, 2, 3]).buffer") as ArrayBuffer;
    expect(foreign instanceof ArrayBuffer).toBe(false);
    expect(await read(foreign)).toEqual(BYTES);
    const { size, arrayBuffer } = { size: 3, arrayBuffer: async () => Uint8Array.from(BYTES).buffer };
    expect(await read({ size, arrayBuffer } as Blob)).toEqual(BYTES);
  });

  it("that breaks off on the way is a sentence", async () => {
    vi.stubGlobal("fetch", async () => broken());
    await expect(read("https://example.org/figure.glb")).rejects.toMatchObject({
      code: "load",
      message: "The file could not be loaded.",
    });
  });

  it("that somebody has given up while it arrives is cancelled", async () => {
    const abort = new AbortController();
    vi.stubGlobal("fetch", async () => {
      abort.abort("enough");
      return broken();
    });
    const reading = bytesOf("https://example.org/figure.glb", abort.signal);
    await expect(reading).rejects.toMatchObject({ code: "cancelled", cause: "enough" });
  });
});
