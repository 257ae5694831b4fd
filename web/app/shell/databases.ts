/** Chooses the open database: the built-in one, one that is stored on this device, one of a project, or a dropped one. */

import type { DatabaseSource } from "../../client/protocol";
import { isCancellation } from "../../client/protocol";
import type { Session } from "../../player/session";
import { allOf, type Selection } from "../../ui/polygon/selection";
import type { Store } from "../state/store";
import { strings } from "../strings/strings";
import type { ProgressLine } from "../ui/progress";
import type { Toasts } from "../ui/toasts";
import { spoken } from "../ui/words";
import type { ClipStyle, StyleBase } from "../views/data/style_of_clip";

/** Reads a database stored on this device by its name; `undefined` if there is none. */
type ReadSaved = (name: string) => Promise<Blob | undefined>;

const BUILT_IN: DatabaseSource = { kind: "demo" };
/** The part of the built-in database that is shown while the rest loads. */
const FIRST: DatabaseSource = { kind: "demo", set: "first" };

/** A style that was made from a clip. */
interface MadeStyle extends ClipStyle {
  /** Name of its database on this device, if it is stored. */
  kept?: string;
}

export class Databases {
  readonly #store: Store;
  readonly #toasts: Toasts;
  readonly #session: Session;
  readonly #readSaved: ReadSaved;
  /** Name of the open database on this device, or in {@link #held}; empty for others. */
  #name = "";
  /** Databases of projects, by their names in the state; they are kept as long as the page is open. */
  readonly #held = new Map<string, Blob>();
  /** The last open database that is not saved under a name. */
  #unnamed: DatabaseSource = BUILT_IN;
  /** Counter of requests for a database: only the last one counts. */
  #requests = 0;
  /** Name of the database that is being opened because the state asks for it; `undefined` if there is none. */
  #followed: string | undefined;
  /** The database that the user opens and its name on this device, until its input is open as well. */
  #chosen: { source: DatabaseSource; name: string } | undefined;
  /** Aborts the exchange of the first part for the whole built-in database. */
  #completion = new AbortController();
  /** New names, by the former ones, of styles of the open database when it has just been replaced. */
  renamed: ReadonlyMap<string, string> = new Map();
  /** Settles when the open database is complete. */
  complete: Promise<unknown> = Promise.resolve();

  constructor(store: Store, toasts: Toasts, session: Session, readSaved: ReadSaved = readSavedDatabase) {
    this.#store = store;
    this.#toasts = toasts;
    this.#session = session;
    this.#readSaved = readSaved;
  }

  /** The databases that the page keeps for projects, by their names. */
  get held(): ReadonlyMap<string, Blob> {
    return this.#held;
  }

  /** Keeps a file under a name that the state uses already. */
  keep(name: string, file: Blob): void {
    this.#held.set(name, file);
  }

