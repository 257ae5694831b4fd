/** Which database is open: the built-in one, one that is kept on this device, or one that was dropped. */
import type { DatabaseSource } from "../worker/protocol";
import type { Notices } from "./notices";
import { grouped } from "./numerals";
import { allOf, type Selection } from "./polygon/selection";
import type { ProgressLine } from "./progress";
import type { Session } from "./session";
import type { Store } from "./store";
import { strings } from "./strings/strings";
import { errorText, isCancellation } from "./words";

export class Databases {
  readonly #store: Store;
  readonly #notices: Notices;
  /** Name on this device of the database that is open; empty for others. */
  #name = "";
  /** Where the database that is open comes from, … */
  #source: DatabaseSource = { kind: "demo" };
  /** … and the last one without a name of its own here. */
  #unnamed: DatabaseSource = { kind: "demo" };

  constructor(store: Store, notices: Notices) {
    this.#store = store;
    this.#notices = notices;
  }

  /** Whether the state asks for another database than the one that is open. */
  get moving(): boolean {
    return this.#store.state.database !== this.#name;
  }

  /** Name for people and file of the database that is open; no file where it is the built-in one. */
  get file(): { name: string; file: Blob | undefined } {
    const source = this.#source;
    return source.kind === "demo" ? { name: "", file: undefined } : { name: source.name, file: source.file };
  }

  /**
   * Opens a database and shows it, in other styles where they are given; `kept` is its name on this device, empty if it
   * is not kept here.
   */
  async open(session: Session, source: DatabaseSource, kept: string, styles?: Selection): Promise<boolean> {
    const opening = session.openDatabase(source, session.inputName);
    this.#store.edit({ view: "play" });
    if ((await opening) !== "done" || !session.database) return false;
    this.#name = kept;
    this.#source = source;
    if (kept === "") this.#unnamed = source;
    this.#store.edit({ database: kept, ...(styles && { styles }) });
    const { styles: all, frames } = session.database;
    this.#notices.note(strings.page.engine.stylesReady(all.length, grouped(frames)));
    return true;
  }

  /** What the state asks for: a database that is kept on this device, or the built-in one. */
  async wanted(): Promise<DatabaseSource> {
    const { database: name } = this.#store.state;
    if (name === "") return this.#unnamed;
    const { fromShelf } = await import("./data/shelf");
    const kept = await fromShelf(name).catch(() => undefined);
    if (kept) {
      this.#name = name;
      this.#source = { kind: "strutdb", name, file: kept.file };
      return this.#source;
    }
    this.#store.adopt({ database: "" });
    this.#notices.note(strings.page.links.databaseMissing(name));
    return { kind: "demo" };
  }

  /** Makes a clip a style of the database that is open, by the name that the person gives it, and shows it. */
  async addStyle(session: Session, clip: File, progress: ProgressLine): Promise<void> {
    const known = session.database;
    if (!known) return;
    const file = this.#source.kind === "demo" ? undefined : this.#source.file;
    try {
      const { styleName, styleOfClip } = await import("./data/style_of_clip");
      const { askForStyleName } = await import("./data/name_dialog");
      const style = await askForStyleName(styleName(clip.name, known.actions, known.styles), known.styles);
      if (style === undefined) return;
      const { database, lost } = await progress.run(strings.page.engine.registering(clip.name), (options) =>
        styleOfClip(known, file, clip, style, options),
      );
      const source = { kind: "strutdb" as const, name: database.name, file: database.file };
      const styles = allOf(this.#store.state.styles, style);
      const opened = await this.open(session, source, lost ? "" : database.name, styles);
      if (opened && lost) this.#notices.error(strings.page.engine.notKept(style, lost));
    } catch (error) {
      if (!isCancellation(error)) this.#notices.error(errorText(error));
    }
  }

  /** Opens the database that a link or undo brought, unless it is the one that is open. */
  async follow(session: Session): Promise<void> {
    if (!this.moving) return;
    const source = await this.wanted();
    await this.open(session, source, this.#store.state.database);
  }
}
