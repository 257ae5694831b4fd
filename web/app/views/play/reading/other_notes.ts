/** The notes on a file that the rows of its panel do not say. */
import type { Note } from "../../../../client/protocol";

/** Codes of notes that the rows say. */
const IN_ROWS: ReadonlySet<string> = new Set([
  "up",
  "up-unsure",
  "mirrored",
  "floor",
  "no-floor",
  "joints-by-shape",
  "unfamiliar",
]);

/** The notes that no row says. */
export const otherNotes = (notes: readonly Note[]): Note[] => notes.filter(({ code }) => !IN_ROWS.has(code));
