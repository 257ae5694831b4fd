/** The databases that were built on this device: kept by the browser in IndexedDB, so that a reload finds them. */

import { strings } from "../strings/strings";

const DATABASE = "strut";
const STORE = "databases";

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

/** Runs one request; resolves when what it did is on the disk. */
async function transact<T>(mode: IDBTransactionMode, ask: (store: IDBObjectStore) => IDBRequest<T>): Promise<T> {
  const database = await open();
  try {
    return await new Promise<T>((resolve, reject) => {
      const transaction = database.transaction(STORE, mode);
      const request = ask(transaction.objectStore(STORE));
      transaction.oncomplete = () => resolve(request.result);
      transaction.onabort = () => reject(refusal(transaction.error));
    });
  } finally {
    database.close();
  }
}

function open(): Promise<IDBDatabase> {
  return new Promise((resolve, reject) => {
    const request = indexedDB.open(DATABASE, 1);
    request.onupgradeneeded = () => request.result.createObjectStore(STORE, { keyPath: "name" });
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(refusal(request.error));
  });
}

function refusal(error: DOMException | null): Error {
  return new Error(error?.name === "QuotaExceededError" ? strings.data.shelf.full : strings.data.shelf.refused);
}
