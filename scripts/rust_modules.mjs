// The modules of a Rust crate, their dependencies, and the cycles among them, from the source text: comments and
// literals are blanked, `use` trees and paths are resolved through re-exports to the module that defines the item.
import { existsSync, readFileSync } from "node:fs";
import { basename, dirname, join } from "node:path";
import { circles } from "./circles.mjs";

/**
 * Returns a message for each cycle of a crate.
 *
 * Seen from a sibling, a module and its descendants are one node; a module's own file is a node next to its children.
 * Tests may use anything. A re-export of a descendant does not count as a dependency.
 */
export function moduleCircles(rootFile) {
  const root = readModule(rootFile, "crate", undefined, rootFile);
  const modules = [...descendants(root)];
  const uses = modules.flatMap((module) => usesOf(root, module));
  return modules.flatMap((parent) => circlesBelow(parent, uses));
}

function* descendants(module) {
  yield module;
  for (const child of module.children.values()) yield* descendants(child);
}

const isWithin = (module, ancestor) => {
  for (let m = module; m; m = m.parent) if (m === ancestor) return true;
  return false;
};

// Cycles.

/** Returns the cycles among a module's own file and its children, each with all its descendants. */
function circlesBelow(parent, uses) {
  const part = (module) => {
    if (module === parent) return parent;
    let m = module;
    while (m && m.parent !== parent) m = m.parent;
    return m;
  };
  const next = new Map();
  for (const use of uses) {
    const [from, to] = [part(use.from), part(use.to)];
    if (!from || !to || from === to) continue;
    const others = next.get(from) ?? new Map();
    if (!others.has(to)) others.set(to, use);
    next.set(from, others);
  }
  return circles(next).map((circle) => {
    const steps = circle.map((use) => `${use.from.path} uses ${use.path} of ${use.to.path}`);
    return `circle in ${parent.path}: ${steps.join("; ")}`;
  });
}

// Dependencies of a module.

function usesOf(root, module) {
  const found = [];
  const add = (path) => {
    const target = resolve(root, module, path);
    if (target?.item && target.module !== module)
      found.push({ from: module, to: target.module, path: path.join("::") });
  };
  for (const { path, exported } of module.imports) {
    const target = resolve(root, module, path);
    const ownReexport = exported && target && target.module !== module && isWithin(target.module, module);
    if (!ownReexport) add(path);
  }
  for (const [path] of module.code.matchAll(/\b[A-Za-z_]\w*(?:\s*::\s*[A-Za-z_]\w*)+/g)) add(path.split(/\s*::\s*/));
  return found;
}

/** Returns the module that defines the item of a path in a module, or nothing outside the crate. */
function resolve(root, module, path, depth = 0) {
  if (depth > 20) return undefined;
  const [first, ...rest] = path;
  if (first === "crate") return walk(root, root, rest, depth);
  if (first === "self") return walk(root, module, rest, depth);
  if (first === "super") return module.parent && resolve(root, module.parent, ["self", ...rest], depth);
  if (module.children.has(first)) return walk(root, module, path, depth);
  const alias = importOf(module, first);
  if (!alias) return undefined;
  const target = resolve(root, module, alias.path, depth + 1);
  return target && !target.item ? walk(root, target.module, rest, depth) : target;
}

const importOf = (module, name) => module.imports.find((i) => i.name === name);

/** Follows a path from a module down, and through re-exports. */
function walk(root, module, path, depth) {
  const [first, ...rest] = path;
  if (first === undefined) return { module, item: false };
  if (first === "super") return module.parent && walk(root, module.parent, rest, depth);
  if (first === "*") return { module, item: true };
  const child = module.children.get(first);
  if (child && !(rest.length === 0 && module.defined.has(first))) return walk(root, child, rest, depth);
  const alias = importOf(module, first);
  if (alias) {
    const target = resolve(root, module, alias.path, depth + 1);
    return target && !target.item ? walk(root, target.module, rest, depth) : target;
  }
  if (!module.defined.has(first) && depth < 20) {
    for (const { path: glob } of module.imports.filter((i) => i.name === "*")) {
      const target = resolve(root, module, glob, depth + 1);
      if (target && target.module !== module && exports(target.module, first))
        return walk(root, target.module, path, depth + 1);
    }
  }
  return { module, item: true };
}

const exports = (module, name) => module.defined.has(name) || module.imports.some((i) => i.exported && i.name === name);

