// Tests of the check for cycles between web modules, on a folder of a few files.
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterEach, expect, test } from "vitest";
import { importCircles, webModules } from "../../scripts/web_modules.mjs";

const folders: string[] = [];
afterEach(() => {
  for (const folder of folders.splice(0)) rmSync(folder, { recursive: true });
});

/** Returns the cycles of a folder with these files. */
function circlesOf(files: Record<string, string>): string[] {
  const folder = mkdtempSync(join(tmpdir(), "strut-web-"));
  folders.push(folder);
  for (const [name, text] of Object.entries(files)) writeFileSync(join(folder, name), text);
  return importCircles(webModules(folder));
}

test("imports in one direction are no circle", () => {
  expect(circlesOf({ "a.ts": 'import { b } from "./b";', "b.ts": "export const b = 1;" })).toEqual([]);
});

test("two modules that import each other are a circle, be it for types alone", () => {
  const files = { "a.ts": 'import { b } from "./b";', "b.ts": 'import type { A } from "./a";' };
  expect(circlesOf(files)).toEqual(["circle in web: a.ts imports b.ts; b.ts imports a.ts"]);
});

test("a circle of three modules is found, through a dynamic import too", () => {
  const files = {
    "a.ts": 'export * from "./b";',
    "b.ts": 'const c = () => import("./c");',
    "c.ts": 'import { a } from "./a";',
  };
  expect(circlesOf(files)).toEqual(["circle in web: a.ts imports b.ts; b.ts imports c.ts; c.ts imports a.ts"]);
});

test("tests may import anything", () => {
  expect(circlesOf({ "a.ts": "", "a.test.ts": 'import "./a";' })).toEqual([]);
});
