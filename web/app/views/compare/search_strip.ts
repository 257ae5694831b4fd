/** The search for neighbours: which one is compared with the exact one, its recall and its time. */

import type { SearchFigures } from "../../../client/protocol";
import { icon } from "../../../ui/controls/icons";
import { formatNumber, html, setText } from "../../../ui/dom";
import { candidatesOf, SEARCHES, type SearchName } from "../../state/compare";
import { strings } from "../../strings/strings";

const words = strings.compare.search;

/** Contents of the strip. */
interface ShownSearch {
  search: SearchName;
  /** Number of neighbours in every class. */
  neighbours: number;
  figures: SearchFigures | undefined;
  /** Progress of the measurement, 0–1. */
  fraction: number;
}

export class SearchStrip {
  readonly element: HTMLElement;
  readonly #select = html("select", { "aria-label": words.name });
  readonly #note = html("p", { class: "compare-search-note" });
  readonly #exact = new SearchRow(words.exact);
  readonly #trees = new SearchRow(words.trees);
  readonly #figures = html(
    "dl",
    { class: "compare-search-figures", "aria-label": words.figures },
    this.#exact.element,
    this.#trees.element,
  );

  constructor(onChange: (search: SearchName) => void) {
    this.#select.append(...SEARCHES.map((search) => html("option", { value: search }, nameOf(search))));
    this.#select.addEventListener("change", () => onChange(this.#select.value as SearchName));
    const select = html("div", { class: "select outlined" }, this.#select, icon("chevron"));
    this.element = html(
      "section",
      { class: "compare-search", "aria-label": words.name },
      html("label", {}, words.name, select),
      this.#figures,
      this.#note,
    );
  }

  show({ search, neighbours, figures, fraction }: ShownSearch): void {
    this.#select.value = search;
    this.#figures.hidden = figures === undefined;
    setText(this.#note, noteOf({ search, neighbours, figures, fraction }));
    if (!figures) return;
    const { recall, exactMs, treesMs } = figures;
    this.#exact.show(neighbours, { recall: 1, ms: exactMs }, { recall, ms: treesMs });
    this.#trees.show(neighbours, { recall, ms: treesMs }, { recall: 1, ms: exactMs });
  }
}

/** Recall and time of a search. */
interface Found {
  recall: number;
  ms: number;
}

/** The results of one search; the better of two is highlighted. */
class SearchRow {
  readonly element: HTMLElement;
  readonly #at = html("span", {});
  readonly #recall = html("span", { class: "compare-search-value" });
  readonly #ms = html("span", { class: "compare-search-value" });

  constructor(name: string) {
    const recall = html("dd", { title: words.recallWhy }, this.#at, " ", this.#recall);
    const ms = html("dd", { title: words.msWhy }, this.#ms);
    this.element = html("div", {}, html("dt", {}, name), recall, ms);
  }

  show(neighbours: number, { recall, ms }: Found, other: Found): void {
    setText(this.#at, words.recallAt(neighbours));
    setText(this.#recall, shareText(recall));
    setText(this.#ms, words.ms(formatNumber(ms, 2)));
    this.#recall.classList.toggle("best", recall > other.recall);
    this.#ms.classList.toggle("best", ms < other.ms);
  }
}

function nameOf(search: SearchName): string {
  const candidates = candidatesOf(search);
  return candidates === undefined ? words.exactAlone : words.candidates(candidates);
}

function noteOf({ search, neighbours, figures, fraction }: ShownSearch): string {
  if (search === "exact") return words.exactNote(neighbours);
  return figures ? words.columnsNote : words.measuring(Math.round(100 * fraction));
}

/** A share with three decimals; a share below 1 is never rounded to 1. */
function shareText(share: number): string {
  return formatNumber(share < 1 ? Math.min(share, 0.999) : 1, 3);
}
