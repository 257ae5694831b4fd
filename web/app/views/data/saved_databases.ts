/** The databases that were built on this device, stored in IndexedDB, so that a reload restores them. */
import { IndexedDbStore } from "../../../client/indexed_db_store";
import { StrutError } from "../../../client/protocol";
import { strings } from "../../strings/strings";
import { askToPersist } from "../../ui/storage";
import { freeName } from "./free_name";

const databases = new IndexedDbStore("strut", "databases", "name");

/** A stored database. */
export interface SavedDatabase {
  name: string;
  file: Blob;
  clips: number;
  frames: number;
  actions: string[];
  styles: string[];
}

/** All databases, ordered by name. @throws Error with a sentence if the browser stores nothing */
export function listSavedDatabases(): Promise<SavedDatabase[]> {
  return transact("readonly", (store) => store.getAll() as IDBRequest<SavedDatabase[]>);
}

/** The database with a name. @throws Error with a sentence if the browser stores nothing */
export function savedDatabase(name: string): Promise<SavedDatabase | undefined> {
  return transact("readonly", (store) => store.get(name) as IDBRequest<SavedDatabase | undefined>);
}

/**
 * Stores a database in addition to the others: under its name, or if that is in use with a number appended.
 * @returns the name
 * @throws Error with a sentence if the browser has no storage, or it is full
 */
export async function addDatabase(database: SavedDatabase): Promise<string> {
  for (;;) {
    const taken = await transact("readonly", (store) => store.getAllKeys() as IDBRequest<string[]>);
    const name = freeName(database.name, taken);
    try {
      await databases.transact("readwrite", (store) => store.add({ ...database, name }));
      void askToPersist();
      return name;
    } catch (error) {
      // Another tab may have used the name meanwhile.
      if ((error as DOMException | null)?.name !== "ConstraintError") throw refusal(error as DOMException | null);
    }
  }
}

/** Stores a database instead of the one of the same name. @throws Error with a sentence, like {@link addDatabase} */
export async function replaceDatabase(database: SavedDatabase): Promise<void> {
  await transact("readwrite", (store) => store.put(database));
}

/** Deletes a database. @throws Error with a sentence if the browser stores nothing */
export async function deleteDatabase(name: string): Promise<void> {
  await transact("readwrite", (store) => store.delete(name));
}

/** Runs one request; the error tells the user what to do if the browser refuses it. */
function transact<T>(mode: IDBTransactionMode, ask: (store: IDBObjectStore) => IDBRequest<T>): Promise<T> {
  return databases.transact(mode, ask).catch((error: DOMException | null) => {
    throw refusal(error);
  });
}

function refusal(error: DOMException | null): Error {
  // A newer version of the page has changed the storage format.
  if (error?.name === "VersionError")
    return new StrutError({ code: "load", message: strings.data.saved.newer, hint: strings.data.saved.reload });
  return new Error(error?.name === "QuotaExceededError" ? strings.data.saved.full : strings.data.saved.refused);
}
