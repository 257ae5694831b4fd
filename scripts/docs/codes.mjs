// The code in a Markdown document.
import MarkdownIt from "markdown-it";

const md = new MarkdownIt({ html: true });

/**
 * Returns the code of a document in the order of its lines: blocks, each with its language (empty if none is named),
 * markup with the language `html`, and inline code, without a language.
 */
export function codesOf(markdown) {
  const found = [];
  // Table cells have the line of their row.
  let line = 1;
  for (const token of md.parse(markdown, {})) {
    if (token.map) line = token.map[0] + 1;
    if (token.type === "fence") found.push({ line, language: token.info.trim(), code: token.content });
    if (token.type === "html_block") found.push({ line, language: "html", code: token.content });
    for (const { type, content } of token.children ?? []) {
      if (type === "code_inline") found.push({ line, language: undefined, code: content });
      if (type === "html_inline") found.push({ line, language: "html", code: content });
    }
  }
  return found;
}
