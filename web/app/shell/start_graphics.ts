/** Starts what draws in 3-D. */

import type { Graphics } from "../../viewer/stage/graphics";

/**
 * Waits on a thread of its own until the first WebGL context is there: the page would stand still meanwhile. Its own
 * contexts come at once then. Resolves with what draws, or with nothing where workers cannot draw: the page has to wait and
 * to find out itself.
 */
export function startGraphics(): Promise<Graphics | undefined> {
  const worker = new Worker(new URL("./graphics_worker.ts", import.meta.url), { type: "module", name: "graphics" });
  return new Promise<Graphics | undefined>((resolve) => {
    worker.onmessage = ({ data }: MessageEvent<Graphics>) => resolve(data === "none" ? undefined : data);
    worker.onerror = () => resolve(undefined);
  }).finally(() => worker.terminate());
}
