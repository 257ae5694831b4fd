/** Starts what draws in 3-D. */

import type { Graphics } from "../../viewer/stage/graphics";

/** Longest wait for the worker's answer: a graphics process may hang, or an extension keep workers from drawing. */
export const PATIENCE_MS = 3000;

/**
 * Waits on a thread of its own until the first WebGL context is there: the page would stand still meanwhile. Its own
 * contexts come at once then. Resolves with what draws, or with nothing where workers cannot draw: the page has to wait and
 * to find out itself. So it does where there are no workers, or none answers in time.
 */
export async function startGraphics(): Promise<Graphics | undefined> {
  let worker: Worker;
  try {
    worker = new Worker(new URL("./graphics_worker.ts", import.meta.url), { type: "module", name: "graphics" });
  } catch {
    return undefined;
  }
  return new Promise<Graphics | undefined>((resolve) => {
    worker.onmessage = ({ data }: MessageEvent<Graphics>) => resolve(data === "none" ? undefined : data);
    worker.onerror = () => resolve(undefined);
    setTimeout(() => resolve(undefined), PATIENCE_MS);
  }).finally(() => worker.terminate());
}
