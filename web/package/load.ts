/** What all entries of the package do to load the engine. */
import type { WorkerPort } from "../client/connection";
import { EngineClient } from "../client/engine_client";
import { cancelled } from "../engine/errors";
import { StrutEngine } from "./strut";
import type { Strut, Thread } from "./types";

/**
 * Loads the engine that `spawn` starts.
 * @throws StrutError `load`, `unsupported` or `cancelled`
 */
export async function loadEngine(thread: Thread, spawn: () => WorkerPort, signal?: AbortSignal): Promise<Strut> {
  const client = new EngineClient({ spawn });
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
