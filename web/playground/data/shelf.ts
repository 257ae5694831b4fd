/** The databases that were built on this device: kept by the browser in IndexedDB, so that a reload finds them. */
import { Kept } from "../../worker/kept";
import { strings } from "../strings/strings";

const databases = new Kept("strut", "databases", "name");

/** A database on the shelf. */
export interface Shelved {
  name: string;
  file: Blob;
  clips: number;
  frames: number;
  actions: string[];
  styles: string[];
}

/** All databases, in the order of their names. */
export function listShelf(): Promise<Shelved[]> {
  return transact("readonly", (store) => store.getAll() as IDBRequest<Shelved[]>);
}

/** The database of a name. */
export function fromShelf(name: string): Promise<Shelved | undefined> {
  return transact("readonly", (store) => store.get(name) as IDBRequest<Shelved | undefined>);
}

/** Keeps a database, in the place of the one of the same name. */
export async function keep(shelved: Shelved): Promise<void> {
  await transact("readwrite", (store) => store.put(shelved));
}

export async function forget(name: string): Promise<void> {
  await transact("readwrite", (store) => store.delete(name));
}

/** Runs one request, and says what to do where the browser refuses it. */
function transact<T>(mode: IDBTransactionMode, ask: (store: IDBObjectStore) => IDBRequest<T>): Promise<T> {
  return databases.transact(mode, ask).catch((error: DOMException | null) => {
    throw refusal(error);
  });
}

function refusal(error: DOMException | null): Error {
  return new Error(error?.name === "QuotaExceededError" ? strings.data.shelf.full : strings.data.shelf.refused);
}
