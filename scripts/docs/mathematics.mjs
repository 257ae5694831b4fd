// Equations of the documentation: KaTeX's HTML and MathML, written when the site is built.
import katex from "katex";

/** Returns a formula as markup. @param display whether it is a separate block */
export function renderFormula(tex, display) {
  return katex.renderToString(tex.trim(), { displayMode: display, output: "htmlAndMathml", strict: "error" });
}

/** Adds GitHub's syntax for mathematics to markdown-it: blocks of `$$` and, in a line, $`…`$. */
export function mathematics(md) {
  md.block.ruler.before("fence", "formula", formulaBlock, { alt: ["paragraph", "reference", "blockquote", "list"] });
  md.inline.ruler.before("backticks", "formula", formulaInline);
  md.renderer.rules.formula = (tokens, index) => {
    const { content, block } = tokens[index];
    const markup = renderFormula(content, block);
    return block ? `<div class="formula wide">${markup}</div>\n` : markup;
  };
}

function formulaBlock(state, start, end, silent) {
  const line = (n) => state.src.slice(state.bMarks[n] + state.tShift[n], state.eMarks[n]).trim();
  if (line(start) !== "$$") return false;
  let last = start + 1;
  while (last < end && line(last) !== "$$") last += 1;
  if (last === end) return false;
  if (silent) return true;
  const token = state.push("formula", "", 0);
  token.block = true;
  token.content = state.getLines(start + 1, last, 0, false);
  token.map = [start, last + 1];
  state.line = last + 1;
  return true;
}

function formulaInline(state, silent) {
  const found = /^\$`([^`]+)`\$/.exec(state.src.slice(state.pos));
  if (!found) return false;
  if (!silent) state.push("formula", "", 0).content = found[1];
  state.pos += found[0].length;
  return true;
}
