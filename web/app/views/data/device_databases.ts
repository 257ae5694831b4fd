/**
 * The databases of this device while the Data view is open: those stored in the browser, those that it refused to
 * store, and deleted ones that can be restored. Only `replace` replaces a database.
 */
import { isUnloaded } from "../../../client/protocol";
import { errorText } from "../../ui/words";
import { freeName } from "./free_name";
import {
  addDatabase,
  deleteDatabase,
  listSavedDatabases,
  replaceDatabase,
  type SavedDatabase,
} from "./saved_databases";

/** Where a database was stored. */
export interface Placed {
  /** Its actual name. */
  name: string;
  /** Why the browser did not store it, a sentence; empty if it did. */
  unkept: string;
}

export class DeviceDatabases {
  #saved: SavedDatabase[] = [];
  /** Databases that the browser refused to store; they are kept as long as the view. */
  readonly #unkept = new Map<string, SavedDatabase>();
  readonly #deleted = new Map<string, SavedDatabase>();
  #fault = "";
  #outdated = false;

  /** Reads the stored databases; if there is no storage, {@link fault} has the reason. */
  async load(): Promise<void> {
    try {
      this.#saved = await listSavedDatabases();
      this.#fault = "";
      this.#outdated = false;
    } catch (error) {
      // Databases that were read before can still be opened.
      this.#fault = errorText(error);
      this.#outdated = isUnloaded(error);
    }
  }

  /** Why the browser stores nothing for this page, a sentence; empty if it does. */
  get fault(): string {
    return this.#fault;
  }

  /** Whether a newer version of the page manages them, so that this one can no longer read them. */
  get outdated(): boolean {
    return this.#outdated;
  }

  /** All databases that can be opened. */
  get all(): SavedDatabase[] {
    return [...this.#saved, ...this.#unkept.values()];
  }

  /** Databases deleted since the view was opened. */
  get deleted(): SavedDatabase[] {
    return [...this.#deleted.values()];
  }

  /** Whether something would be lost with the view. */
  get holdsUnkept(): boolean {
    return this.hasUnkept || this.#deleted.size > 0;
  }

  /** Whether there are databases that the browser refused to store. */
  get hasUnkept(): boolean {
    return this.#unkept.size > 0;
  }

  find(name: string): SavedDatabase | undefined {
    return this.all.find((database) => database.name === name);
  }

  isKept(name: string): boolean {
    return !this.#unkept.has(name);
  }

  /** The name, with a number if another database has it. */
  freeName(name: string): string {
    return freeName(
      name,
      this.all.map((database) => database.name),
    );
  }

  /** Adds a database under a free name. */
  async add(database: SavedDatabase): Promise<Placed> {
    const wanted = this.freeName(database.name);
    try {
      return { name: await addDatabase({ ...database, name: wanted }), unkept: "" };
    } catch (error) {
      this.#unkept.set(wanted, { ...database, name: wanted });
      return { name: wanted, unkept: errorText(error) };
    } finally {
      await this.load();
    }
  }

  /** Replaces the database of the same name; if the browser refuses that, both are kept. */
  async replace(database: SavedDatabase): Promise<Placed> {
    const { name } = database;
    if (this.#unkept.delete(name)) return this.add(database);
    try {
      await replaceDatabase(database);
      return { name, unkept: "" };
    } catch (error) {
      const free = this.freeName(name);
      this.#unkept.set(free, { ...database, name: free });
      return { name: free, unkept: errorText(error) };
    } finally {
      await this.load();
    }
  }

  /** Deletes a database, which {@link restore} can restore. @throws Error with a sentence if that fails */
  async delete(name: string): Promise<void> {
    const database = this.find(name);
    if (!database) return;
    if (!this.#unkept.delete(name)) await deleteDatabase(name);
    this.#deleted.set(name, database);
    await this.load();
  }

  /** Restores a deleted database, under another name if its own is in use. */
  async restore(name: string): Promise<Placed | undefined> {
    const database = this.#deleted.get(name);
    this.#deleted.delete(name);
    return database && this.add(database);
  }
}
