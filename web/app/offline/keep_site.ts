/** Has the site kept in the browser by its service worker, and brought up to date when a person says so. */
import type { Order } from "./orders";

/**
 * Starts the worker, and has everything kept that the page may load later, unless the person saves data.
 * @param onUpdate is called when a newer version is there, with what shows it in place of this page
 */
export async function keepSite(onUpdate: (update: () => void) => void): Promise<void> {
  const workers = navigator.serviceWorker;
  const registration = await workers.register("service_worker.js");
  onWaiting(registration, () => onUpdate(() => showNewer(registration)));
  document.addEventListener("visibilitychange", () => {
    // Without a network there is nothing newer.
    if (document.visibilityState === "visible") registration.update().catch(() => {});
  });
  const { active } = await workers.ready;
  if (!savesData()) tell(active, "keep all");
}

/** Calls back when the worker of a newer build waits, now and later. */
function onWaiting(registration: ServiceWorkerRegistration, call: () => void): void {
  if (registration.waiting) call();
  registration.addEventListener("updatefound", () => {
    const { installing, active } = registration;
    installing?.addEventListener("statechange", () => {
      // The first worker of all is no update.
      if (installing.state === "installed" && active) call();
    });
  });
}

/** Has the newer worker take over, and loads the page from it. Another page may have done the first. */
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

/** https://wicg.github.io/savedata/, which TypeScript does not know. */
function savesData(): boolean {
  const { connection } = navigator as { connection?: { saveData?: boolean } };
  return connection?.saveData === true;
}
