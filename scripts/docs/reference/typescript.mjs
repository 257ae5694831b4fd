// What TypeScript modules export: declarations with their comments, followed through re-exports.
import { existsSync, readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { parseAst } from "vite";

const modules = new Map();

/** A module, parsed once: its source, its declarations by name, its imports by local name, its exports. */
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
      // Overloads stand together.
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

/** The file of a relative import; other packages are of no concern. */
function resolve(file, specifier) {
  if (!specifier.startsWith(".")) return undefined;
  const path = join(dirname(file), specifier);
  return [`${path}.ts`, join(path, "index.ts")].find(existsSync);
}

/** Where a name that a module knows is declared; `undefined` where that is in another package. */
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

/** The exports of a module: names with the declarations that they lead to. */
export function exportsOf(file) {
  const module = readModule(file);
  const own = module.exported.map(({ name, local, from }) => [name, from ? find(from, local) : find(file, local)]);
  const others = module.all.filter(Boolean).flatMap((from) => [...exportsOf(from)]);
  return new Map([...others, ...own].filter(([, found]) => found));
}

/** The comment that ends before a place of a source, without stars; empty where there is none. */
export function commentBefore(source, start) {
  const found = /\/\*\*((?:(?!\*\/)[\s\S])*)\*\/\s*$/.exec(source.slice(0, start));
  return found ? found[1].replace(/^\s*\* ?/gm, "").trim() : "";
}
