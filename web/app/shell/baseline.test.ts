import { readFileSync } from "node:fs";
import { expect, test } from "vitest";
import { isSupported } from "./baseline";

test("a browser is supported where it has everything that is looked for", () => {
  expect(isSupported([() => true, () => true])).toBe(true);
  expect(isSupported([() => true, () => false])).toBe(false);
});

test("a browser in which looking throws is not supported", () => {
  const absent = () => {
    throw new ReferenceError("DecompressionStream is not defined");
  };
  expect(isSupported([absent])).toBe(false);
});

test("every text that names a version of Safari names the same one", () => {
  const files = ["README.md", "docs/get-started.md", "web/app/index.html", "web/app/shell/strings.en.ts"];
  const named = [...files, "web/engine/module.ts"].map((path) => {
    const text = readFileSync(new URL(`../../../${path}`, import.meta.url), "utf8");
    return [path, [...text.matchAll(/Safari \(?(?:from )?(\d+(?:\.\d+)?)/g)].map(([, version]) => version)];
  });
  const expected = files.map((path) => [path, ["17.5"]]);
  expect(named).toEqual([...expected, ["web/engine/module.ts", []]]);
});
