/** The clips of the Data view, independent of the page: opened, labelled, read and edited. */
import type { BuildClient } from "../../../client/build/client";
import type {
  BuiltDatabase,
  ChosenFile,
  DroppedFile,
  Preview,
  Roles,
  TwoManners,
} from "../../../client/build/protocol";
import { type CallOptions, isCancellation } from "../../../client/protocol";
import { strings } from "../../strings/strings";
import { errorText } from "../../ui/words";
import {
  applyLabels,
  applyRead,
  classTable,
  databaseName,
  type KnownSkeleton,
  type LabelField,
  likelyNeutral,
  obstacle,
  type Row,
  rowOf,
  skeletonKey,
} from "./corpus";
import { type Edited, Edits } from "./edits";
import { freeName } from "./free_name";
import { type Manners, mannersAmong } from "./manners";
import { renamedStyles } from "./renamed_styles";

const words = strings.data;

/** Labelling of clips that the user has not labelled. */
export interface Labelling {
  /** Pattern of the file names. */
  pattern?: string;
  /** A CSV table that has precedence over the pattern. */
  table?: File;
}

export class ClipCollection {
  readonly edits: Edits;
  readonly #edited: Edited & { rows: Row[] } = { rows: [], neutral: "", chosen: new Map() };
  skeletons: KnownSkeleton[] = [];
  pattern = "";
  /** How many names match the pattern or the table, or why these cannot be used. */
  labelNote = "";
  readonly #client: BuildClient;
  readonly #onChange: () => void;
  #files: DroppedFile[] = [];
  #table: File | undefined;
  /** Bimodal styles found by the last build. */
  #twoManners: readonly TwoManners[] = [];
  /** The style of each clip of the last build, by its path. */
  #built: ReadonlyMap<string, string> = new Map();
  /** The {@link ClipCollection.#labels} of the last build. */
  #builtLabels = "";
  /**
   * New names of styles, by their former ones: in the last build all clips of the style had another style than in the
   * previous one.
   */
  renamed: ReadonlyMap<string, string> = new Map();

