/** What a person typed into the table of clips, to be taken back and done again. */
import type { History } from "../store";
import type { Row } from "./corpus";

/** The fields of a row that an edit changes. */
type Written = Pick<Row, "action" | "style" | "take" | "edited" | "unlabelled">;

/** One edit may change many rows alike. */
type Edit = { row: Row; before: Written; after: Written }[];

export class Edits implements History {
  readonly #onChange: () => void;
  #past: Edit[] = [];
  #future: Edit[] = [];

  /** @param onChange is called after everything but {@link forget} */
  constructor(onChange: () => void) {
    this.#onChange = onChange;
  }

  get canUndo(): boolean {
    return this.#past.length > 0;
  }

  get canRedo(): boolean {
    return this.#future.length > 0;
  }

  /** Changes the labels of rows. */
  edit(rows: readonly Row[], change: Partial<Pick<Row, "action" | "style" | "take">>): void {
    const changed = rows.map((row) => {
      const before = written(row);
      Object.assign(row, change, { edited: true, unlabelled: "" });
      return { row, before, after: written(row) };
    });
    this.#past.push(changed);
    this.#future = [];
    this.#onChange();
  }

  undo(): void {
    this.#move(this.#past, this.#future, "before");
  }

  redo(): void {
    this.#move(this.#future, this.#past, "after");
  }

  /** Forgets everything: the rows are others now. */
  forget(): void {
    this.#past = [];
    this.#future = [];
  }

  /** Takes the last edit of one list to the other, and its rows to how they were on that side of it. */
  #move(from: Edit[], to: Edit[], side: "before" | "after"): void {
    const edit = from.pop();
    if (!edit) return;
    to.push(edit);
    for (const changed of edit) Object.assign(changed.row, changed[side]);
    this.#onChange();
  }
}

function written({ action, style, take, edited, unlabelled }: Row): Written {
  return { action, style, take, edited, unlabelled };
}
