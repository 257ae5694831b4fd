/** The Compare view's own engine, separate from the one that plays, so that training a method does not block playback. */
import type { StrutClient } from "../client";
import { createStrutClient } from "../client";

/** A method is trained in one call, which may take longer than all other calls of the engine. */
const SILENCE_MS = 300_000;

/** Starts a worker whose engine has all methods, kd-trees, and the counterparts of the built-in inputs. */
export function createCompareClient(): Promise<StrutClient> {
  const spawn = () =>
    new Worker(new URL("./compare_worker.ts", import.meta.url), { type: "module", name: "strut compare" });
  return createStrutClient({ spawn, preload: "built-in", patience: { silenceMs: SILENCE_MS } });
}
