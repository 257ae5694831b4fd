// Example files, which are shown as pages and copied into the code blocks that name them.
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { root, Sentence } from "../steps.mjs";
import { codesOf } from "./codes.mjs";
import { isChecked } from "./commands.mjs";
import { hasElement } from "./elements.mjs";
import { codeBlock, escapeHtml, slugOf } from "./markdown.mjs";

const FOLDER = join(root, "examples");
/** Files of tests may be shown, too. */
const TESTS = /^tests\//;

/** Languages of code blocks that must come from examples, which tests run or compile. */
const TESTED = new Set(["js", "javascript", "mjs", "jsx", "ts", "typescript", "py", "python"]);

/** Languages of code blocks that come from examples or are checked directly: their commands, or their elements. */
const CHECKED = {
  sh: (code) => code.split("\n").every(isChecked),
  bash: (code) => code.split("\n").every(isChecked),
  html: hasElement,
};

/** Code that could be tested. */
const CODE = /^\s*(import [\w{]|const |let |await |def |class |<\w|(npm|npx|node|pip|python) )/m;

/** The comment before a code block that comes from an example, and the block. */
const BLOCK = /^( *)(<!-- example: (\S+?)(?:#([\w-]+))? -->\n\n?) *(```)(\w*)\n([\s\S]*?)^ *```$/gm;

/** Returns the lines of a file between `anchor NAME` and `end NAME`, without their common indentation. */
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
 * Returns Markdown with up-to-date examples.
 * @returns `text`, and `faults`, a message for each block that names no existing example, or names none although its
 * language is tested
 */
export function withExamples(markdown, file) {
  const faults = [];
  const text = markdown.replace(BLOCK, (whole, indent, comment, path, anchor, fence, language) => {
    const code = exampleCode(path, anchor);
    if (code === undefined) {
      faults.push(`${file}: there is no example ${path}${anchor ? `#${anchor}` : ""}`);
      return whole;
    }
    const block = `${comment}${fence}${language}\n${code.replace(/\n*$/, "\n")}\`\`\``;
    return block.replace(/^(?=.)/gm, indent);
  });
  return { text, faults: [...faults, ...uncheckedBlocks(markdown, file)] };
}

/** Returns a block of code with an example, as it appears in a page. */
export function exampleBlock(path, anchor, language) {
  const code = exampleCode(path, anchor);
  if (code === undefined) throw new Sentence(`there is no example ${path}#${anchor}.`);
  return `<!-- example: ${path}#${anchor} -->\n\`\`\`${language}\n${code.replace(/\n*$/, "\n")}\`\`\``;
}

function exampleCode(path, anchor) {
  let text;
  try {
    text = readFileSync(join(TESTS.test(path) ? root : FOLDER, path), "utf8");
  } catch {
    return undefined;
  }
  return anchor ? anchorOf(text, anchor) : text;
}

/** Returns blocks of code that are not tested, although they could be. */
function uncheckedBlocks(markdown, file) {
  const lines = markdown.split("\n");
  return codesOf(markdown).flatMap(({ line, language, code }) => {
    // Markup and inline code are not blocks.
    if (!/^\s*(```|~~~)/.test(lines[line - 1]) || language === undefined) return [];
    const before = lines.slice(0, line - 1).findLast((other) => other.trim() !== "") ?? "";
    if (before.trim().startsWith("<!-- example: ")) return [];
    const fault = faultOf(language, code);
    return fault ? [`${file}:${line}: ${fault}`] : [];
  });
}

/** Returns the fault of a block that comes from no example. */
function faultOf(language, code) {
  if (language === "") return "this block names no language; text is one";
  if (language === "text") return CODE.test(code) ? "this block of text looks like code; name its language" : undefined;
  if (TESTED.has(language) || CHECKED[language]?.(code) === false)
    return `this block of ${language} comes from no example; name one, or make it text`;
  return undefined;
}

/** Returns pages of the folders of `examples/`: every file, with its parts marked. */
export function examplePages() {
  return readdirSync(FOLDER, { withFileTypes: true })
    .filter((entry) => entry.isDirectory())
    .map(({ name }) => examplePage(name));
}

/** Returns the page of a folder, and the anchors of its files. */
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
