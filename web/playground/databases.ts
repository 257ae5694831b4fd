/** Which database is open: the built-in one, one that is kept on this device, or one that was dropped. */
import type { DatabaseSource } from "../worker/protocol";
import type { Notices } from "./notices";
import type { Session } from "./session";
import type { Store } from "./store";
import { grouped } from "./words";

export class Databases {
  readonly #store: Store;
  readonly #notices: Notices;
  /** Name on this device of the database that is open; empty for others. */
  #name = "";

  constructor(store: Store, notices: Notices) {
    this.#store = store;
    this.#notices = notices;
  }

  /** Opens a database and shows it; `kept` is its name on this device, empty if it is not kept here. */
  async open(session: Session, source: DatabaseSource, kept: string): Promise<boolean> {
    const opening = session.openDatabase(source, session.inputName);
    this.#store.edit({ view: "play" });
    if ((await opening) !== "done" || !session.database) return false;
    this.#name = kept;
    this.#store.edit({ database: kept });
    const { styles, frames } = session.database;
    this.#notices.note(`${styles.length} styles ready. ${grouped(frames)} frames.`);
    return true;
  }

  /** What the state asks for: a database that is kept on this device, or the built-in one. */
  async wanted(): Promise<DatabaseSource> {
    const { database: name } = this.#store.state;
    if (name === "") return { kind: "demo" };
    const { fromShelf } = await import("./data/shelf");
    const kept = await fromShelf(name).catch(() => undefined);
    if (kept) {
      this.#name = name;
      return { kind: "strutdb", name, file: kept.file };
    }
    this.#store.adopt({ database: "" });
    this.#notices.note(`This link was made with the database “${name}”, which is not on this device.`);
    return { kind: "demo" };
  }

  /** Opens the database that a link brought, unless it is the one that is open. */
  async follow(session: Session): Promise<void> {
    if (this.#store.state.database === this.#name) return;
    const source = await this.wanted();
    await this.open(session, source, this.#store.state.database);
  }
}
