/** The lessons' own engine in a worker, which starts with the first call. */

import type { WorkerPort } from "../rpc";
import { RpcClient, remote } from "../rpc_client";
import workerAddress from "./learn_worker?worker&url";
import type { LearnEngine } from "./protocol";

/** An engine with its disposal. */
type LearnClient = LearnEngine & { dispose(): void };

function spawnWorker(): WorkerPort {
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
export function createLearnClient(spawn: () => WorkerPort = spawnWorker): LearnClient {
  const client = new RpcClient<LearnEngine>(spawn, "engine of the lessons");
  return remote(client, { dispose: () => client.dispose() });
}
