// Doc comments of Rust sources as Markdown.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { root } from "../../steps.mjs";

/** Reads a source below rust/. */
export const rustSource = (path) => readFileSync(join(root, "rust", path), "utf8");

/** Replaces rustdoc links, which only work in rustdoc, by their text. */
function withoutLinks(text) {
  return text
    .replace(/^\[[^\]]+\]: .*$/gm, "")
    .replace(/\[(`[^`]+`)\]\([\w:]+\)/g, "$1")
    .replace(/\[([^\]`]+)\]\((?:crate|super|self|strut_core|strut_formats)[\w:]*\)/g, "$1")
    .replace(/\[(`[^`]+`|[a-z]{3,})\](?!\()/g, "$1")
    .trim();
}

/** Returns the text of a module: its `//!` comments. */
export function moduleDoc(source) {
  const lines = source.split("\n").filter((line) => line.startsWith("//!"));
  return withoutLinks(lines.map((line) => line.replace(/^\/\/! ?/, "")).join("\n"));
}

/** Returns the `///` comment that ends before an index of the source. */
export function docBefore(source, index) {
  const lines = source.slice(0, index).split("\n");
  lines.pop();
  const found = [];
  let brackets = 0;
  while (lines.length > 0) {
    const line = lines.pop().trim();
    // Attributes may have several lines.
    brackets += (line.match(/\]/g) ?? []).length - (line.match(/\[/g) ?? []).length;
    if (line.startsWith("///")) found.unshift(line.replace(/^\/\/\/ ?/, ""));
    else if (!line.startsWith("#[") && brackets <= 0 && !line.endsWith("]")) break;
  }
  return withoutLinks(found.join("\n"));
}

/** Returns the public fields of a struct, each with its type and doc comment. */
export function fieldsOf(source, struct) {
  const begin = source.indexOf(`pub struct ${struct} {`);
  const body = source.slice(begin, source.indexOf("\n}", begin));
  return [...body.matchAll(/^ {4}pub (\w+): (.+),$/gm)].map((match) => ({
    name: match[1],
    type: match[2],
    doc: docBefore(body, match.index + 4),
  }));
}

/** Returns the public constants of a source, each with its value as written, and its doc comment. */
export function constantsOf(source) {
  return [...source.matchAll(/^pub const (\w+): [^=]+=\s*([^;]+);/gm)].map((match) => ({
    name: match[1],
    value: match[2].trim(),
    doc: docBefore(source, match.index),
  }));
}
