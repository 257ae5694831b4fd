// Exports of TypeScript modules: declarations with their comments, resolved through re-exports.
import { existsSync, readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { parseAst } from "vite";

const modules = new Map();

/** Parses a module once: its source, its declarations by name, its imports by local name, its exports. */
function readModule(file) {
  if (!modules.has(file)) modules.set(file, parseModule(file));
  return modules.get(file);
}

function parseModule(file) {
  const source = readFileSync(file, "utf8");
  const { body } = parseAst(source, { lang: "ts" }, file);
  const module = { file, source, declared: new Map(), imported: new Map(), exported: [], all: [] };
  for (const statement of body) readStatement(module, statement);
  return module;
}

const textOf = (node) => node.name ?? node.value;

function readStatement(module, statement) {
  const { type, source, specifiers = [], declaration } = statement;
  const from = source && resolve(module.file, source.value);
  if (type === "ImportDeclaration")
    for (const { local, imported } of specifiers)
      module.imported.set(local.name, { from, name: imported ? textOf(imported) : "default" });
  else if (type === "ExportAllDeclaration") module.all.push(from);
  else if (declaration) {
    for (const { name, node } of declarationsIn(declaration)) {
      // Overloads are joined.
      const before = module.declared.get(name);
      if (before) before.overloads.push(node);
      else module.declared.set(name, { node, start: statement.start, overloads: [] });
      module.exported.push({ name, local: name });
    }
  } else if (type === "ExportNamedDeclaration")
    for (const { local, exported } of specifiers)
      module.exported.push({ name: textOf(exported), local: textOf(local), from });
  else
    for (const { name, node } of declarationsIn(statement))
      module.declared.set(name, { node, start: statement.start, overloads: [] });
}

function declarationsIn(node) {
  if (node.id) return [{ name: node.id.name, node }];
  return (node.declarations ?? [])
    .filter(({ id }) => id.type === "Identifier")
    .map((each) => ({ name: each.id.name, node: each }));
}

/** Returns the file of a relative import; other packages are ignored. */
function resolve(file, specifier) {
  if (!specifier.startsWith(".")) return undefined;
  const path = join(dirname(file), specifier);
  return [`${path}.ts`, join(path, "index.ts")].find(existsSync);
}

/** Returns the declaration of a name in a module, or `undefined` if it is in another package. */
export function find(file, name) {
  const module = readModule(file);
  const declared = module.declared.get(name);
  if (declared) return { ...declared, name, file, source: module.source };
  const imported = module.imported.get(name);
  if (imported) return imported.from && find(imported.from, imported.name);
  const exported = module.exported.find((each) => each.name === name);
  if (exported?.from) return find(exported.from, exported.local);
  return module.all
    .filter(Boolean)
    .map((from) => find(from, name))
    .find(Boolean);
}

/** Returns the exports of a module: names with their declarations. */
export function exportsOf(file) {
  const module = readModule(file);
  const own = module.exported.map(({ name, local, from }) => [name, from ? find(from, local) : find(file, local)]);
  const others = module.all.filter(Boolean).flatMap((from) => [...exportsOf(from)]);
  return new Map([...others, ...own].filter(([, found]) => found));
}

/** Returns the comment that ends before a position of a source, without stars, or an empty string. */
export function commentBefore(source, start) {
  const found = /\/\*\*((?:(?!\*\/)[\s\S])*)\*\/\s*$/.exec(source.slice(0, start));
  return found ? found[1].replace(/^\s*\* ?/gm, "").trim() : "";
}
