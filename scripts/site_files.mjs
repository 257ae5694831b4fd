// Which files of the built site are loaded with what, from the manifest that vite writes into dist/.
import { readdirSync, readFileSync } from "node:fs";
import { basename, extname, join } from "node:path";

/** The page, and the module that its first script always imports, dynamically so that it runs in a task of its own. */
const PAGE = ["index.html", "shell/app.ts"];

/**
 * The files of the playground in dist/.
 * @returns the manifest of its chunks; `first`: what the page loads without being asked, which is {@link PAGE} with all that
 * it imports statically, the style sheets, and the workers, modules, fonts and data that these name; `rest`: what it loads when
 * a person asks for it
 */
export function siteFiles(dist) {
  const manifest = JSON.parse(readFileSync(join(dist, ".vite", "manifest.json"), "utf8"));
  const first = filesWith(dist, manifest, ({ imports = [] }) => imports);
  const all = filesWith(dist, manifest, ({ imports = [], dynamicImports = [] }) => [...imports, ...dynamicImports]);
  return { manifest, first, rest: all.filter((file) => !first.includes(file)) };
}

/** The files that the page loads, if its chunks load those that `follow` gives. */
function filesWith(dist, manifest, follow) {
  const chunks = new Set(PAGE);
  // A set grows while it is walked.
  for (const key of chunks) for (const other of follow(manifest[key])) chunks.add(other);
  const filesOf = (key) => [manifest[key].file, ...(manifest[key].css ?? [])];
  const files = new Set([...chunks].flatMap(filesOf));
  const others = Object.keys(manifest).filter((key) => !chunks.has(key));
  // The manifest lists some data too; whether they are loaded is for those to say who name them.
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
