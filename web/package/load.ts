/** Loading of the engine, shared by all entries of the package. */
import { EngineClient } from "../client/engine_client";
import { cancelled } from "../engine/errors";
import { type Boot, placeBooted } from "./boot";
import type { Started } from "./start";
import { StrutEngine } from "./strut";
import type { Strut } from "./types";

/**
 * Loads an engine that was started, with the files of `boot`.
 * @throws StrutError `load`, `unsupported` or `cancelled`
 */
export async function loadEngine(boot: Boot, { thread, ...spawners }: Started, signal?: AbortSignal): Promise<Strut> {
  // Walk and key-style models run on this thread.
  placeBooted(boot);
  const client = new EngineClient(spawners);
  let stop = () => {};
  const aborted = new Promise<never>((_, reject) => {
    stop = () => reject(cancelled(signal?.reason));
    signal?.addEventListener("abort", stop, { once: true });
  });
  try {
    // It may have been aborted before the listener was added.
    if (signal?.aborted) throw cancelled(signal.reason);
    await Promise.race([client.ready(), aborted]);
  } catch (thrown) {
    client.dispose();
    throw thrown;
  } finally {
    signal?.removeEventListener("abort", stop);
  }
  return new StrutEngine(client, thread);
}
