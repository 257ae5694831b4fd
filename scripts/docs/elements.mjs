// Checks that the elements in documents have the attributes that are used.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { root } from "../steps.mjs";
import { codesOf } from "./codes.mjs";

const FIGURE = join(root, "web", "figures");

/** A tag with its attributes. */
const TAG = /<(strut-[\w-]+)((?:\s+[\w-]+(?:=(?:"[^"]*"|'[^']*'|\{[^}]*\}))?)*)\s*\/?>/g;
/** The parameters of a page for iframes. */
const FRAME = /\b(embed|figure)\.html\?([^#"'`\s]*)/g;
/** Attributes of every element. */
const GLOBAL = /^(id|class|style|slot|title|hidden|tabindex|lang|key|ref)$|^(aria|data)-|^on/;

/** Returns the attributes of `<strut-figure>`: those that its class observes, and those that its comment names. */
function figureAttributes() {
  const source = readFileSync(join(FIGURE, "figure_element.ts"), "utf8");
  const comment = /\* Attributes: ([\s\S]*?)\n \* Events:/.exec(source)[1];
  return new Set([...comment.matchAll(/(?:^|; |\* )`(\w+)`/g)].map(([, name]) => name));
}

/** Returns the values of an attribute that is a choice of words. */
const choicesOf = ({ type }) => [...type.matchAll(/"(\w+)"/g)].map(([, value]) => value);

/** Returns attributes as written: `name`, and `value` if it is a text. */
const written = (text) =>
  [...text.matchAll(/([\w-]+)(?:=(?:"([^"]*)"|'([^']*)'|\{[^}]*\}))?/g)].map(([, name, double, single]) => ({
    name,
    value: double ?? single,
  }));

/** Returns the parameters of an address as attributes. */
const parameters = (query) =>
  [...new URLSearchParams(query.replaceAll("&amp;", "&"))].map(([name, value]) => ({
    name,
    value: value || undefined,
  }));

/** @param given attributes as written */
function attributeFaults(element, given, tables) {
  if (element === "strut-figure") {
    const known = figureAttributes();
    return given
      .filter(({ name }) => !known.has(name) && !GLOBAL.test(name))
      .map(({ name }) => `<strut-figure> has no attribute '${name}'`);
  }
  return given.flatMap(({ name, value }) => {
    const attribute = tables.ATTRIBUTES[name];
    if (!attribute) return GLOBAL.test(name) ? [] : [`<strut-player> has no attribute '${name}'`];
    const choices = choicesOf(attribute);
    const isWrong = value !== undefined && choices.length > 0 && !choices.includes(value);
    return isWrong ? [`the attribute '${name}' takes no '${value}'`] : [];
  });
}

/** Returns the faults of the elements, and of the addresses of pages for iframes, in a piece of code. */
function faultsOf(code, tables) {
  const tags = [...code.matchAll(TAG)].flatMap(([, element, attributes]) =>
    ["strut-player", "strut-figure"].includes(element)
      ? attributeFaults(element, written(attributes), tables)
      : [`there is no element <${element}>`],
  );
  const frames = [...code.matchAll(FRAME)].flatMap(([, page, query]) =>
    attributeFaults(page === "embed" ? "strut-player" : "strut-figure", parameters(query), tables),
  );
  return [...tags, ...frames];
}

/**
 * Returns attributes in the code of a document that its elements do not have.
 * @param tables result of `readTables()`
 * @returns a message for each
 */
export function elementFaults(markdown, file, tables) {
  return codesOf(markdown).flatMap(({ line, code }) =>
    faultsOf(code, tables).map((fault) => `${file}:${line}: ${fault}`),
  );
}

/** Returns whether a block of HTML has an element whose attributes are checked. */
export const hasElement = (code) => /<strut-(player|figure)[\s>]/.test(code);
