/**
 * The part of IndexedDB that the page uses, in memory, for tests without a browser. It simulates failures of browsers:
 * no database at all, as in a private window, and no space when a transaction is committed.
 */

/** Failures of a database; they can be changed while a test runs. */
export interface Failures {
  /** `open` is refused. */
  refused?: boolean;
  /** Every write is aborted for lack of space. */
  full?: boolean;
}

type Key = string;
type Store = { keyPath: string | null; items: Map<Key, unknown> };

/** A request that succeeds in a later task, like all requests. */
class FakeRequest<T> {
  result!: T;
  error: DOMException | null = null;
  onsuccess: (() => void) | null = null;
  onerror: (() => void) | null = null;
  onupgradeneeded: (() => void) | null = null;
}

class FakeTransaction {
  error: DOMException | null = null;
  oncomplete: (() => void) | null = null;
  onabort: (() => void) | null = null;
  readonly #store: Store;
  readonly #failures: Failures;
  readonly #before: Map<Key, unknown>;
  #written = false;

  constructor(store: Store, failures: Failures) {
    this.#store = store;
    this.#failures = failures;
    this.#before = new Map(store.items);
    setTimeout(() => this.#end());
  }

  objectStore() {
    const { items, keyPath } = this.#store;
    const ask = <T>(result: T) => Object.assign(new FakeRequest<T>(), { result });
    const keyOf = (value: unknown, key?: Key) => (keyPath ? (value as Record<string, Key>)[keyPath]! : key!);
    const write = (value: unknown, key?: Key) => {
      this.#written = true;
      items.set(keyOf(value, key), structuredClone(value));
      return ask(keyOf(value, key));
    };
    return {
      get: (key: Key) => ask(items.get(key)),
      getAll: () => ask([...items.keys()].sort().map((key) => items.get(key))),
      getAllKeys: () => ask([...items.keys()].sort()),
      put: write,
      add: (value: unknown, key?: Key) => {
        if (!items.has(keyOf(value, key))) return write(value, key);
        this.error = new DOMException("Key already exists.", "ConstraintError");
        return ask(undefined);
      },
      delete: (key: Key) => {
        this.#written = true;
        items.delete(key);
        return ask(undefined);
      },
    };
  }

  #end(): void {
    if (this.#written && this.#failures.full) this.error ??= new DOMException("full", "QuotaExceededError");
    if (!this.error) {
      this.oncomplete?.();
      return;
    }
    this.#store.items.clear();
    for (const [key, item] of this.#before) this.#store.items.set(key, item);
    this.onabort?.();
  }
}

/** Replaces the global `indexedDB` by an empty fake. */
export function fakeIndexedDb(failures: Failures = {}): void {
  const databases = new Map<string, Map<string, Store>>();
  const open = (name: string) => {
    const request = new FakeRequest<unknown>();
    setTimeout(() => {
      if (failures.refused) {
        request.error = new DOMException("refused", "InvalidStateError");
        request.onerror?.();
        return;
      }
      const stores = databases.get(name) ?? new Map<string, Store>();
      request.result = {
        createObjectStore: (store: string, { keyPath }: { keyPath: string | null }) =>
          stores.set(store, { keyPath, items: new Map() }),
        transaction: (store: string) => new FakeTransaction(stores.get(store)!, failures),
        close: () => {},
      };
      if (!databases.has(name)) request.onupgradeneeded?.();
      databases.set(name, stores);
      request.onsuccess?.();
    });
    return request;
  };
  globalThis.indexedDB = { open } as unknown as IDBFactory;
}
