/** Faults that a test injects into an open page: workers that end or do not answer, timers that fire early. */
import type { Page } from "playwright-core";

/** Effect of a call on a worker: it ends with an error, ends silently, or never receives the call. */
export type WorkerFault = "fails" | "vanishes" | "never hears";

declare const window: { workerFaults?: Map<string, WorkerFault> };

/** Injects a fault into the next call of a method to any worker of the page. */
export function failNextCall(page: Page, method: string, fault: WorkerFault): Promise<void> {
  return page.evaluate(
    ({ method, fault }) => {
      if (!window.workerFaults) {
        const faults = new Map<string, WorkerFault>();
        window.workerFaults = faults;
        const { postMessage } = Worker.prototype;
        Worker.prototype.postMessage = function (this: Worker, ...args: unknown[]) {
          const { method } = args[0] as { method?: string };
          const fault = method === undefined ? undefined : faults.get(method);
          if (fault !== "never hears") Reflect.apply(postMessage, this, args);
          if (!fault) return;
          faults.delete(method!);
          if (fault === "never hears") return;
          this.terminate();
          const message = "ended for the test";
          if (fault === "fails") setTimeout(() => this.dispatchEvent(new ErrorEvent("error", { message })));
        };
      }
      window.workerFaults.set(method, fault);
    },
    { method, fault },
  );
}

/** Resolves when the fault of a method has occurred. */
export async function faultMet(page: Page, method: string): Promise<void> {
  await page.waitForFunction((method) => !window.workerFaults!.has(method), method);
}

/** How long a note stays, long enough to be read. */
const NOTE_MS = 6000;

/** Shortens all other waits of seconds to a twentieth. */
export function hurryTimers(page: Page): Promise<void> {
  return page.evaluate((noteMs) => {
    const later = globalThis.setTimeout;
    const hurried = (ms: number) => (ms > 1000 && ms !== noteMs ? ms / 20 : ms);
    Object.assign(globalThis, { setTimeout: (act: () => void, ms = 0) => later(act, hurried(ms)) });
  }, NOTE_MS);
}

/** Returns errors in the page's console, except those about missing files. */
export function consoleErrors(page: Page): string[] {
  const errors: string[] = [];
  page.on("console", (message) => {
    if (message.type() === "error" && !message.text().startsWith("Failed to load resource"))
      errors.push(message.text());
  });
  return errors;
}

/** Removes the page's messages, so that the next one can be awaited. */
export function dismissAll(page: Page): Promise<void> {
  return page.locator(".toast").evaluateAll((toasts) => {
    for (const toast of toasts) toast.querySelector<HTMLElement>("button:last-of-type")!.click();
  });
}

/** A database that a test puts into the browser's storage. */
export interface KeptDatabase {
  name: string;
  styles: string[];
  bytes: Uint8Array;
}

/** Stores a database in the page's browser, as the page does after a build. */
export function keepDatabase(page: Page, { name, styles, bytes }: KeptDatabase): Promise<void> {
  return page.evaluate(
    ({ name, styles, content }) =>
      new Promise<void>((resolve, reject) => {
        const opening = indexedDB.open("strut", 1);
        opening.onupgradeneeded = () => opening.result.createObjectStore("databases", { keyPath: "name" });
        opening.onerror = () => reject(opening.error);
        opening.onsuccess = () => {
          const file = new Blob([Uint8Array.from(atob(content), (c) => c.charCodeAt(0))]);
          const transaction = opening.result.transaction("databases", "readwrite");
          transaction.objectStore("databases").put({ name, file, clips: 2, frames: 300, actions: ["walk"], styles });
          transaction.oncomplete = () => resolve(opening.result.close());
        };
      }),
    { name, styles, content: Buffer.from(bytes).toString("base64") },
  );
}

/** Returns the names of the stored databases in the page's browser. */
export function keptNames(page: Page): Promise<IDBValidKey[]> {
  return page.evaluate(
    () =>
      new Promise<IDBValidKey[]>((resolve) => {
        const opening = indexedDB.open("strut", 1);
        opening.onsuccess = () => {
          const keys = opening.result.transaction("databases").objectStore("databases").getAllKeys();
          keys.onsuccess = () => resolve(keys.result);
          opening.result.close();
        };
      }),
  );
}