  /** @param onChange called whenever rows, labels or the neutral style change */
  constructor(client: BuildClient, onChange: () => void) {
    this.#client = client;
    this.#onChange = onChange;
    this.edits = new Edits(this.#edited, () => this.#labelled());
  }

  /** All clips that were found, usable or not. */
  get rows(): Row[] {
    return this.#edited.rows;
  }

  /** The clips that will be part of the database. */
  get usable(): Row[] {
    return this.rows.filter((row) => obstacle(row, this.skeletons) === "");
  }

  /** Styles that the last build found to be bimodal, while they are still labelled as one. */
  get manners(): Manners[] {
    return mannersAmong(this.usable, this.#twoManners);
  }

  /** Whether there are clips, or labels, from which no database was built. */
  get isUnbuilt(): boolean {
    return this.rows.length > 0 && (this.#builtLabels === "" || this.#labels !== this.#builtLabels);
  }

  /** The style to which the others are compared. */
  get neutral(): string {
    return this.#edited.neutral;
  }

  /** Suggested name of the database, after the folder or archive of the clips. */
  get name(): string {
    return databaseName(this.rows.map(({ path }) => path));
  }

  /**
   * Removes all clips.
   * @returns a function that opens them again, with all edits; they must then be {@link read}
   */
  clear(): (options: CallOptions) => Promise<void> {
    const [files, before] = [this.#files, { ...this.#edited }];
    const labelling = { pattern: this.pattern, ...(this.#table && { table: this.#table }) };
    this.#client.dispose();
    this.#files = [];
    Object.assign(this.#edited, { rows: [], neutral: "", chosen: new Map() });
    this.#table = undefined;
    this.#twoManners = [];
    this.#built = new Map();
    this.skeletons = [];
    this.edits.forget();
    this.#onChange();
    return async (options) => {
      this.#files = [];
      Object.assign(this.#edited, before);
      await this.open(files, labelling, options);
      this.#edited.neutral = before.neutral;
      this.#labelled();
    };
  }

  /**
   * Lists and labels the clips in files, in addition to the open ones; a file with the same path replaces the previous
   * one. Edits by the user, and the pattern of the open clips, are kept. {@link read} reads the clips.
   * @returns sentences about what was left out
   */
  async open(files: readonly DroppedFile[], labelling: Labelling, options: CallOptions): Promise<string[]> {
    const paths = new Set(files.map(({ path }) => path));
    const edited = new Map(this.rows.filter((row) => row.edited).map((row) => [row.path, row]));
    const wereOpen = this.rows.length > 0;
    this.#files = [...this.#files.filter(({ path }) => !paths.has(path)), ...files];
    this.skeletons = [];
    const found = await this.#client.open(this.#files, options);
    this.#edited.rows = found.clips.map(rowOf);
    for (const row of this.rows) {
      const edit = edited.get(row.path);
      if (edit) Object.assign(row, { action: edit.action, style: edit.style, take: edit.take, edited: true });
    }
    if (this.rows.length === 0) this.#files = [];
    await this.label(
      wereOpen ? { ...labelling, pattern: this.pattern } : { pattern: found.pattern ?? "", ...labelling },
    );
    return found.clips.length === 0 && found.notes.length === 0 ? [words.noClips] : found.notes;
  }

  /** Reads every clip for its length, frame rate and skeleton. */
  read(options: CallOptions): Promise<void> {
    const { rows, skeletons } = this;
    return this.#client.readAll((event) => {
      applyRead(rows, skeletons, event);
      this.#applyChosen();
      this.#onChange();
    }, options);
  }

  /** Sets the labels from the table, if there is one, and the pattern. */
  async label({ pattern = this.pattern, table = this.#table }: Labelling = {}): Promise<void> {
    this.pattern = pattern;
    this.#table = table;
    if (this.rows.length === 0) return;
    try {
      applyLabels(this.rows, await this.#client.label(pattern || undefined, table));
      const matching = this.rows.filter((row) => row.unlabelled === "").length;
      const all = this.rows.length;
      const matches = matching === all ? words.names.all : words.names.some(matching, all);
      this.labelNote = table ? words.names.tableFirst(matches, table.name) : matches;
    } catch (error) {
      if (isCancellation(error)) return;
      // A table that cannot be read is not tried again.
      this.#table = undefined;
      this.labelNote = errorText(error);
    }
    this.#labelled();
  }

  /** Sets a label of one clip to the user's text. */
  edit(row: Row, field: LabelField, value: string): void {
    const text = value.trim();
    const take = /^\d{1,9}$/.test(text) ? Number(text) : undefined;
    this.edits.edit([row], field === "take" ? { take } : { [field]: text });
  }

  /** Renames an action or a style everywhere; with the name of another one, the two are merged. */
  rename(field: "action" | "style", from: string, to: string): void {
    const isNeutral = field === "style" && this.neutral === from;
    this.edits.edit(
      this.rows.filter((row) => row[field].trim() === from),
      { [field]: to },
      isNeutral ? to : this.neutral,
    );
  }

  /** Makes the second cluster of a bimodal style a style of its own, under a name that is free in the action. */
  divide({ action, style, rows }: Manners): void {
    const taken = this.rows.filter((row) => row.action === action).map((row) => row.style.trim());
    this.edits.edit(rows[1], { style: freeName(style.trim(), taken) });
  }

  /** A clip as it will enter the database. */
  preview(row: Row): Promise<Preview> {
    return this.#client.preview(row.index, this.#rolesOf(row));
  }

  /** Builds a database of the usable clips; clips that prove to be unusable are marked with the reason. */
  async build(options: CallOptions): Promise<BuiltDatabase> {
    const files = this.usable.map(
      (row): ChosenFile => ({
        index: row.index,
        path: row.path,
        licence: row.licence,
        action: row.action.trim(),
        style: row.style.trim(),
        take: row.take,
        roles: this.#rolesOf(row),
      }),
    );
    const labels = this.#labels;
    const built = await this.#client.build(files, this.neutral, options);
    this.#builtLabels = labels;
    const styles = new Map(files.map(({ path, style }) => [path, style]));
    this.renamed = renamedStyles(this.#built, styles);
    this.#built = styles;
    const reasons = new Map(built.refused.map(({ path, reason }) => [path, reason]));
    for (const row of this.rows) row.fault = reasons.get(row.path) ?? row.fault;
    this.#twoManners = built.twoManners;
    return built;
  }

  /** All user settings of the clips, for comparison. */
  get #labels(): string {
    const { rows, neutral, chosen } = this.#edited;
    return JSON.stringify([
      rows.map(({ path, action, style, take }) => [path, action, style, take]),
      neutral,
      [...chosen],
    ]);
  }

  #rolesOf({ read }: Row): Roles | undefined {
    return read && this.skeletons[read.skeleton]?.chosen;
  }

  /** If no clip has the neutral style any more, another style replaces it. */
  #labelled(): void {
    this.#applyChosen();
    const { styles } = classTable(this.usable);
    if (!styles.includes(this.neutral)) this.#edited.neutral = likelyNeutral(styles);
    this.#onChange();
  }

  #applyChosen(): void {
    for (const skeleton of this.skeletons) skeleton.chosen = this.#edited.chosen.get(skeletonKey(skeleton));
  }
}
