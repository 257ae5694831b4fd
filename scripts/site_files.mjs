// Files of the built site by when they are loaded, from the manifest that Vite writes into dist/.
import { readdirSync, readFileSync } from "node:fs";
import { basename, extname, join } from "node:path";

/** The page, and the module that its first script always imports, dynamically so that it runs in a separate task. */
const PAGE = ["index.html", "shell/app.ts"];

/**
 * Returns the files of the playground in dist/.
 * @returns the manifest of its chunks; `first`: the files that the page always loads, which are {@link PAGE} with all
 * static imports, the style sheets, and the workers, modules, fonts and data that these name; `rest`: the files that it
 * loads on demand
 */
export function siteFiles(dist) {
  const manifest = JSON.parse(readFileSync(join(dist, ".vite", "manifest.json"), "utf8"));
  const first = filesWith(dist, manifest, ({ imports = [] }) => imports);
  const all = filesWith(dist, manifest, ({ imports = [], dynamicImports = [] }) => [...imports, ...dynamicImports]);
  return { manifest, first, rest: all.filter((file) => !first.includes(file)) };
}

/** Returns the files that the page loads, if its chunks load those that `follow` returns. */
function filesWith(dist, manifest, follow) {
  const chunks = new Set(PAGE);
  // The set grows during the iteration.
  for (const key of chunks) for (const other of follow(manifest[key])) chunks.add(other);
  const filesOf = (key) => [manifest[key].file, ...(manifest[key].css ?? [])];
  const files = new Set([...chunks].flatMap(filesOf));
  const others = Object.keys(manifest).filter((key) => !chunks.has(key));
  // The manifest lists some data, too; they count only if a loaded file names them.
  const later = new Set(others.flatMap(filesOf).filter((file) => namesFiles(file) && !files.has(file)));
  const assets = readdirSync(join(dist, "assets")).map((name) => `assets/${name}`);
  for (const file of files) {
    if (!namesFiles(file)) continue;
    const text = readFileSync(join(dist, file), "utf8");
    for (const asset of assets) if (!later.has(asset) && text.includes(basename(asset))) files.add(asset);
  }
  return [...files];
}

const namesFiles = (file) => [".js", ".css"].includes(extname(file));
