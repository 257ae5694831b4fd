/** State of the Compare view. */
import { choice, type Fields, listed, text } from "../../link/fields";

export interface CompareState {
  /** Names of the columns. */
  columns: readonly string[];
  /** The column that is drawn behind the others. */
  behind: string;
  /** The search that is compared with the exact one. */
  search: SearchName;
}

/**
 * Searches for neighbours, as named by the command line: the exact one, and those with a number of candidates from
 * kd-trees.
 */
export const SEARCHES = ["exact", "kdtree:40", "kdtree:160", "kdtree:640"] as const;
export type SearchName = (typeof SEARCHES)[number];

/** Number of candidates that a search examines in every kd-tree; `undefined` for the exact one, which has no trees. */
export function candidatesOf(search: SearchName): number | undefined {
  const [, candidates] = search.split(":");
  return candidates === undefined ? undefined : Number(candidates);
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
  search: choice("search", "exact", SEARCHES, true),
};
