/** The search of the documentation, over the sections listed by `scripts/docs/search_index.mjs`. */
import MiniSearch from "minisearch";

/** Contents of the index: pages as URL and title, sections as index of the page, anchor, title and words. */
interface ManualIndex {
  pages: [place: string, title: string][];
  sections: [page: number, id: string, title: string, words: string][];
}

declare const strutManual: ManualIndex;

const MAX_RESULTS = 12;

const field = document.querySelector<HTMLInputElement>("#search")!;
const list = document.querySelector<HTMLElement>(".results")!;
const { root } = document.documentElement.dataset;

const index = new MiniSearch<{ id: number; title: string; page: string; words: string }>({
  fields: ["title", "page", "words"],
  searchOptions: {
    boost: { title: 4, page: 2 },
    prefix: true,
    fuzzy: (term) => (term.length > 4 ? 0.2 : false),
    combineWith: "AND",
  },
});
index.addAll(
  strutManual.sections.map(([page, , title, words], id) => ({
    id,
    title,
    page: strutManual.pages[page]![1],
    words,
  })),
);

function showResults(): void {
  const query = field.value.trim();
  list.hidden = query === "";
  if (list.hidden) return;
  const found = index.search(query).slice(0, MAX_RESULTS);
  list.replaceChildren(...(found.length === 0 ? [nothing(query)] : found.map(({ id }) => resultOf(id))));
}

function nothing(query: string): HTMLElement {
  const text = document.createElement("p");
  text.setAttribute("role", "status");
  text.textContent = `Nothing found for “${query}”.`;
  return text;
}

function resultOf(section: number): HTMLElement {
  const [page, id, title] = strutManual.sections[section]!;
  const [place, pageTitle] = strutManual.pages[page]!;
  const link = document.createElement("a");
  link.href = `${root}${place}${id ? `#${id}` : ""}`;
  link.textContent = title;
  const where = document.createElement("span");
  where.textContent = pageTitle;
  link.append(where);
  return link;
}

/** Arrow keys move from the field through the results and back, Escape closes them. */
function moveFocus(event: KeyboardEvent): void {
  const stops = [field, ...list.querySelectorAll("a")];
  const at = stops.indexOf(document.activeElement as HTMLInputElement);
  const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
  if (event.key === "Escape") {
    list.hidden = true;
    field.focus();
  } else if (event.key === "Enter" && at === 0) {
    list.querySelector("a")?.click();
  } else if (step && !list.hidden) {
    event.preventDefault();
    stops[at + step]?.focus();
  }
}

field.addEventListener("input", showResults);
field.parentElement!.addEventListener("keydown", moveFocus);
field.parentElement!.addEventListener("click", (event) => {
  // A link to the same page also closes them.
  if (event.target instanceof Element && event.target.closest(".results a")) list.hidden = true;
});
document.addEventListener("click", (event) => {
  if (event.target instanceof Node && !field.parentElement!.contains(event.target)) list.hidden = true;
});
showResults();
