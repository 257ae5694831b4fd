/** The lessons' own engine in a worker, which starts with the first call. */

import { type ClientPort, RpcClient, remote } from "../rpc";
import workerAddress from "./learn_worker?worker&url";
import type { LearnEngine } from "./protocol";

/** An engine with its disposal. */
type LearnClient = LearnEngine & { dispose(): void };

function spawnWorker(): ClientPort {
  const address = new URL(workerAddress, import.meta.url);
  const options = { type: "module", name: "strut learn" } as const;
  if (address.origin === self.origin) return new Worker(address, options);
  // A page may start workers of its own origin only; such a worker may import Strut's script.
  const text = `import ${JSON.stringify(address.href)};`;
  script ??= URL.createObjectURL(new Blob([text], { type: "text/javascript" }));
  return new Worker(script, options);
}

/** URL of that script, used for every start of the engine. */
let script: string | undefined;

/** Creates an engine. @param spawn starts the worker */
export function createLearnClient(spawn: () => ClientPort = spawnWorker): LearnClient {
  const client = new RpcClient(spawn, "engine of the lessons");
  return remote<LearnEngine, { dispose(): void }>(client, { dispose: () => client.dispose() });
}
