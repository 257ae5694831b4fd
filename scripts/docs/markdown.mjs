// Conversion of Markdown to the body of a page, its headings, and its text for the search.
import hljs from "highlight.js/lib/core";
import bash from "highlight.js/lib/languages/bash";
import css from "highlight.js/lib/languages/css";
import javascript from "highlight.js/lib/languages/javascript";
import json from "highlight.js/lib/languages/json";
import nginx from "highlight.js/lib/languages/nginx";
import python from "highlight.js/lib/languages/python";
import rust from "highlight.js/lib/languages/rust";
import typescript from "highlight.js/lib/languages/typescript";
import xml from "highlight.js/lib/languages/xml";
import MarkdownIt from "markdown-it";
import { mathematics } from "./mathematics.mjs";

const LANGUAGES = { bash, css, javascript, json, nginx, python, rust, typescript, xml };
/** Languages of code blocks that have other names in highlight.js. */
const ALIASES = { sh: "bash", js: "javascript", jsx: "javascript", mjs: "javascript", ts: "typescript", html: "xml" };

for (const [name, language] of Object.entries(LANGUAGES)) hljs.registerLanguage(name, language);

/** Returns highlighted code as markup, or plain text if the language is unknown. */
export function highlight(code, language) {
  const name = ALIASES[language] ?? language;
  return name in LANGUAGES ? hljs.highlight(code, { language: name }).value : escapeHtml(code);
}

/** Escapes text for use between tags and in attributes. */
export function escapeHtml(text) {
  return text.replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll(">", "&gt;").replaceAll('"', "&quot;");
}

/** Returns the anchor of a heading as on GitHub. */
export function slugOf(text) {
  return text
    .trim()
    .toLowerCase()
    .replace(/[^\p{L}\p{N}\s_-]/gu, "")
    .replace(/\s/g, "-");
}

const md = new MarkdownIt({ html: true, typographer: false });
md.use(mathematics);
md.renderer.rules.fence = (tokens, index) => {
  const { info, content } = tokens[index];
  const language = info.trim().split(/\s/)[0];
  return codeBlock(content, language);
};
md.renderer.rules.code_block = (tokens, index) => codeBlock(tokens[index].content, "text");
md.renderer.rules.table_open = () => '<div class="table wide"><table>\n';
md.renderer.rules.table_close = () => "</table></div>\n";

/** Returns a block of code, which may be wider than the page. */
export function codeBlock(code, language) {
  return `<pre class="wide"><code>${highlight(code.replace(/\n$/, ""), language)}</code></pre>\n`;
}

/** Returns the visible text of an inline token. */
function textOf(inline) {
  return (inline.children ?? [])
    .filter(({ type }) => ["text", "code_inline", "softbreak"].includes(type))
    .map(({ type, content }) => (type === "softbreak" ? " " : content))
    .join("");
}

/**
 * Renders a page.
 * @param source Markdown
 * @param resolve converts the address of a link or a picture in the source to that in the site
 * @returns `html`; `headings`, each with `level`, `id` and `text`; `sections`, the text below each heading for the
 * search; `links`, the addresses as written
 */
export function renderMarkdown(source, resolve = (href) => href) {
  const tokens = md.parse(source, {});
  const page = { headings: [], sections: [], links: [] };
  const used = new Map();
  tokens.forEach((token, index) => {
    if (token.type === "heading_open") addHeading(page, used, token, tokens[index + 1]);
    else if (token.type === "inline") addInline(page, token, tokens[index - 1].type === "heading_open", resolve);
    else if (token.type === "fence") page.sections.at(-1)?.text.push(token.content);
    else if (token.type === "html_block") token.content = withAddresses(page, token.content, resolve);
    else if (token.type === "th_open" && textOf(tokens[index + 1]) === "") {
      // An empty header cell is no header.
      token.tag = "td";
      tokens.slice(index).find(({ type }) => type === "th_close").tag = "td";
      token.type = "td_open";
    }
  });
  return { ...page, html: md.renderer.render(tokens, md.options, {}) };
}

function addHeading(page, used, token, inline) {
  const text = textOf(inline);
  const slug = slugOf(text);
  const times = used.get(slug) ?? 0;
  used.set(slug, times + 1);
  const id = times === 0 ? slug : `${slug}-${times}`;
  const level = Number(token.tag.slice(1));
  token.attrSet("id", id);
  page.headings.push({ level, id, text });
  page.sections.push({ id: level === 1 ? "" : id, title: text, text: [] });
  if (level > 1) {
    const anchor = {
      type: "html_inline",
      content: `<a class="anchor" href="#${id}" aria-label="Link to this section">#</a>`,
    };
    inline.children.push(Object.assign(new inline.children[0].constructor("html_inline", "", 0), anchor));
  }
}

function addInline(page, inline, isHeading, resolve) {
  if (!isHeading) page.sections.at(-1)?.text.push(textOf(inline));
  for (const child of inline.children ?? []) {
    const name = { link_open: "href", image: "src" }[child.type];
    if (name) {
      page.links.push(child.attrGet(name));
      child.attrSet(name, resolve(child.attrGet(name)));
    } else if (child.type === "html_inline") child.content = withAddresses(page, child.content, resolve);
  }
}

/** Returns inline markup with the addresses of the site; anchors of the page itself are kept. */
function withAddresses(page, markup, resolve) {
  return markup.replace(/(<(?:a|img)\b[^>]*\s(?:href|src)=")([^"#][^"]*)"/g, (_, before, address) => {
    page.links.push(address);
    return `${before}${escapeHtml(resolve(address))}"`;
  });
}
