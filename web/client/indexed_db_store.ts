/** Storage of this page in IndexedDB: one database with one store for each kind of object. */
export class IndexedDbStore {
  /** @param keyPath field of the objects that is their key; without it the key is passed with each object */
  constructor(
    private readonly database: string,
    private readonly store: string,
    private readonly keyPath?: string,
  ) {}

  /**
   * Runs one request. Resolves when its result is on the disk.
   * @throws DOMException if the browser has no storage, or it is full
   */
  async transact<T>(mode: IDBTransactionMode, ask: (store: IDBObjectStore) => IDBRequest<T>): Promise<T> {
    const database = await this.#open();
    try {
      return await new Promise<T>((resolve, reject) => {
        const transaction = database.transaction(this.store, mode);
        const request = ask(transaction.objectStore(this.store));
        transaction.oncomplete = () => resolve(request.result);
        transaction.onabort = () => reject(transaction.error);
      });
    } finally {
      database.close();
    }
  }

  #open(): Promise<IDBDatabase> {
    return new Promise((resolve, reject) => {
      const request = indexedDB.open(this.database, 1);
      request.onupgradeneeded = () => request.result.createObjectStore(this.store, { keyPath: this.keyPath ?? null });
      request.onsuccess = () => resolve(request.result);
      request.onerror = () => reject(request.error);
    });
  }
}
