/** The notes on a file that are not shown in the rows of its panel. */
import type { Note } from "../../../../client/protocol";

/** Codes of notes that are shown in the rows. */
const IN_ROWS: ReadonlySet<string> = new Set([
  "up",
  "up-unsure",
  "mirrored",
  "floor",
  "no-floor",
  "joints-by-shape",
  "unfamiliar",
]);

/** The notes that no row shows. */
export const otherNotes = (notes: readonly Note[]): Note[] => notes.filter(({ code }) => !IN_ROWS.has(code));
