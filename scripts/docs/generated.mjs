// Generated and committed texts: the pages of the reference, and the code blocks that come from examples.
import { existsSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { readTables } from "../element_manifest.mjs";
import { output, root, Sentence } from "../steps.mjs";
import { commandFaults } from "./commands.mjs";
import { elementFaults } from "./elements.mjs";
import { withExamples } from "./examples.mjs";
import { commandLinePage } from "./reference/command_line.mjs";
import { elementPage } from "./reference/element.mjs";
import { errorsPage } from "./reference/errors.mjs";
import { filesPage } from "./reference/files.mjs";
import { javascriptPage } from "./reference/javascript.mjs";
import { pythonPage } from "./reference/python.mjs";

const REFERENCE = "docs/reference/";
const NOTE = "<!-- Written by `npm run docs`; changes here are lost. -->\n\n";

/** Returns the output of `strut reference`. @param command the path of `strut` */
async function readCommands(command) {
  const printed = await output(command, ["reference"]);
  if (printed === undefined) throw new Sentence(`${command} does not print its reference.`);
  return JSON.parse(printed);
}

/** Returns the pages of the reference, as Markdown, by file. */
function pages(commands, tables) {
  return {
    "command-line.md": commandLinePage(commands),
    "python.md": pythonPage(commands),
    "javascript.md": javascriptPage(),
    "strut-player.md": elementPage(tables),
    "errors.md": errorsPage(),
    "files.md": filesPage(),
  };
}

/** Returns handwritten Markdown files, which may have code blocks. */
function writtenFiles() {
  const inDocs = readdirSync(join(root, "docs"), { recursive: true })
    .filter((name) => name.endsWith(".md") && !`docs/${name}`.startsWith(REFERENCE))
    .map((name) => `docs/${name}`);
  const others = [
    "README.md",
    "CONTRIBUTING.md",
    "CHANGELOG.md",
    "examples/README.md",
    "examples/ray/README.md",
    "web/package/README.md",
  ];
  return [...others, ...inDocs.sort()];
}

/**
 * Returns the up-to-date content of everything that is generated.
 * @returns `files`, texts by path in the repository, and `faults` of code blocks
 */
async function generate(command) {
  const [commands, tables] = await Promise.all([readCommands(command), readTables()]);
  const files = new Map();
  for (const [name, page] of Object.entries(pages(commands, tables))) files.set(`${REFERENCE}${name}`, withNote(page));
  const faults = [];
  for (const file of writtenFiles()) {
    const { text, faults: found } = withExamples(readFileSync(join(root, file), "utf8"), file);
    files.set(file, text);
    faults.push(...found);
    // The changelog describes former versions.
    if (file !== "CHANGELOG.md")
      faults.push(...commandFaults(text, file, commands), ...elementFaults(text, file, tables));
  }
  return { files, faults };
}

/** Adds a note for readers of the source below the title of a page. */
const withNote = (markdown) => markdown.replace(/^(# .*\n\n)/, `$1${NOTE}`);

const isCommitted = (file, text) => existsSync(join(root, file)) && readFileSync(join(root, file), "utf8") === text;

/** Updates the generated texts and prints which changed. */
export async function writeGenerated(command) {
  const { files, faults } = await generate(command);
  if (faults.length > 0) throw new Sentence(`code blocks are untested:\n  ${faults.join("\n  ")}`);
  const changed = [...files].filter(([file, text]) => !isCommitted(file, text));
  for (const [file, text] of changed) writeFileSync(join(root, file), text);
  return changed.map(([file]) => file).join(", ");
}

/** Returns a message for each text that is not up to date. */
export async function generatedFaults(command) {
  const { files, faults } = await generate(command);
  const stale = [...files]
    .filter(([file, text]) => !isCommitted(file, text))
    .map(([file]) => `${file} is not as 'npm run docs' writes it`);
  return [...stale, ...faults];
}
