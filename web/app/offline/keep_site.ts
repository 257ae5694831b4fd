/** Stores the site in the browser with its service worker, and updates it on the user's request. */
import type { Order } from "./orders";

/**
 * Starts the worker, and stores all files that the page may load later, unless data saving is on.
 * @param onUpdate called when a newer version is available, with a function that switches to it
 */
export async function keepSite(onUpdate: (update: () => void) => void): Promise<void> {
  const workers = navigator.serviceWorker;
  const registration = await workers.register("service_worker.js");
  onWaiting(registration, () => onUpdate(() => showNewer(registration)));
  document.addEventListener("visibilitychange", () => {
    // Without a network there is no update.
    if (document.visibilityState === "visible") registration.update().catch(() => {});
  });
  const { active } = await workers.ready;
  if (!savesData()) tell(active, "keep all");
}

/** Calls back when the worker of a newer build is waiting, now and later. */
function onWaiting(registration: ServiceWorkerRegistration, call: () => void): void {
  if (registration.waiting) call();
  registration.addEventListener("updatefound", () => {
    const { installing, active } = registration;
    installing?.addEventListener("statechange", () => {
      // The very first worker is not an update.
      if (installing.state === "installed" && active) call();
    });
  });
}

/** Makes the newer worker take over, and reloads the page from it. Another page may have done the former. */
function showNewer({ waiting }: ServiceWorkerRegistration): void {
  if (!waiting) {
    location.reload();
    return;
  }
  navigator.serviceWorker.addEventListener("controllerchange", () => location.reload(), { once: true });
  tell(waiting, "take over");
}

function tell(worker: ServiceWorker | null, order: Order): void {
  worker?.postMessage(order);
}

/** https://wicg.github.io/savedata/, which is not in TypeScript's library. */
function savesData(): boolean {
  const { connection } = navigator as { connection?: { saveData?: boolean } };
  return connection?.saveData === true;
}
