/** A column of the Compare view: its title above the picture, and its live measurements below. */

import { button } from "../../../ui/controls/buttons";
import { icon } from "../../../ui/controls/icons";
import { formatNumber, html, setText } from "../../../ui/dom";
import { strings } from "../../strings/strings";
import { COLUMN_NAMES, type ColumnName } from "./columns";
import type { Figures } from "./figures";

/** The rows from the top; a bar is full at `full`, in the row's unit. */
const ROWS: readonly { field: keyof Figures; unit: string; digits: number; full: number }[] = [
  { field: "difference", unit: "cm", digits: 1, full: 12 },
  { field: "later", unit: "ms", digits: 0, full: 1000 },
  { field: "skate", unit: "cm/s", digits: 1, full: 12 },
  { field: "jerk", unit: "×", digits: 2, full: 6 },
  { field: "cost", unit: "ms", digits: 2, full: 1 },
];

/** Measurements whose smallest value is the best and is highlighted. */
const LESS_IS_BETTER: readonly (keyof Figures)[] = ["skate", "cost"];

interface ColumnListeners {
  onChange: (to: ColumnName) => void;
  onRemove: () => void;
}

export class CompareColumn {
  readonly head: HTMLElement;
  readonly table: HTMLElement;
  readonly #caption = html("p", { class: "caption" });
  readonly #rows: { term: HTMLElement; bar: HTMLElement; value: HTMLElement }[];

  /** @param place index of the column, from 1 at the left */
  constructor(
    readonly name: ColumnName,
    place: number,
    removable: boolean,
    listeners: ColumnListeners,
  ) {
    const select = html("select", { "aria-label": strings.compare.column(place) });
    select.append(...COLUMN_NAMES.map((option) => html("option", { value: option }, strings.compare.columns[option])));
    select.value = name;
    select.addEventListener("change", () => listeners.onChange(select.value as ColumnName));
    const remove = button(strings.compare.remove(strings.compare.columns[name]), listeners.onRemove, {
      icon: "close",
      class: "plain",
    });
    remove.hidden = !removable;
    this.head = html(
      "section",
      { class: "compare-column-head", "data-column": name },
      html("div", { class: "compare-column-title" }, html("div", { class: "select" }, select, icon("chevron")), remove),
      this.#caption,
    );
    this.table = html("dl", {
      class: "compare-table",
      "data-column": name,
      "aria-label": strings.compare.columns[name],
    });
    this.#rows = ROWS.map((row) => {
      const term = html("dt", {}, strings.compare.figures[row.field].name);
      const bar = html("i", {});
      const value = html("dd", {});
      this.table.append(
        html(
          "div",
          { title: strings.compare.figures[row.field].why },
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
   * Shows the measurements at the current instant, `undefined` while the column is being styled. The best of a row is
   * highlighted. Compared with the real counterpart, a difference is an error.
   */
  showFigures(figures: Figures | undefined, all: readonly (Figures | undefined)[], real: boolean): void {
    for (const [i, { field, unit, digits, full }] of ROWS.entries()) {
      const { name, error } = strings.compare.figures[field];
      const { term, bar, value } = this.#rows[i]!;
      setText(term, real ? error : name);
      const number = figures?.[field];
      setText(value, number === undefined ? "–" : `${formatNumber(number, digits)} ${unit}`);
      bar.style.transform = `scaleX(${Math.min(1, Math.abs(number ?? 0) / full)})`;
      const smallest = Math.min(...all.map((other) => Math.abs(other?.[field] ?? Number.POSITIVE_INFINITY)));
      const ranked = LESS_IS_BETTER.includes(field) || (real && error !== name);
      value.classList.toggle("best", ranked && number !== undefined && Math.abs(number) === smallest);
    }
  }
}
