/**
 * The databases of this device while the Data view is open: those that the browser keeps, those that it refused to keep,
 * and those that were deleted and can be brought back. No method replaces a database but `replace`.
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

/** Where a database went. */
export interface Placed {
  /** The name that it has now. */
  name: string;
  /** Why the browser does not keep it, a sentence; empty if it does. */
  unkept: string;
}

export class DeviceDatabases {
  #saved: SavedDatabase[] = [];
  /** Databases that the browser refused to keep: they last as long as the view. */
  readonly #unkept = new Map<string, SavedDatabase>();
  readonly #deleted = new Map<string, SavedDatabase>();
  #fault = "";
  #outdated = false;

  /** Reads what the browser keeps; where it keeps nothing {@link fault} says so. */
  async load(): Promise<void> {
    try {
      this.#saved = await listSavedDatabases();
      this.#fault = "";
      this.#outdated = false;
    } catch (error) {
      // What was read before can still be opened.
      this.#fault = errorText(error);
      this.#outdated = isUnloaded(error);
    }
  }

  /** Why the browser keeps nothing for this page, a sentence; empty if it does. */
  get fault(): string {
    return this.#fault;
  }

  /** Whether a newer version of the page keeps them: this one can read them no longer. */
  get outdated(): boolean {
    return this.#outdated;
  }

  /** All that can be opened. */
  get all(): SavedDatabase[] {
    return [...this.#saved, ...this.#unkept.values()];
  }

  /** Those that were deleted since the view was opened. */
  get deleted(): SavedDatabase[] {
    return [...this.#deleted.values()];
  }

  /** Whether something here would be lost with the view. */
  get holdsUnkept(): boolean {
    return this.hasUnkept || this.#deleted.size > 0;
  }

  /** Whether there are databases that the browser refused to keep. */
  get hasUnkept(): boolean {
    return this.#unkept.size > 0;
  }

  find(name: string): SavedDatabase | undefined {
    return this.all.find((database) => database.name === name);
  }

  isKept(name: string): boolean {
    return !this.#unkept.has(name);
  }

  /** The name, with a number where a database has it. */
  freeName(name: string): string {
    return freeName(
      name,
      this.all.map((database) => database.name),
    );
  }

  /** Adds a database beside the others, under a name that is free. */
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

  /** Puts a database in the place of the one of its name; where the browser refuses that, both stay. */
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

  /** Deletes a database, which {@link restore} brings back. @throws Error with a sentence where that fails */
  async delete(name: string): Promise<void> {
    const database = this.find(name);
    if (!database) return;
    if (!this.#unkept.delete(name)) await deleteDatabase(name);
    this.#deleted.set(name, database);
    await this.load();
  }

  /** Brings a deleted database back, under another name where its own was taken meanwhile. */
  async restore(name: string): Promise<Placed | undefined> {
    const database = this.#deleted.get(name);
    this.#deleted.delete(name);
    return database && this.add(database);
  }
}
