/** Edits of the table of clips, with undo and redo: labels, the neutral style, and the joints of skeletons. */
import type { Roles } from "../../../client/build/protocol";
import { History } from "../../state/history";
import type { Row } from "./corpus";

/** The fields of a row that an edit changes. */
type LabelFields = Pick<Row, "action" | "style" | "take" | "edited" | "unlabelled">;

/** Data that the user can edit. */
export interface Edited {
  readonly rows: readonly Row[];
  /** The style to which the others are compared. */
  neutral: string;
  /** The joints that the user chose, by `skeletonKey`. */
  chosen: ReadonlyMap<string, Roles>;
}

/** The labels of the edited rows by path, as rows are created again when files are added, and all other data. */
interface Saved {
  labels: ReadonlyMap<string, LabelFields>;
  neutral: string;
  chosen: ReadonlyMap<string, Roles>;
}

export class Edits extends History<Saved> {
  readonly #edited: Edited;
  readonly #onChange: () => void;

  /** @param onChange called after an edit, undo and redo */
  constructor(edited: Edited, onChange: () => void) {
    super(
      ({ labels }) =>
        saved(
          edited,
          edited.rows.filter(({ path }) => labels.has(path)),
        ),
      ({ labels, neutral, chosen }) => {
        for (const row of edited.rows) Object.assign(row, labels.get(row.path));
        Object.assign(edited, { neutral, chosen });
        onChange();
      },
    );
    this.#edited = edited;
    this.#onChange = onChange;
  }

  /** Changes the labels of rows, and the name of the neutral style afterwards. */
  edit(
    rows: readonly Row[],
    change: Partial<Pick<Row, "action" | "style" | "take">>,
    neutral = this.#edited.neutral,
  ): void {
    this.record(saved(this.#edited, rows));
    for (const row of rows) Object.assign(row, change, { edited: true, unlabelled: "" });
    this.#edited.neutral = neutral;
    this.#onChange();
  }

  /** Sets the neutral style. */
  setNeutral(style: string): void {
    this.edit([], {}, style);
  }

  /** Sets the joints of a skeleton. */
  choose(key: string, roles: Roles): void {
    this.record(saved(this.#edited, []));
    this.#edited.chosen = new Map([...this.#edited.chosen, [key, roles]]);
    this.#onChange();
  }
}

function saved({ neutral, chosen }: Edited, rows: readonly Row[]): Saved {
  const labels = rows.map(({ path, action, style, take, edited, unlabelled }) => {
    return [path, { action, style, take, edited, unlabelled }] as const;
  });
  return { labels: new Map(labels), neutral, chosen };
}
