/** The Compare view's own engine, beside the one that plays: training a method does not hold that up. */
import { createStrutClient } from "../client";
import type { StrutClient } from "../protocol";

/** A method is trained in one piece, which may take longer than anything that the engine does otherwise. */
const SILENCE_MS = 300_000;

/** Starts a worker whose engine has every method, kd-trees, and the counterparts of the built-in inputs. */
export function createCompareClient(): Promise<StrutClient> {
  const spawn = () =>
    new Worker(new URL("./compare_worker.ts", import.meta.url), { type: "module", name: "strut compare" });
  return createStrutClient({ spawn, preload: "built-in", patience: { silenceMs: SILENCE_MS } });
}
