/** What the Compare view says about its columns. Pure. */
import { strings } from "../../strings/strings";
import { capitalised, numberWord } from "../../ui/words";
import type { ColumnName } from "./columns";

const words = strings.compare;

/** What is compared. */
export interface Comparison {
  /** The columns from left to right. */
  columns: readonly ColumnName[];
  /** The column whose figure is drawn behind the others. */
  behind: ColumnName | undefined;
  /** Name of the input, and of the style that it is given. */
  input: string;
  manner: string;
  /** Whether it is known that a column has no motion. */
  isMissing(column: ColumnName): boolean;
}

/** The heading: how many ways are compared. */
export function titleOf({ columns }: Comparison): string {
  return columns.length === 1 ? words.one : words.several(numberWord(columns.length));
}

/** What goes in and comes out, and what the tinted figure is. */
export function summaryOf(comparison: Comparison): string {
  const { input, manner } = comparison;
  return `${words.transfer(capitalised(input), manner)} ${tintedFigure(comparison)}`.trimEnd();
}

/** The picture, for screen readers. */
export function pictureOf({ columns }: Comparison): string {
  return words.picture(columns.map((name) => words.columns[name]).join(", "));
}

function tintedFigure({ behind, isMissing }: Comparison): string {
  if (!behind) return "";
  if (isMissing(behind)) return words.noReal(words.columns[behind], words.captions.missing);
  return behind === "real" ? words.tintedReal : words.tinted(words.columns[behind]);
}
