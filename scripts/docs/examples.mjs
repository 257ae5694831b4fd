// Example files: shown as pages, and copied into the code blocks that name them.
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { root } from "../steps.mjs";
import { codeBlock, escapeHtml, slugOf } from "./markdown.mjs";

const FOLDER = join(root, "examples");

/** Languages whose code blocks must come from examples, which are run by tests. */
const CHECKED = new Set([
  "js",
  "javascript",
  "mjs",
  "jsx",
  "ts",
  "typescript",
  "html",
  "sh",
  "bash",
  "shell",
  "py",
  "python",
]);

/** What stands before a code block that comes from an example, and the block. */
const BLOCK = /^(<!-- example: (\S+?)(?:#([\w-]+))? -->\n\n?)(```)(\w*)\n([\s\S]*?)^```$/gm;

/** The lines of a file between `anchor NAME` and `end NAME`, without their common indentation. */
export function anchorOf(text, name) {
  const lines = text.split("\n");
  const at = (word) => lines.findIndex((line) => new RegExp(`(#|//|<!--) ${word} ${name}( -->)?$`).test(line.trim()));
  const [begin, end] = [at("anchor"), at("end")];
  if (begin < 0 || end < begin) return undefined;
  const found = lines
    .slice(begin + 1, end)
    .filter((line) => !/^\s*(#|\/\/|<!--) (anchor|end) [\w-]+( -->)?$/.test(line));
  const indents = found.filter((line) => line.trim() !== "").map((line) => /^ */.exec(line)[0].length);
  const indent = Math.min(...indents);
  return found.map((line) => line.slice(indent)).join("\n");
}

/**
 * Markdown with its examples as they are now.
 * @returns `text`, and `faults`, a sentence for each block that names no example, or none although its language is run
 */
export function withExamples(markdown, file) {
  const faults = [];
  const text = markdown.replace(BLOCK, (whole, comment, path, anchor, fence, language) => {
    const code = exampleCode(path, anchor);
    if (code === undefined) {
      faults.push(`${file}: there is no example ${path}${anchor ? `#${anchor}` : ""}`);
      return whole;
    }
    return `${comment}${fence}${language}\n${code.replace(/\n*$/, "\n")}\`\`\``;
  });
  return { text, faults: [...faults, ...uncheckedBlocks(markdown, file)] };
}

function exampleCode(path, anchor) {
  let text;
  try {
    text = readFileSync(join(FOLDER, path), "utf8");
  } catch {
    return undefined;
  }
  return anchor ? anchorOf(text, anchor) : text;
}

/** Blocks of code that should come from an example and do not. */
function uncheckedBlocks(markdown, file) {
  const faults = [];
  const lines = markdown.split("\n");
  let open;
  lines.forEach((line, index) => {
    const fence = /^\s*(```+)(\w*)/.exec(line);
    if (!fence) return;
    if (open) {
      open = undefined;
      return;
    }
    open = fence[1];
    const before = lines.slice(0, index).findLast((other) => other.trim() !== "") ?? "";
    if (CHECKED.has(fence[2]) && !before.startsWith("<!-- example: "))
      faults.push(`${file}:${index + 1}: this block of ${fence[2]} comes from no example; name one, or make it text`);
  });
  return faults;
}

/** Pages of the folders of `examples/`: every file, with its parts marked. */
export function examplePages() {
  return readdirSync(FOLDER, { withFileTypes: true })
    .filter((entry) => entry.isDirectory())
    .map(({ name }) => examplePage(name));
}

/** The page of a folder, and the anchors of its files. */
function examplePage(name) {
  const files = readdirSync(join(FOLDER, name), { withFileTypes: true })
    .filter((entry) => entry.isFile() && entry.name !== "package-lock.json")
    .map((entry) => entry.name)
    .sort();
  const headings = files.map((file) => ({ level: 2, id: slugOf(file), text: file }));
  const parts = headings.map(({ id, text: file }) => {
    const code = readFileSync(join(FOLDER, name, file), "utf8");
    return `<h2 id="${id}">${escapeHtml(file)}</h2>\n${codeBlock(code, file.split(".").at(-1))}`;
  });
  const title = `Example: ${name}`;
  return {
    out: `examples/${name}.html`,
    title,
    headings: [{ level: 1, id: "", text: title }, ...headings],
    html: `<h1>${escapeHtml(title)}</h1>\n<p>The files of <code>examples/${name}/</code> in the repository.</p>\n${parts.join("\n")}`,
    sections: [{ id: "", title, text: files }],
  };
}
