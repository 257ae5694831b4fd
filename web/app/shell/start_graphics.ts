/** Starts what draws in 3-D. */

/**
 * Waits on a thread of its own until the first WebGL context is there: the page would stand still meanwhile. Its own
 * contexts come at once then. A browser in which workers cannot draw has the page wait.
 */
export function startGraphics(): Promise<void> {
  const worker = new Worker(new URL("./graphics_worker.ts", import.meta.url), { type: "module", name: "graphics" });
  return new Promise<void>((resolve) => {
    worker.onmessage = () => resolve();
    worker.onerror = () => resolve();
  }).finally(() => worker.terminate());
}
