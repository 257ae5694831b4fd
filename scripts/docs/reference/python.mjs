// The reference of the Python package, from its stubs and sources. The compiled part is documented by comments in Rust.
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { root, Sentence } from "../../steps.mjs";
import { meaning } from "./command_line.mjs";
import { declarationsOf } from "./python_stub.mjs";
import { docBefore, rustSource } from "./rust_docs.mjs";

const PACKAGE = join(root, "rust", "strut-python", "python", "strut");
const SOURCES = join("strut-python", "src");

/** Returns the doc comments of PyO3's exports, by `Class`, `Class.method` and `function`. */
export function compiledDocs() {
  const docs = new Map();
  for (const file of readdirSync(join(root, "rust", SOURCES)).filter((name) => name.endsWith(".rs"))) {
    const source = rustSource(join(SOURCES, file));
    for (const match of source.matchAll(/^(?:pub(?:\(crate\))? )?struct (\w+)/gm))
      docs.set(match[1], docBefore(source, match.index));
    for (const match of source.matchAll(/^(?:pub(?:\(crate\))? )?fn (\w+)/gm))
      docs.set(match[1], docBefore(source, match.index));
    for (const block of source.matchAll(/^#\[pymethods\]\nimpl (\w+) \{([\s\S]*?)^\}/gm))
      for (const match of block[2].matchAll(/^ {4}(?:pub(?:\(crate\))? )?fn (\w+)/gm))
        docs.set(`${block[1]}.${match[1]}`, docBefore(block[2], match.index + 4));
  }
  return docs;
}

/** Returns the names that a module exports. */
function exportedBy(source) {
  const list = /__all__ = \[([\s\S]*?)\]/.exec(source)?.[1] ?? "";
  return [...list.matchAll(/"(\w+)"/g)].map(([, name]) => name);
}

/** Returns all declarations of the package, by name. A stub has priority over the sources. */
function declarations() {
  const found = new Map();
  const files = readdirSync(PACKAGE).filter((name) => /\.pyi?$/.test(name) && name !== "__init__.py");
  for (const file of files.sort((a, b) => Number(a.endsWith(".pyi")) - Number(b.endsWith(".pyi"))))
    for (const declaration of declarationsOf(readFileSync(join(PACKAGE, file), "utf8")))
      if (!found.has(declaration.name) || file.endsWith(".pyi")) found.set(declaration.name, declaration);
  return found;
}

/**
 * Returns the page as Markdown. Throws a message if a public item has no description.
 * @param commands output of `strut reference`: options describe the keyword arguments of the same names
 */
export function pythonPage(commands) {
  const all = declarations();
  const docs = compiledDocs();
  const undocumented = [];
  const describe = (path, declaration, owner) => {
    const doc = declaration.doc || docs.get(path) || (owner ? optionDoc(declaration.name, owner.doc, commands) : "");
    // Keys of dictionaries are not names of the package.
    if (doc === "" && !owner?.signature.includes("TypedDict")) undocumented.push(path);
    return markdownOf(doc);
  };
  const modules = [{ name: "strut", file: "__init__.py" }, ...submodules()];
  const sections = modules.map(({ name, file }) => {
    const source = readFileSync(join(PACKAGE, file), "utf8");
    const names = exportedBy(source).filter((each) => !modules.some((module) => module.name === `strut.${each}`));
    const entries = names.map((each) => {
      const declaration = all.get(each);
      if (!declaration) throw new Sentence(`the Python package exports ${each}, which no source of it declares.`);
      return entry(`${name}.${each}`, declaration, describe);
    });
    const intro =
      /^"""([\s\S]*?)"""/
        .exec(source)?.[1]
        .replace(/^>>> .*$/gm, "")
        .trim() ?? "";
    return `## ${name}\n\n${intro}\n\n${entries.join("\n\n")}`;
  });
  if (undocumented.length > 0)
    throw new Sentence(`these names of the Python package have no description: ${undocumented.join(", ")}.`);
  return `# Python

The package \`strut-motion\`, imported as \`strut\`. [The guide](../python.md) has examples. Types are those of its stubs.

${sections.join("\n\n")}

## Types of arguments

${typeTable([...all.values()])}
`;
}

/** Returns the type aliases that signatures name. */
function typeTable(declared) {
  const aliases = declared.filter(({ kind, name }) => kind === "attribute" && /^[A-Z]/.test(name));
  const rows = aliases.map(({ name, signature: type, doc }) => `| \`${name}\` | \`${cell(type)}\` | ${cell(doc)} |`);
  return ["| Name | Type | |", "| --- | --- | --- |", ...rows].join("\n");
}

/** Returns the public submodules. */
function submodules() {
  const files = readdirSync(PACKAGE).filter((name) => /^[a-z]\w*\.py$/.test(name));
  return files.sort().map((file) => ({ name: `strut.${file.replace(/\.py$/, "")}`, file }));
}

/** Converts a docstring, which has backticks and paragraphs; lines of interpreter sessions are removed. */
const markdownOf = (doc) => doc.replace(/^>>> .*$/gm, "").trim();

const isPublic = ({ name }) => !name.startsWith("_");

function entry(path, declaration, describe) {
  const { name } = declaration;
  const lines = [`### ${path}`];
  if (declaration.kind === "class") {
    const maker = declaration.members.find((member) => ["__new__", "__init__"].includes(member.name));
    if (maker) lines.push(signature(name, maker.signature.replace(/ -> \w+$/, "")));
    lines.push(describe(name, declaration));
    const members = declaration.members.filter(isPublic);
    const attributes = members.filter(({ kind }) => kind !== "function");
    if (attributes.length > 0) lines.push(attributeTable(declaration, attributes, describe));
    for (const method of members.filter(({ kind }) => kind === "function"))
      lines.push(
        `#### ${name}.${method.name}`,
        signature(`${name}.${method.name}`, method.signature),
        describe(`${name}.${method.name}`, method),
      );
  } else lines.push(signature(name, declaration.signature), describe(name, declaration));
  return lines.filter((line) => line !== "").join("\n\n");
}

/** Returns a call with its arguments, one per line if there are many; `self` is omitted. */
function signature(name, text) {
  const plain = `${name}${text.replace(/\((?:self|cls)(?:, )?/, "(")}`;
  if (plain.length <= 100) return `\`\`\`python\n${plain}\n\`\`\``;
  const [, before, inner, after] = /^([^(]*\()(.*)(\).*)$/.exec(plain);
  return `\`\`\`python\n${before}\n${splitArguments(inner)
    .map((each) => `    ${each},`)
    .join("\n")}\n${after}\n\`\`\``;
}

/** Splits arguments at the commas outside of brackets. */
function splitArguments(text) {
  const parts = [""];
  let depth = 0;
  for (const character of text) {
    if ("([{".includes(character)) depth += 1;
    if (")]}".includes(character)) depth -= 1;
    if (character === "," && depth === 0) parts.push("");
    else parts[parts.length - 1] += character;
  }
  return parts.map((part) => part.trim()).filter(Boolean);
}

/** Returns the meaning of a keyword argument whose class has the options of a command. */
function optionDoc(name, classDoc, commands) {
  const command = commands.find((each) => each.name === /options of `strut ([\w-]+)`/.exec(classDoc)?.[1]);
  const option = name.replace(/_$/, "").replaceAll("_", "-");
  const found = command?.arguments.find(({ long, short }) => long === option || short === option);
  return found ? meaning(found) : "";
}

const cell = (text) => text.replace(/\s*\n\s*/g, " ").replace(/(?<!\\)\|/g, "\\|");

function attributeTable(owner, attributes, describe) {
  const rows = attributes.map((attribute) => {
    const doc = describe(`${owner.name}.${attribute.name}`, attribute, owner);
    return `| \`${attribute.name}\` | \`${cell(attribute.signature)}\` | ${cell(doc)} |`;
  });
  return ["| Name | Type | |", "| --- | --- | --- |", ...rows].join("\n");
}
