/** The lessons' own engine in a worker, which starts with the first call. */
import type { LearnEngine } from "./protocol";
import { type ClientPort, RpcClient, remote } from "./rpc";

/** How many arguments each call has before its options. */
const ARITY = { inputs: 0, styles: 0, motion: 1, counterpart: 2 } as const satisfies Record<keyof LearnEngine, number>;

/** An engine, and its end. */
export type LearnClient = LearnEngine & { dispose(): void };

const spawnWorker = (): ClientPort =>
  new Worker(new URL("./learn_worker.ts", import.meta.url), { type: "module", name: "strut learn" });

/** Makes an engine. @param spawn starts the worker */
export function createLearnClient(spawn: () => ClientPort = spawnWorker): LearnClient {
  const client = new RpcClient(spawn);
  return { ...remote<LearnEngine>(client, ARITY), dispose: () => client.dispose() };
}
