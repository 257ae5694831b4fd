/** The texts of lessons as pieces, and as elements. */
import { html } from "../../../ui/dom";

/** A piece of a text: plain, emphasised, the name of a file, or words that highlight the marks of a term. */
interface Piece {
  kind: "text" | "stress" | "code" | "term";
  text: string;
  term?: string;
}

const MARKED = /\[(\w+): ([^\]]+)\]|\*([^*]+)\*|`([^`]+)`/g;

/** The pieces of a text. */
export function piecesOf(text: string): Piece[] {
  const pieces: Piece[] = [];
  let end = 0;
  for (const match of text.matchAll(MARKED)) {
    const [whole, term, words, stress, code] = match;
    if (match.index > end) pieces.push({ kind: "text", text: text.slice(end, match.index) });
    if (term !== undefined) pieces.push({ kind: "term", text: words!, term });
    else if (stress !== undefined) pieces.push({ kind: "stress", text: stress });
    else pieces.push({ kind: "code", text: code! });
    end = match.index + whole.length;
  }
  if (end < text.length) pieces.push({ kind: "text", text: text.slice(end) });
  return pieces;
}

/** A text as nodes. */
export function prose(text: string): (Node | string)[] {
  const nodes: (Node | string)[] = [];
  for (const { kind, text: words, term } of piecesOf(text)) {
    const last = nodes.at(-1);
    const [mark] = /^[.,:;?!)]/.exec(words) ?? [];
    if (kind === "term") nodes.push(html("button", { type: "button", class: "term", "data-term": term! }, words));
    else if (kind === "stress") nodes.push(html("em", {}, words));
    else if (kind === "code") nodes.push(html("code", {}, words));
    else if (mark && last instanceof HTMLButtonElement) {
      // No line break is allowed between a term and the mark that follows it.
      nodes[nodes.length - 1] = html("span", { class: "glued" }, last, mark);
      nodes.push(words.slice(1));
    } else nodes.push(words);
  }
  return nodes;
}

/** Texts as paragraphs. */
export function paragraphs(texts: readonly string[]): HTMLElement[] {
  return texts.map((text) => html("p", {}, ...prose(text)));
}
