// The modules of web/, their imports, and the cycles among them. An import of types alone counts, too.
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { dirname, join, relative, resolve, sep } from "node:path";
import { circles } from "./circles.mjs";

/** Imports, re-exports, dynamic imports and URLs of files next to the module. */
const SPECIFIER = /(?:from|import|URL)\s*\(?\s*["'](\.[^"']+)["']/g;

/**
 * Returns the shipped TypeScript files below a folder, by relative path, each with the files that it imports.
 * @returns a map from a path to a map from the paths of its imports to their specifiers
 */
export function webModules(folder) {
  const shipped = [...filesUnder(folder)].filter((path) => path.endsWith(".ts") && !path.endsWith(".test.ts"));
  return new Map(shipped.map((path) => [shown(folder, path), importsOf(folder, path)]));
}

/** Returns a message for each cycle among modules. */
export function importCircles(modules) {
  const edges = new Map(
    [...modules].map(([path, imports]) => [
      path,
      new Map([...imports.keys()].map((to) => [to, `${path} imports ${to}`])),
    ]),
  );
  return circles(edges).map((circle) => `circle in web: ${circle.join("; ")}`);
}

function importsOf(folder, path) {
  const all = [...readFileSync(path, "utf8").matchAll(SPECIFIER)].map(([, specifier]) => specifier);
  // A file of a package is not a module of web/.
  const specifiers = all.filter((specifier) => !specifier.includes("/node_modules/"));
  return new Map(specifiers.map((specifier) => [shown(folder, fileOf(resolve(dirname(path), specifier))), specifier]));
}

/** Returns the file of a specifier without its extension. */
function fileOf(path) {
  return [`${path}.ts`, join(path, "index.ts")].find((file) => existsSync(file)) ?? path;
}

const shown = (folder, path) => relative(folder, path).split(sep).join("/");

function* filesUnder(folder) {
  for (const entry of readdirSync(folder, { withFileTypes: true })) {
    const path = join(folder, entry.name);
    if (entry.isDirectory() && entry.name !== "pkg") yield* filesUnder(path);
    else if (entry.isFile()) yield path;
  }
}
