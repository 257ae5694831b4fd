import { readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, expect, test } from "vitest";
import { root } from "../../../../tests/recordings";
import { filesOf, parseCatalogue } from "./catalogue";

const shipped = JSON.parse(readFileSync(join(root, "public/catalog.json"), "utf8")) as unknown;

const SET = {
  id: "small",
  name: "Small",
  about: "two walks",
  licence: { name: "CC0", url: "https://example.org/cc0", note: "None." },
  citation: "Nobody, 2026",
  page: "https://example.org/set",
  bytes: 0,
  base: "https://example.org/set/",
  files: ["a b.bvh", { path: "sub/b.bvh", url: "b/content", sha256: "0".repeat(64) }],
};
const parsed = (patch: object) => parseCatalogue({ version: 1, sets: [{ ...SET, ...patch }] });

describe("the catalogue that comes with the page", () => {
  const sets = parseCatalogue(shipped);

  test("is as expected, and says of every set what it is, whose, and where it is", () => {
    expect(sets.map(({ id }) => id)).toEqual(["bandai-namco-1", "bandai-namco-2", "100style", "cmu-styles", "lafan1"]);
  });

  test("names revisions that cannot change, or the hash of every file", () => {
    // Zenodo never changes the files of a record.
    const fixed = /\/[0-9a-f]{40}\/|^https:\/\/zenodo\.org\/api\/records\/\d+\//;
    for (const { id, base, files } of sets)
      expect(fixed.test(base) || files.every(({ sha256 }) => sha256 !== undefined), id).toBe(true);
  });
});

describe("a catalogue", () => {
  test("gives every file its path and its address", () => {
    const [set] = parsed({});
    expect(filesOf(set!)).toEqual([
      { path: "a b.bvh", url: "https://example.org/set/a%20b.bvh" },
      { path: "sub/b.bvh", url: "https://example.org/set/b/content", sha256: "0".repeat(64) },
    ]);
  });

  test("that is not as expected is refused with the field and what it should be", () => {
    const refusal = (catalogue: unknown) => expect(() => parseCatalogue(catalogue));
    const expectRefused = (patch: object, at: string) =>
      refusal({ version: 1, sets: [{ ...SET, ...patch }] }).toThrow(
        new RegExp(`^The list of public data sets is invalid: sets\\[0\\]${at} should be .*\\.$`),
      );
    refusal(null).toThrow("catalog.json should be an object.");
    refusal({ version: 2, sets: [] }).toThrow("version should be 1.");
    refusal({ version: 1, sets: {} }).toThrow("sets should be a list.");
    refusal({ version: 1, sets: [SET, SET] }).toThrow("sets should be sets with different ids.");
    for (const field of ["id", "name", "about", "citation", "page"]) expectRefused({ [field]: "" }, `\\.${field}`);
    for (const bytes of [-1, 0.5, "12", undefined]) expectRefused({ bytes }, "\\.bytes");
    for (const base of ["http://example.org/", "https://example.org", "javascript:alert(1)//", "/sets/"])
      expectRefused({ base }, "\\.base");
    expectRefused({ licence: { ...SET.licence, url: "javascript:alert(1)" } }, "\\.licence\\.url");
    expectRefused({ page: "data:text/html,x" }, "\\.page");
    expectRefused({ files: [] }, "\\.files");
    expectRefused({ files: ["a.bvh", "a.bvh"] }, "\\.files");
    for (const path of ["../a.bvh", "/a.bvh", "a//b.bvh", "a\\..\\b.bvh", "./a.bvh", 7])
      expectRefused({ files: [path] }, "\\.files\\[0\\].*");
    for (const url of ["../../elsewhere", "a b"])
      expectRefused({ files: [{ path: "a", url }] }, "\\.files\\[0\\]\\.url");
    for (const sha256 of ["", "0".repeat(63), "G".repeat(64), 5])
      expectRefused({ files: [{ path: "a", sha256 }] }, "\\.files\\[0\\]\\.sha256");
    expectRefused({ pattern: 5 }, "\\.pattern");
  });
});
