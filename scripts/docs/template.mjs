// The HTML around a page of the documentation.
import { escapeHtml } from "./markdown.mjs";

const MARK = `<svg width="18" height="18" viewBox="0 0 18 18" fill="none" aria-hidden="true"><path d="M9 1.8L16.4 15.6H1.6z" stroke="currentColor" stroke-width="1.6" stroke-linejoin="round"/><circle class="mark" cx="8" cy="11.2" r="2.9"/></svg>`;
const ICON =
  "data:image/svg+xml,%3Csvg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 18 18' fill='none'%3E%3Cpath d='M9 1.8L16.4 15.6H1.6z' stroke='%238b8f96' stroke-width='1.6' stroke-linejoin='round'/%3E%3Ccircle cx='8' cy='11.2' r='2.9' fill='%23ff5a36'/%3E%3C/svg%3E";
const MENU = `<svg width="16" height="16" viewBox="0 0 16 16" fill="none" stroke="currentColor" stroke-width="1.4" stroke-linecap="round" aria-hidden="true"><path d="M2.5 4.5h11M2.5 8h11M2.5 11.5h11"/></svg>`;
const MOON = `<svg width="16" height="16" viewBox="0 0 16 16" fill="none" stroke="currentColor" stroke-width="1.4" stroke-linejoin="round" aria-hidden="true"><path d="M13 9.6A5.4 5.4 0 0 1 6.4 3a5.4 5.4 0 1 0 6.6 6.6z"/></svg>`;

/** Applies the chosen theme before the first paint. */
const THEME = `try{const t=localStorage.getItem("strut-manual-theme");if(t)document.documentElement.dataset.theme=t}catch{}`;

/** Scripts of the components that a page shows, by element: files of the site that contains the documentation. */
const COMPONENTS = {
  "strut-player": (root) => `<script src="${root}../package/strut-player.js" defer></script>`,
  "strut-figure": (root) => `<script src="${root}../strut-figure.js" type="module"></script>`,
};

const link = (root, out, title, current) =>
  `<a href="${root}${out}"${out === current ? ' aria-current="page"' : ""}>${escapeHtml(title)}</a>`;

/** Returns the navigation with all pages. */
function navigation(sections, root, out) {
  const groups = sections.map(
    ({ title, pages }) =>
      `<section><h2>${escapeHtml(title)}</h2><ul>${pages
        .map((page) => `<li>${link(root, page.out, page.label, out)}</li>`)
        .join("")}</ul></section>`,
  );
  return `<nav id="map" aria-label="Pages" popover><a class="playground" href="${root}../index.html">Playground</a>${groups.join("")}</nav>`;
}

/** Returns the list of a page's headings, if there are several. */
function contents(headings) {
  const shown = headings.filter(({ level }) => level === 2 || level === 3);
  if (shown.length < 3) return "";
  const items = shown.map(
    ({ level, id, text }) => `<li class="level-${level}"><a href="#${id}">${escapeHtml(text)}</a></li>`,
  );
  return `<nav class="contents" aria-label="On this page"><h2>On this page</h2><ul>${items.join("")}</ul></nav>`;
}

/** Returns links to the previous and the next page. */
function neighbours(sections, root, out) {
  const pages = sections.flatMap((section) => section.pages);
  const at = pages.findIndex((page) => page.out === out);
  if (at < 0) return "";
  const side = (page, rel, word) =>
    page
      ? `<a rel="${rel}" href="${root}${page.out}"><span>${word}</span>${escapeHtml(page.label)}</a>`
      : "<span></span>";
  return `<footer>${side(pages[at - 1], "prev", "Previous")}${side(pages[at + 1], "next", "Next")}</footer>`;
}

/** Greatest length of a page's description, characters. */
const DESCRIPTION = 200;

/**
 * Returns the description for search engines: the beginning of the page's text or, if that is no sentence, its title.
 */
function descriptionOf({ title, sections }) {
  const [text = ""] = sections[0]?.text ?? [];
  if (!text.includes(".")) return `${title}: documentation of Strut, real-time motion style transfer.`;
  return text.length <= DESCRIPTION ? text : `${text.slice(0, text.lastIndexOf(" ", DESCRIPTION))} …`;
}

/**
 * Returns a whole page.
 * @param sections the structure; `page` has `out`, its path in the site, `title`, `headings`, `html` and `sections`,
 * its text
 */
export function pageHtml(sections, page) {
  const { out, title, html, headings } = page;
  const root = "../".repeat(out.split("/").length - 1) || "./";
  const scripts = Object.keys(COMPONENTS).filter((element) => html.includes(`<${element}`));
  const formulas = html.includes('class="katex') ? `<link rel="stylesheet" href="${root}assets/formulas.css">` : "";
  return `<!doctype html>
<html lang="en" data-root="${root}">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta name="description" content="${escapeHtml(descriptionOf(page))}">
<title>${escapeHtml(title)} · Strut</title>
<link rel="icon" href="${ICON}">
<link rel="stylesheet" href="${root}assets/manual.css">${formulas}
<script>${THEME}</script>
<script src="${root}assets/manual.js" defer></script>
${scripts.map((element) => COMPONENTS[element](root)).join("\n")}
</head>
<body>
<a class="skip" href="#content">Skip to the text</a>
<header class="bar">
<button class="icon menu" type="button" popovertarget="map" aria-label="Pages">${MENU}</button>
<a class="wordmark" href="${root}index.html">${MARK}<span>Strut</span> <span class="what">Documentation</span></a>
<search><input type="search" id="search" aria-label="Search the documentation" placeholder="Search" autocomplete="off" spellcheck="false"><kbd aria-hidden="true">/</kbd><div class="results" hidden></div></search>
<a class="playground" href="${root}../index.html">Playground</a>
<button class="icon theme" type="button" aria-label="Dark theme" aria-pressed="false">${MOON}</button>
</header>
<div class="page">
${navigation(sections, root, out)}
<main id="content">
${html}
${neighbours(sections, root, out)}
</main>
${contents(headings)}
</div>
</body>
</html>
`;
}
