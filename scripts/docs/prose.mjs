// List of long sentences of the documentation, for editors.
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import MarkdownIt from "markdown-it";
import { root } from "../steps.mjs";

const MOST_WORDS = 30;

const md = new MarkdownIt({ html: true });

/** Returns the files whose prose is checked. */
function files() {
  const docs = readdirSync(join(root, "docs"), { recursive: true }).filter((name) => name.endsWith(".md"));
  return [
    "README.md",
    "CONTRIBUTING.md",
    "examples/README.md",
    "web/package/README.md",
    ...docs.sort().map((name) => `docs/${name}`),
  ];
}

/**
 * Returns the paragraphs of a text: their lines and, without code and formulas, their words. Table cells are skipped.
 */
export function paragraphsOf(markdown) {
  const found = [];
  let isTable = false;
  for (const token of md.parse(markdown, {})) {
    if (token.type === "table_open" || token.type === "table_close") isTable = token.type === "table_open";
    if (token.type !== "inline" || isTable) continue;
    const text = token.children
      .filter(({ type }) => ["text", "code_inline", "softbreak"].includes(type))
      .map(({ type, content }) => (type === "softbreak" ? " " : type === "code_inline" ? "code" : content))
      .join("");
    found.push({ line: token.map[0] + 1, text });
  }
  return found;
}

/** Returns the sentences of a paragraph, which end with a full stop, a question mark or a colon before a space. */
export const sentencesOf = (text) =>
  text.split(/(?<=[.?!:])\s+(?=["“(`A-Z]|code)/).filter((sentence) => sentence.trim() !== "");

/** Returns whether a sentence is prose, and not a list of names in code. */
const isProse = (sentence) => /\p{L}/u.test(sentence.replace(/\bcode\b/g, ""));

/** Returns the number of words, which contain a letter or a digit. */
export const wordCount = (sentence) => sentence.split(/\s+/).filter((word) => /[\p{L}\p{N}]/u.test(word)).length;

/** Returns the sentences that are too long, longest first: `words file:line sentence`. */
export function longSentences() {
  const found = files().flatMap((file) =>
    paragraphsOf(readFileSync(join(root, file), "utf8")).flatMap(({ line, text }) =>
      sentencesOf(text).map((sentence) => ({ file, line, sentence, words: wordCount(sentence) })),
    ),
  );
  return found
    .filter(({ words, sentence }) => words > MOST_WORDS && isProse(sentence))
    .sort((a, b) => b.words - a.words)
    .map(({ words, file, line, sentence }) => `${words} ${file}:${line} ${sentence}`);
}