  /** Keeps a file, so that the state can name it. Returns the name: its own unless another database has it. */
  async hold(fileName: string, file: Blob): Promise<string> {
    const base = fileName.replace(/\.strutdb$/i, "").trim() || "database";
    for (let n = 1; ; n++) {
      const name = n === 1 ? base : `${base} (${n})`;
      if (this.#held.get(name) === file) return name;
      if (this.#held.has(name) || (await this.#readSaved(name).catch(() => undefined))) continue;
      this.#held.set(name, file);
      return name;
    }
  }

  /** Forgets a kept file; a database opened from it stays open. */
  release(name: string): void {
    this.#held.delete(name);
  }

  /** Gives the last open unnamed database a name, so that the state can return to it from the built-in database. */
  async nameUnnamed(): Promise<void> {
    const source = this.#unnamed;
    if (source.kind === "demo") return;
    const name = await this.hold(source.name, source.file);
    this.#unnamed = BUILT_IN;
    if (this.#name !== "") return;
    this.#name = name;
    this.#store.adopt({ database: name });
  }

  /** The file of the last open unnamed database; `undefined` if that is the built-in one. */
  get unnamed(): { name: string; file: Blob } | undefined {
    return this.#unnamed.kind === "demo" ? undefined : this.#unnamed;
  }

  /** Makes a file the last open unnamed database, before anything is open. */
  set unnamed(file: { name: string; file: Blob } | undefined) {
    this.#unnamed = file ? { kind: "strutdb", ...file } : BUILT_IN;
  }

  /** Whether the state asks for a database other than the open one. */
  get moving(): boolean {
    return this.#followed !== undefined || this.#store.state.database !== this.#name;
  }

  /** Whether the state asks for a database other than the one that is open or being opened. */
  get mustFollow(): boolean {
    const wanted = this.#store.state.database;
    if (this.#followed !== undefined) return wanted !== this.#followed;
    if (!this.#chosen) return wanted !== this.#name;
    // It is displayed before its input is open.
    return this.#session.databaseSource !== this.#chosen.source || wanted !== this.#chosen.name;
  }

  /** Display name and file of the open database; no file for the built-in one. */
  get file(): { name: string; file: Blob | undefined } {
    const source = this.#source;
    return source.kind === "demo" ? { name: "", file: undefined } : { name: source.name, file: source.file };
  }

  /**
   * Opens a database and shows it, with other styles if given. `kept` is its name on this device, empty if it is not
   * stored. Returns whether it is open; otherwise the previous one stays open.
   */
  async open(source: DatabaseSource, kept: string, styles?: Selection): Promise<boolean> {
    const opened = await this.#show(source, kept, styles);
    if (opened) this.#announce();
    return opened;
  }

  /**
   * Opens a database that was built, for all views, and by its name on this device if it is stored. Returns whether it
   * is open.
   * @param renamed new names of styles by their former ones: if it replaces the open database, the selection is kept
   */
  async openBuilt(
    { name, file }: { name: string; file: Blob },
    kept: boolean,
    renamed: ReadonlyMap<string, string>,
  ): Promise<boolean> {
    if (kept && name === this.#name) this.renamed = renamed;
    const known = kept ? name : "";
    try {
      return await this.#opened(this.#choose({ kind: "strutdb", name, file }, known), known, undefined);
    } finally {
      this.renamed = new Map();
    }
  }

  #show(source: DatabaseSource, kept: string, styles: Selection | undefined): Promise<boolean> {
    const opening = this.#choose(source, kept);
    this.#store.edit({ view: "play" });
    return this.#opened(opening, kept, styles);
  }

  async #opened(opening: Promise<boolean>, kept: string, styles: Selection | undefined): Promise<boolean> {
    if (!(await opening)) return false;
    this.#store.edit({ database: kept, ...(styles && { styles }) });
    return true;
  }

  /**
   * Opens the database that the state asks for, and the input `inputName` on it. If it cannot be opened, the previous
   * one stays open, or the built-in database is opened; the state is changed accordingly.
   */
  async follow(inputName: string): Promise<void> {
    const request = this.#begin();
    const name = this.#store.state.database;
    this.#followed = name;
    const source = await this.#wanted(name);
    if (request !== this.#requests) return;
    const opened = source !== undefined && (await this.#load(source, name, inputName, request));
    if (request !== this.#requests) return;
    if (opened) {
      this.#followed = undefined;
      return;
    }
    if (!this.#session.database && source !== BUILT_IN) await this.#load(BUILT_IN, "", inputName, request);
    if (request !== this.#requests) return;
    this.#followed = undefined;
    if (name !== "" && source) this.#toasts.note(strings.page.links.databaseRefused(name));
    this.#store.adopt({ database: this.#name });
  }

  /**
   * Opens a few strides in every style and their input, a tenth of the built-in database, and then loads the rest in
   * the background.
   */
  async startWithFirst(): Promise<void> {
    const request = this.#begin();
    if (!(await this.#load(FIRST, "", "", request))) return;
    this.#unnamed = BUILT_IN;
    this.complete = this.#session.exchangeDatabase(BUILT_IN, this.#completion.signal);
  }

  /** Adds a clip as a style to the open database, as specified by the user, and shows it. */
  async addStyle(clip: File, progress: ProgressLine): Promise<void> {
    const known = this.#session.database;
    if (known) await this.#makeStyle(clip, { known, file: this.file.file }, progress);
  }

  /** Adds a clip as a style to a database; `before` is the style that was made from it before, which is replaced. */
  async #makeStyle(clip: File, base: StyleBase, progress: ProgressLine, before?: MadeStyle): Promise<void> {
    const { known } = base;
    try {
      const { actionIn, secondsOf, styleName, styleOfClip } = await import("../views/data/style_of_clip");
      const { askForStyle } = await import("../views/data/name_dialog");
      const { actions, styles: taken } = known;
      const asked = await askForStyle({
        suggested: before ?? { style: styleName(clip.name, actions, taken), action: actionIn(clip.name, actions) },
        taken,
        actions,
        seconds: await secondsOf(clip),
      });
      if (!asked) return;
      const { style } = asked;
      const replaced = before?.style === style ? before.kept : undefined;
      const { database, lost, doubt } = await progress.run(strings.page.engine.registering(clip.name), (options) =>
        styleOfClip(base, clip, asked, replaced, options),
      );
      const source = { kind: "strutdb" as const, name: database.name, file: database.file };
      const kept = lost ? "" : database.name;
      const styles = allOf(this.#store.state.styles, style);
      if (!(await this.#show(source, kept, styles))) return;
      const { classes = [] } = this.#session.database ?? {};
      const action = classes.find((known) => known.style === style)?.action ?? "";
      const change = () => void this.#makeStyle(clip, base, progress, { style, action, ...(kept !== "" && { kept }) });
      const { made, change: label, notKept } = strings.page.engine;
      const text = made(style, spoken(action), database.styles.length);
      this.#toasts.offer(doubt === "" ? text : `${text} ${doubt}`, label, change);
      if (lost) this.#toasts.error(notKept(style, lost));
    } catch (error) {
      if (!isCancellation(error)) this.#toasts.failure(error);
    }
  }

  get #source(): DatabaseSource {
    return this.#session.databaseSource ?? BUILT_IN;
  }

  /** The database with a name on this device; an empty name means the last unnamed one. `undefined` if it does not exist. */
  async #wanted(name: string): Promise<DatabaseSource | undefined> {
    if (name === "") return this.#unnamed;
    const held = this.#held.get(name);
    if (held) return { kind: "strutdb", name, file: held };
    const file = await this.#readSaved(name).catch(() => undefined);
    if (file) return { kind: "strutdb", name, file };
    this.#toasts.note(strings.page.links.databaseMissing(name));
    return undefined;
  }

  /** Begins a request, which replaces the previous one. */
  #begin(): number {
    this.#completion.abort();
    this.#completion = new AbortController();
    this.#followed = undefined;
    this.#chosen = undefined;
    return ++this.#requests;
  }

  /** Opens a database that the user chose, and the displayed input on it. Returns whether it is open. */
  async #choose(source: DatabaseSource, kept: string): Promise<boolean> {
    const request = this.#begin();
    this.#chosen = { source, name: kept };
    const opened = await this.#load(source, kept, this.#session.chosen, request);
    if (request === this.#requests) this.#chosen = undefined;
    return opened;
  }

  /** Opens a database. Returns whether it is open, with or without the input. */
  async #load(source: DatabaseSource, kept: string, inputName: string, request: number): Promise<boolean> {
    await this.#session.openDatabase(source, inputName);
    if (request !== this.#requests || this.#session.databaseSource !== source) return false;
    this.#name = kept;
    if (kept === "") this.#unnamed = source;
    return true;
  }

  #announce(): void {
    const { database } = this.#session;
    if (database) this.#toasts.note(strings.page.engine.stylesReady(database.styles.length, database.frames));
  }
}

async function readSavedDatabase(name: string): Promise<Blob | undefined> {
  const { savedDatabase } = await import("../views/data/saved_databases");
  return (await savedDatabase(name))?.file;
}
