/** Starts 3-D rendering. */

import type { Graphics } from "../../viewer/stage/graphics";

/** Longest wait for the worker's answer: a graphics process may hang, or an extension may prevent workers from drawing. */
export const PATIENCE_MS = 3000;

/**
 * Waits on another thread until the first WebGL context exists, which would block the page. The page's own contexts are
 * then created at once. Resolves with the kind of renderer, or with `undefined` if workers do not exist, cannot draw,
 * or do not answer in time; the page must then find out itself.
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
