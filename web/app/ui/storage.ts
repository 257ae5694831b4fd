/** The browser's storage of the page. */

let asked = false;

/**
 * Asks the browser once not to evict the page's storage when space is short; it may refuse. To be called when the user
 * first stores something.
 */
export async function askToPersist(
  storage: Partial<StorageManager> | undefined = globalThis.navigator?.storage,
): Promise<void> {
  if (asked || !storage?.persist) return;
  asked = true;
  if (await storage.persisted?.()) return;
  await storage.persist().catch(() => false);
}