// Reading.

/** Reads a module with its children. `home` is the file whose folder contains the files of its children. */
function readModule(file, path, parent, home) {
  const text = withoutInlineModules(withoutTests(blanked(readFileSync(file, "utf8"))));
  const imports = [];
  let code = text.replace(/(\bpub(?:\s*\([^)]*\))?\s+)?\buse\s+([^;]+);/g, (_, exported, tree) => {
    imports.push(...importsOf(tree, []).map((i) => ({ ...i, exported: exported !== undefined })));
    return " ";
  });
  const module = { path, file, parent, imports, children: new Map(), defined: new Set(), code: "" };
  const folder = ["lib.rs", "main.rs", "mod.rs"].includes(basename(home)) ? dirname(home) : home.replace(/\.rs$/, "");
  code = code.replace(/\bmod\s+(\w+)\s*;/g, (_, name) => {
    const place = [join(folder, `${name}.rs`), join(folder, name, "mod.rs")].find(existsSync);
    if (!place) throw new Error(`${file} names a module ${name} that has no file`);
    module.children.set(name, readModule(place, path === "crate" ? name : `${path}::${name}`, module, place));
    return " ";
  });
  for (const [, name] of code.matchAll(/\b(?:struct|enum|union|trait|type|fn|const|static)\s+(?:mut\s+)?(\w+)/g))
    module.defined.add(name);
  module.code = code;
  return module;
}

/** Returns the imports of a `use` tree: each a path and its local name, `*` for all names. */
function importsOf(tree, before) {
  const text = tree.trim().replace(/^::/, "");
  const brace = text.indexOf("{");
  if (brace < 0) {
    const [path, alias] = text.split(/\s+as\s+/);
    const segments = [...before, ...path.split("::").map((s) => s.trim())];
    if (segments.at(-1) === "self") segments.pop();
    return [{ path: segments, name: alias?.trim() ?? segments.at(-1) }];
  }
  const prefix = text
    .slice(0, brace)
    .split("::")
    .map((s) => s.trim());
  const inner = text.slice(brace + 1, text.lastIndexOf("}"));
  return splitAtCommas(inner).flatMap((part) => importsOf(part, [...before, ...prefix.filter((s) => s !== "")]));
}

function splitAtCommas(text) {
  const parts = [""];
  let depth = 0;
  for (const c of text) {
    if (c === "{") depth += 1;
    if (c === "}") depth -= 1;
    if (c === "," && depth === 0) parts.push("");
    else parts[parts.length - 1] += c;
  }
  return parts.filter((part) => part.trim() !== "");
}

/** Returns the text without comments and without the contents of literals. */
function blanked(source) {
  const token =
    /\/\/[^\n]*|\/\*[\s\S]*?\*\/|\bb?r(#*)"[\s\S]*?"\1|\bb?"(?:\\[\s\S]|[^"\\])*"|"(?:\\[\s\S]|[^"\\])*"|b?'(?:\\[^\n]{1,8}?|[^'\\\n])'/g;
  return source.replace(token, (found) => (found.startsWith("/") ? " " : '""'));
}

/** Returns the text without test-only items. */
function withoutTests(text) {
  const attribute = /#\[cfg\(test\)\]/g;
  let rest = text;
  for (let match = attribute.exec(rest); match; match = attribute.exec(rest)) {
    rest = rest.slice(0, match.index) + rest.slice(endOfItem(rest, match.index + match[0].length));
    attribute.lastIndex = match.index;
  }
  return rest;
}

/** Returns the text with inline modules merged into the file's own module: their `super` is the file. */
function withoutInlineModules(text) {
  const start = /\bmod\s+\w+\s*\{/.exec(text);
  if (!start) return text;
  const end = endOfItem(text, start.index);
  const body = text.slice(start.index + start[0].length, end - 1).replaceAll("super::", "self::");
  return withoutInlineModules(text.slice(0, start.index) + body + text.slice(end));
}

/** Returns the end of an item: its semicolon, or the brace that closes its body. */
function endOfItem(text, from) {
  let depth = 0;
  for (let i = from; i < text.length; i++) {
    if ("{([".includes(text[i])) depth += 1;
    if ("})]".includes(text[i])) depth -= 1;
    if (depth === 0 && (text[i] === ";" || text[i] === "}")) return i + 1;
  }
  return text.length;
}
