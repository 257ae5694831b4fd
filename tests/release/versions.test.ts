/** A release's version: found in every file that contains it, and raised in all of them at once. */
import { cpSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterEach, beforeEach, expect, test } from "vitest";
import {
  currentVersion,
  newestChanges,
  raiseVersion,
  tagFaults,
  versionedFiles,
  versionFaults,
} from "../../scripts/release/versions.mjs";
import { root } from "../recordings";

let folder: string;
beforeEach(() => {
  folder = mkdtempSync(join(tmpdir(), "strut-versions-"));
  for (const file of versionedFiles()) cpSync(join(root, file), join(folder, file));
  // The state between two releases.
  change("CHANGELOG.md", /^## .*$/m, "## Unreleased");
});
afterEach(() => rmSync(folder, { recursive: true }));

const read = (file: string) => readFileSync(join(folder, file), "utf8");
const change = (file: string, from: RegExp, to: string) =>
  writeFileSync(join(folder, file), read(file).replace(from, to));

test("the version is the same everywhere", () => {
  expect(versionFaults()).toEqual([]);
});

test.each(versionedFiles().filter((file) => file !== "CHANGELOG.md"))("%s with another version is named", (file) => {
  const version = currentVersion();
  const [heading] = new RegExp(`strut-motion[^0-9]{0,40}${version}`).exec(read(file)) ?? [`"${version}"`];
  writeFileSync(join(folder, file), read(file).replace(heading, heading.replace(version, "7.7.7")));
  if (file === "CITATION.cff") change(file, /^version: .*$/m, "version: 7.7.7");
  const faults = versionFaults(folder);
  expect(faults.length).toBeGreaterThan(0);
  // Where the version of package.json differs, all others do.
  if (file !== "package.json") expect(faults.every((fault) => fault.startsWith(file))).toBe(true);
});

test("raising it leaves one version, a dated changelog, and a tag that fits", () => {
  const changes = newestChanges(folder);
  expect(tagFaults("v9.8.7", folder)).toHaveLength(2);
  raiseVersion("9.8.7", "2031-05-06", folder);
  expect(currentVersion(folder)).toBe("9.8.7");
  expect(versionFaults(folder)).toEqual([]);
  expect(tagFaults("v9.8.7", folder)).toEqual([]);
  expect(read("CHANGELOG.md")).toContain("## 9.8.7 (2031-05-06)");
  expect(newestChanges(folder)).toBe(changes);
  // The next release needs its own changes.
  expect(() => raiseVersion("9.8.8", "2031-05-07", folder)).toThrow(/Unreleased/);
});

test("what is no version is refused, and nothing is written", () => {
  const before = versionedFiles().map(read);
  expect(() => raiseVersion("next", "2031-05-06", folder)).toThrow(/"next" is not a version/);
  expect(versionedFiles().map(read)).toEqual(before);
});
