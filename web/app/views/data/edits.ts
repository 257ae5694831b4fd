/** Edits of the labels in the table of clips, with undo and redo. */
import { History } from "../../state/history";
import type { Row } from "./corpus";

/** The fields of a row that an edit changes. */
type LabelFields = Pick<Row, "action" | "style" | "take" | "edited" | "unlabelled">;

/** The labels of the rows of one edit, which may change many rows alike. */
type SavedLabels = { row: Row; labels: LabelFields }[];

export class Edits extends History<SavedLabels> {
  readonly #onChange: () => void;

  /** @param onChange is called after an edit, undo and redo */
  constructor(onChange: () => void) {
    super(
      (of) => saved(of.map(({ row }) => row)),
      (rows) => {
        for (const { row, labels } of rows) Object.assign(row, labels);
        onChange();
      },
    );
    this.#onChange = onChange;
  }

  /** Changes the labels of rows. */
  edit(rows: readonly Row[], change: Partial<Pick<Row, "action" | "style" | "take">>): void {
    this.record(saved(rows));
    for (const row of rows) Object.assign(row, change, { edited: true, unlabelled: "" });
    this.#onChange();
  }
}

function saved(rows: readonly Row[]): SavedLabels {
  return rows.map((row) => {
    const { action, style, take, edited, unlabelled } = row;
    return { row, labels: { action, style, take, edited, unlabelled } };
  });
}
