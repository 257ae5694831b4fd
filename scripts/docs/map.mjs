// The structure of the documentation site: its sections, and the Markdown file of each page.
import { readdirSync, readFileSync } from "node:fs";
import { join, posix } from "node:path";
import { root, Sentence } from "../steps.mjs";

/**
 * Sections in the order of the navigation. Paths are relative to docs/. A page outside it has a path in the site, one
 * with a long title a label.
 */
const SECTIONS = [
  { title: "Start", pages: [{ path: "README.md", label: "Overview" }, "get-started.md"] },
  {
    title: "Concepts",
    pages: [
      { path: "concepts.md", label: "Three methods" },
      "concepts/style-transfer.md",
      "concepts/walk-synthesis.md",
      "concepts/key-styling.md",
    ],
  },
  {
    title: "Guides",
    pages: [
      "own-styles.md",
      { path: "projects.md", label: "Projects" },
      "reading.md",
      "characters.md",
      "embedding.md",
      "command-line.md",
      "batch.md",
      "python.md",
      "blender.md",
      "live.md",
      "teaching.md",
      "hosting.md",
      "browsers.md",
      { path: "../examples/README.md", out: "examples/index.html" },
    ],
  },
  {
    title: "Reference",
    pages: [
      "reference/command-line.md",
      "reference/python.md",
      "reference/javascript.md",
      "reference/strut-player.md",
      "reference/errors.md",
      "reference/files.md",
    ],
  },
  {
    title: "Papers and methods",
    pages: [
      "papers.md",
      { path: "methods/mar.md", label: "Style transfer (MAR)" },
      { path: "methods/search.md", label: "Exact search" },
      { path: "methods/hsmm.md", label: "Walk synthesis (HSMM)" },
      { path: "methods/somn.md", label: "Key-styling (SOMN)" },
    ],
  },
  {
    title: "Evaluation",
    pages: [
      "evaluation.md",
      "real_files.md",
      "walk.md",
      "key-style.md",
      "driving.md",
      "crowd.md",
      "demo-motions.md",
      "lessons.md",
      "performance.md",
      "atlas.md",
    ],
  },
  {
    title: "Project",
    pages: [
      "glossary.md",
      "ARCHITECTURE.md",
      "releases.md",
      "faults.md",
      "accessibility.md",
      { path: "../CONTRIBUTING.md", out: "contributing.html" },
      { path: "../CHANGELOG.md", out: "changelog.html" },
    ],
  },
];

/**
 * Returns the page of a Markdown file: its path, its title and its label in the navigation, and its path in the site.
 */
function pageOf(entry) {
  const { path, out, label } = typeof entry === "string" ? { path: entry } : entry;
  const file = posix.normalize(posix.join("docs", path));
  const source = readFileSync(join(root, file), "utf8");
  const title = /^# (.+)$/m.exec(source)?.[1].replace(/[`*]/g, "");
  if (!title) throw new Error(`${file} has no title`);
  return { file, out: out ?? htmlName(path), source, title, label: label ?? title };
}

/** `a/b.md` → `a/b.html`; the README of a folder is its index. */
const htmlName = (path) => path.replace(/(^|\/)README\.md$/, "$1index.md").replace(/\.md$/, ".html");

/** Returns a message for each document that is in no section. */
function strayFiles(sections) {
  const mapped = new Set(sections.flatMap(({ pages }) => pages.map(({ file }) => file)));
  const files = readdirSync(join(root, "docs"), { recursive: true }).filter((name) => name.endsWith(".md"));
  return files.map((name) => `docs/${name}`).filter((file) => !mapped.has(file));
}

/** Reads all pages. Returns sections of `{ title, pages: { file, out, source, title, label }[] }`. */
export function readMap() {
  const sections = SECTIONS.map(({ title, pages }) => ({ title, pages: pages.map(pageOf) }));
  const stray = strayFiles(sections);
  if (stray.length > 0) throw new Sentence(`scripts/docs/map.mjs does not list ${stray.join(", ")}.`);
  return sections;
}
