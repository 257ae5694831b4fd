import { describe, expect, test } from "vitest";
import { zipOf } from "../../../tests/zip";
import { Archive, readDirectory, readEntry, ZipError } from "./zip";

const MOST = 1 << 20;
const text = async (archive: Archive, index: number) => {
  const entries = await readDirectory(archive);
  return new TextDecoder().decode(await readEntry(archive, entries[index]!, MOST));
};

describe("an archive", () => {
  const files = [
    { name: "歩く/怒り_1.bvh", content: "HIERARCHY ".repeat(1000) },
    { name: '"><img src=x>.bvh', content: "x" },
    { name: "folder/", content: "" },
  ];

  for (const wide of [false, true])
    test(`is read file by file${wide ? ", with places of 64 bits" : ""}`, async () => {
      const archive = new Archive(new Blob([zipOf(files, wide)]));
      const entries = await readDirectory(archive);
      expect(entries.map(({ name }) => name)).toEqual([files[0]!.name, files[1]!.name]);
      expect(await text(archive, 0)).toBe(files[0]!.content);
      expect(await text(archive, 1)).toBe("x");
    });

  test("may claim anything about sizes: what it unpacks to counts", async () => {
    for (const claimedBytes of [0, 5, 1e9]) {
      const archive = new Archive(new Blob([zipOf([{ name: "a.bvh", content: "abc".repeat(5000), claimedBytes }])]));
      expect(await text(archive, 0)).toBe("abc".repeat(5000));
    }
  });

  test("with a comment behind its end is read", async () => {
    const archive = new Archive(new Blob([zipOf(files), "PK comment"]));
    expect((await readDirectory(archive)).length).toBe(2);
  });
});

describe("a hostile archive", () => {
  test("that unpacks to hundreds of times its size is stopped early", async () => {
    const archive = new Archive(
      new Blob([zipOf([{ name: "bomb.bvh", content: new Uint8Array(40 << 20), claimedBytes: 10 }])]),
    );
    const [entry] = await readDirectory(archive);
    expect(archive.file.size).toBeLessThan(100_000);
    await expect(readEntry(archive, entry!, 256 << 20)).rejects.toThrow("It unpacks to more than 200 times its size");
    await expect(readEntry(archive, entry!, MOST)).rejects.toThrow("It unpacks to more than the limit of 1 MB.");
  });

  test("whose content was changed is refused, though it can be unpacked", async () => {
    const whole = zipOf([{ name: "a.bvh", content: "HIERARCHY", stored: true }]);
    const archive = new Archive(new Blob([whole.with(whole.indexOf(0x48), 0x49)]));
    await expect(text(archive, 0)).rejects.toThrow("It is damaged: its checksum does not match its content.");
  });

  test("cut short or changed anywhere gives a sentence or the same files, never another error", async () => {
    const content = "HIERARCHY ".repeat(50);
    const whole = zipOf([{ name: "a.bvh", content }], true);
    const outcomes = new Set<string>();
    for (let i = 0; i < whole.length; i++)
      for (const damaged of [whole.slice(0, i), whole.with(i, whole[i]! ^ 0x55)]) {
        const archive = new Archive(new Blob([damaged]));
        try {
          for (const index of (await readDirectory(archive)).keys())
            expect(await text(archive, index), `at ${i}`).toBe(content);
          outcomes.add("read");
        } catch (thrown) {
          expect(thrown, `at ${i}`).toBeInstanceOf(ZipError);
          expect((thrown as Error).message).toMatch(/\.$/);
          outcomes.add((thrown as Error).message);
        }
      }
    expect(outcomes).toContain("This is not a zip archive, or it is incomplete.");
    expect(outcomes).toContain("It is damaged: it cannot be unpacked.");
  });
});
