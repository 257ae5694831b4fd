/** Sentences of the Compare view about its columns. Pure functions. */
import { strings } from "../../strings/strings";
import { capitalised, numberWord } from "../../ui/words";
import type { ColumnName } from "./columns";

const words = strings.compare;

/** Contents of the comparison. */
export interface Comparison {
  /** The columns from left to right. */
  columns: readonly ColumnName[];
  /** The column whose figure is drawn behind the others. */
  behind: ColumnName | undefined;
  /** Name of the input, and of its target style. */
  input: string;
  manner: string;
  /** Whether a column is known to have no motion. */
  isMissing(column: ColumnName): boolean;
}

/** The heading: how many methods are compared. */
export function titleOf({ columns }: Comparison): string {
  return columns.length === 1 ? words.one : words.several(numberWord(columns.length));
}

/** The input and the output, and the meaning of the tinted figure. */
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
