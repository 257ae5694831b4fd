/** What all entries of the package do to load the engine. */
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
  // Walk and key-style models are on this thread.
  placeBooted(boot);
  const client = new EngineClient(spawners);
  const aborted = new Promise<never>((_, reject) => {
    signal?.addEventListener("abort", () => reject(cancelled(signal.reason)), { once: true });
  });
  try {
    await Promise.race([client.ready(), aborted]);
  } catch (thrown) {
    client.dispose();
    throw thrown;
  }
  return new StrutEngine(client, thread);
}
