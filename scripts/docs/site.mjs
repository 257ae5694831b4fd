// Writes the documentation site into dist/docs/.
import { cpSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { trimmedSheet } from "../katex_plugin.mjs";
import { root, Sentence } from "../steps.mjs";
import { addressesOf } from "./addresses.mjs";
import { examplePages } from "./examples.mjs";
import { readMap } from "./map.mjs";
import { renderMarkdown } from "./markdown.mjs";
import { searchIndex } from "./search_index.mjs";
import { pageHtml } from "./template.mjs";

/** The folder of the site. */
export const OUT = join(root, "dist", "docs");

/** Returns the rendered pages of the site. Throws a message if a link is broken. */
export function renderPages(sections) {
  const pages = sections.flatMap((section) => section.pages);
  const { resolverOf, pictures, faults } = addressesOf(pages);
  const rendered = pages.map((page) => ({ ...page, ...renderMarkdown(page.source, resolverOf(page)) }));
  if (faults.length > 0) throw new Sentence(`the documentation has dead links:\n  ${faults.join("\n  ")}`);
  return { pages: [...rendered, ...examplePages()], pictures };
}

/** Writes the site and returns how many pages it has. */
export async function writeDocs() {
  const sections = readMap();
  const { pages, pictures } = renderPages(sections);
  rmSync(OUT, { recursive: true, force: true });
  for (const page of pages) write(page.out, pageHtml(sections, page));
  for (const [file, place] of pictures) {
    mkdirSync(dirname(join(OUT, place)), { recursive: true });
    cpSync(join(root, file), join(OUT, place));
  }
  write("assets/search_index.js", searchIndex(pages));
  await writeAssets();
  return `${pages.length} pages`;
}

function write(place, text) {
  const path = join(OUT, place);
  mkdirSync(dirname(path), { recursive: true });
  writeFileSync(path, text);
}

/** Writes the style sheets, with the fonts, and the scripts. */
async function writeAssets() {
  // A clean checkout installs it only after this file is read.
  const { build } = await import("esbuild");
  const source = join(root, "web", "manual");
  await build({
    entryPoints: [
      ...["manual.ts", "search.ts", "manual.css"].map((name) => join(source, name)),
      { in: join(root, "node_modules", "katex", "dist", "katex.min.css"), out: "formulas" },
    ].map((entry) => (typeof entry === "string" ? { in: entry, out: outName(entry) } : entry)),
    outdir: join(OUT, "assets"),
    bundle: true,
    minify: true,
    format: "iife",
    target: ["es2022", "chrome123", "firefox125", "safari17.5"],
    loader: { ".woff2": "file" },
    assetNames: "[name]",
    legalComments: "none",
    logLevel: "warning",
    plugins: [FORMULAS],
  });
}

const outName = (path) => path.replace(/^.*\//, "").replace(/\.\w+$/, "");

/** KaTeX's style sheet with only the fonts that are used. */
const FORMULAS = {
  name: "formulas",
  setup({ onLoad }) {
    onLoad({ filter: /katex\.min\.css$/ }, ({ path }) => ({
      contents: trimmedSheet(readFileSync(path, "utf8")),
      loader: "css",
    }));
  },
};
