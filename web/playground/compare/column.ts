/** A column of the Compare view: what it shows, above the picture, and its live figures, below. */
import { button } from "../controls/buttons";
import { icon } from "../controls/icons";
import { formatNumber, html, setText } from "../dom";
import { COLUMN_NAMES, COLUMN_TITLES, type ColumnName } from "./columns";
import type { Figures } from "./figures";

/** The rows from the top; a bar is full at `full`. */
const ROWS: readonly {
  field: keyof Figures;
  name: string;
  /** Its name where the figure behind is what should have come out. */
  error?: string;
  title: string;
  unit: string;
  digits: number;
  full: number;
}[] = [
  {
    field: "difference",
    name: "Pose difference",
    error: "Pose error",
    title: "Mean distance of the joints from those of the figure behind, place and heading aside",
    unit: "cm",
    digits: 1,
    full: 12,
  },
  {
    field: "later",
    name: "Later",
    error: "Timing error",
    title: "By how much the figure is later than the one behind at the same content",
    unit: "ms",
    digits: 0,
    full: 1000,
  },
  {
    field: "skate",
    name: "Foot skate",
    title: "Speed over the ground of planted feet, mean of half a second before and after",
    unit: "cm/s",
    digits: 1,
    full: 12,
  },
  {
    field: "jerk",
    name: "Jerk ratio",
    title: "How abruptly the joints move, as a multiple of the input, mean of half a second before and after",
    unit: "×",
    digits: 2,
    full: 6,
  },
  {
    field: "cost",
    name: "Cost per frame",
    title: "Median time of a frame in the engine",
    unit: "ms",
    digits: 2,
    full: 1,
  },
];

/** Figures of which the smallest is best, and shown as such. */
const LESS_IS_BETTER: readonly (keyof Figures)[] = ["skate", "cost"];

export interface ColumnListeners {
  onChange: (to: ColumnName) => void;
  onRemove: () => void;
}

export class CompareColumn {
  readonly head: HTMLElement;
  readonly table: HTMLElement;
  readonly #caption = html("p", { class: "caption" });
  readonly #rows: { term: HTMLElement; bar: HTMLElement; value: HTMLElement }[];

  constructor(
    readonly name: ColumnName,
    removable: boolean,
    listeners: ColumnListeners,
  ) {
    const select = html("select", { "aria-label": "Column" });
    select.append(...COLUMN_NAMES.map((option) => html("option", { value: option }, COLUMN_TITLES[option])));
    select.value = name;
    select.addEventListener("change", () => listeners.onChange(select.value as ColumnName));
    const remove = button(`Remove ${COLUMN_TITLES[name]}`, listeners.onRemove, { icon: "close", class: "plain" });
    remove.hidden = !removable;
    this.head = html(
      "section",
      { class: "compare-column-head", "data-column": name },
      html("div", { class: "compare-column-title" }, html("div", { class: "select" }, select, icon("chevron")), remove),
      this.#caption,
    );
    this.table = html("dl", { class: "compare-table", "data-column": name, "aria-label": COLUMN_TITLES[name] });
    this.#rows = ROWS.map((row) => {
      const term = html("dt", {}, row.name);
      const bar = html("i", {});
      const value = html("dd", {});
      this.table.append(
        html(
          "div",
          { title: row.title },
          term,
          html("span", { class: "compare-bar", "aria-hidden": "true" }, bar),
          value,
        ),
      );
      return { term, bar, value };
    });
  }

  set caption(text: string) {
    setText(this.#caption, text);
  }

  /**
   * Shows the figures of the instant, `undefined` while the column is being styled; the best of a row stands out. Against
   * the real counterpart a difference is an error.
   */
  showFigures(figures: Figures | undefined, all: readonly (Figures | undefined)[], real: boolean): void {
    for (const [i, { field, name, error, unit, digits, full }] of ROWS.entries()) {
      const { term, bar, value } = this.#rows[i]!;
      setText(term, (real && error) || name);
      const number = figures?.[field];
      setText(value, number === undefined ? "–" : `${formatNumber(number, digits)} ${unit}`);
      bar.style.transform = `scaleX(${Math.min(1, Math.abs(number ?? 0) / full)})`;
      const least = Math.min(...all.map((other) => Math.abs(other?.[field] ?? Number.POSITIVE_INFINITY)));
      const ranked = LESS_IS_BETTER.includes(field) || (real && error !== undefined);
      value.classList.toggle("best", ranked && number !== undefined && Math.abs(number) === least);
    }
  }
}
