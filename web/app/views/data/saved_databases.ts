/** The databases that were built on this device: the browser keeps them in IndexedDB, so that a reload finds them. */
import { IndexedDbStore } from "../../../client/indexed_db_store";
import { StrutError } from "../../../client/protocol";
import { strings } from "../../strings/strings";
import { askToPersist } from "../../ui/storage";
import { freeName } from "./free_name";

const databases = new IndexedDbStore("strut", "databases", "name");

/** A database that the browser keeps. */
export interface SavedDatabase {
  name: string;
  file: Blob;
  clips: number;
  frames: number;
  actions: string[];
  styles: string[];
}

/** All databases, in the order of their names. @throws Error with a sentence where the browser keeps nothing */
export function listSavedDatabases(): Promise<SavedDatabase[]> {
  return transact("readonly", (store) => store.getAll() as IDBRequest<SavedDatabase[]>);
}

/** The database of a name. @throws Error with a sentence where the browser keeps nothing */
export function savedDatabase(name: string): Promise<SavedDatabase | undefined> {
  return transact("readonly", (store) => store.get(name) as IDBRequest<SavedDatabase | undefined>);
}

/**
 * Keeps a database beside those that are kept already: under its name, or where that is taken with a number after it.
 * @returns the name
 * @throws Error with a sentence where the browser has no storage, or it is full
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
      // Another tab may have taken the name meanwhile.
      if ((error as DOMException | null)?.name !== "ConstraintError") throw refusal(error as DOMException | null);
    }
  }
}

/** Keeps a database in the place of the one of the same name. @throws Error with a sentence as {@link addDatabase} */
export async function replaceDatabase(database: SavedDatabase): Promise<void> {
  await transact("readwrite", (store) => store.put(database));
}

/** Deletes a database. @throws Error with a sentence where the browser keeps nothing */
export async function deleteDatabase(name: string): Promise<void> {
  await transact("readwrite", (store) => store.delete(name));
}

/** Runs one request, and says what to do where the browser refuses it. */
function transact<T>(mode: IDBTransactionMode, ask: (store: IDBObjectStore) => IDBRequest<T>): Promise<T> {
  return databases.transact(mode, ask).catch((error: DOMException | null) => {
    throw refusal(error);
  });
}

function refusal(error: DOMException | null): Error {
  // A newer version of the page has changed how they are kept.
  if (error?.name === "VersionError")
    return new StrutError({ code: "load", message: strings.data.saved.newer, hint: strings.data.saved.reload });
  return new Error(error?.name === "QuotaExceededError" ? strings.data.saved.full : strings.data.saved.refused);
}
