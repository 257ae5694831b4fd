import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { Archive, readDirectory, readEntry, ZipError } from "./zip";
import { ZipWriter } from "./zip_writer";

/** The files of an archive. */
async function filesOf(blob: Blob): Promise<Record<string, Uint8Array>> {
  const archive = new Archive(blob);
  const entries = await readDirectory(archive);
  const read = entries.map(async (entry) => [entry.name, await readEntry(archive, entry, 1 << 20)] as const);
  return Object.fromEntries(await Promise.all(read));
}

describe("an archive that is written", () => {
  it("is read as it was", async () => {
    const name = fc.string({ unit: "grapheme", minLength: 1, maxLength: 40 }).filter((text) => !/[\\/\0]/.test(text));
    const file = fc.tuple(name, fc.uint8Array({ maxLength: 2000 }), fc.boolean());
    const files = fc.uniqueArray(file, { maxLength: 8, selector: ([path]) => path });
    await fc.assert(
      fc.asyncProperty(files, async (all) => {
        const writer = new ZipWriter();
        for (const [path, bytes, packed] of all) await writer.add(path, Uint8Array.from(bytes), packed);
        const read = await filesOf(writer.archive());
        expect(Object.keys(read)).toEqual(all.map(([path]) => path).sort(byOrderIn(read)));
        for (const [path, bytes] of all) expect(read[path]).toEqual(Uint8Array.from(bytes));
      }),
      { numRuns: 60 },
    );
  });

  it("can be saved before the last file", async () => {
    const writer = new ZipWriter();
    await writer.add("a/one.bvh", new TextEncoder().encode("one ".repeat(500)));
    expect(Object.keys(await filesOf(writer.archive()))).toEqual(["a/one.bvh"]);
    expect(writer.bytes).toBeLessThan(500);
    const report = { name: "report.csv", bytes: new TextEncoder().encode("done") };
    expect(Object.keys(await filesOf(writer.archive("application/zip", report)))).toEqual(["a/one.bvh", "report.csv"]);
    await writer.add("a/two.bvh", new TextEncoder().encode("two"));
    expect(Object.keys(await filesOf(writer.archive()))).toEqual(["a/one.bvh", "a/two.bvh"]);
  });

  it("refuses a second file of a name and what it has no room for, and stays as it was", async () => {
    const writer = new ZipWriter(400);
    await writer.add("one", new Uint8Array(100), false);
    await expect(writer.add("one", new Uint8Array(1))).rejects.toThrow("already has a file");
    await expect(writer.add("large", new Uint8Array(400), false)).rejects.toThrow(ZipError);
    expect(Object.keys(await filesOf(writer.archive()))).toEqual(["one"]);
  });

  it("has the same bytes for the same files", async () => {
    const made = async () => {
      const writer = new ZipWriter();
      await writer.add("walk.bvh", new TextEncoder().encode("HIERARCHY\n".repeat(30)));
      return new Uint8Array(await writer.archive().arrayBuffer());
    };
    expect(await made()).toEqual(await made());
  });
});

/** Integer-like names come first in an object's keys. */
function byOrderIn(object: object): (a: string, b: string) => number {
  const keys = Object.keys(object);
  return (a, b) => keys.indexOf(a) - keys.indexOf(b);
}
