/** State of the Compare view. */
import { type Fields, listed, text } from "../../link/fields";

export interface CompareState {
  /** Names of the columns. */
  columns: readonly string[];
  /** The column that is drawn behind the others. */
  behind: string;
}

/** Maximum number of columns side by side. */
export const MAX_COLUMNS = 5;

export const COMPARE_FIELDS: Fields<CompareState> = {
  columns: listed(
    "columns",
    ["input", "nn", "lar", "mar"],
    (names) => names.join(","),
    (text) => text.split(",").slice(0, MAX_COLUMNS),
  ),
  behind: text("behind", "real", true),
};
