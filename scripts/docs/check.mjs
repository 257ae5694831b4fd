// Checks of the documentation site: links, anchors and sizes.
import { existsSync, readdirSync, readFileSync, statSync } from "node:fs";
import { dirname, join, relative } from "node:path";
import { gzipSync } from "node:zlib";
import { OUT } from "./site.mjs";

/** Greatest sizes after gzip, kilobytes: what every page loads, what the search loads, and both together. */
const BUDGET_KB = [
  { name: "scripts", files: ["manual.js", "search.js"], budget: 60 },
  { name: "the index of the search", files: ["search_index.js"], budget: 100 },
];

const pagesOf = (folder) =>
  readdirSync(folder, { recursive: true })
    .filter((name) => name.endsWith(".html"))
    .map((name) => join(folder, name));

const ids = new Map();

/** Returns the anchors of a page. */
function idsOf(path) {
  if (!ids.has(path))
    ids.set(path, new Set([...readFileSync(path, "utf8").matchAll(/\sid="([^"]+)"/g)].map(([, id]) => id)));
  return ids.get(path);
}

/** Returns a message for each broken link of the site's pages. */
export function linkFaults() {
  return pagesOf(OUT).flatMap((page) => {
    const html = readFileSync(page, "utf8");
    const addresses = new Set(
      [...html.matchAll(/<[a-z][^>]*?\s(?:href|src)="([^"]+)"/g)].map(([, address]) => address),
    );
    return [...addresses]
      .filter((address) => !leads(page, address))
      .map((address) => `${relative(OUT, page)}: ${address} leads nowhere`);
  });
}

function leads(page, address) {
  if (/^[a-z][a-z+.-]*:/i.test(address)) return true;
  const [path, anchor] = address.replaceAll("&amp;", "&").split("#");
  const target = path === "" ? page : join(dirname(page), path);
  if (!existsSync(target) || statSync(target).isDirectory()) return false;
  return !anchor || !target.startsWith(OUT) || idsOf(target).has(decodeURIComponent(anchor));
}

/** Returns a message for each part of the site that exceeds its size, and one with all sizes. */
export function sizes() {
  const found = BUDGET_KB.map(({ name, files, budget }) => {
    const bytes = files.map((file) => gzipSync(readFileSync(join(OUT, "assets", file))).length);
    return { name, budget, kb: bytes.reduce((sum, each) => sum + each, 0) / 1000 };
  });
  const said = ({ name, kb, budget }) => `${name} ${kb.toFixed(1)} of ${budget} kB gzip`;
  return { faults: found.filter(({ kb, budget }) => kb > budget).map(said), report: found.map(said).join(", ") };
}
