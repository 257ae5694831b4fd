/** The lessons' own engine in a worker, which starts with the first call. */

import { type ClientPort, RpcClient, remote } from "../rpc";
import workerAddress from "./learn_worker?worker&url";
import type { LearnEngine } from "./protocol";

/** Number of arguments of each call before its options. */
const ARITY = {
  inputs: 0,
  styles: 0,
  database: 0,
  motion: 1,
  counterpart: 2,
  stylize: 2,
  styled: 1,
  classes: 1,
  neighbours: 3,
  profile: 2,
  rowPoses: 1,
  fit: 2,
  sweep: 3,
  timing: 2,
  contacts: 1,
  clips: 1,
  styleSamples: 0,
  somn: 2,
  somnPoses: 2,
  somnErrors: 0,
  dragged: 1,
  stylePose: 2,
  keyed: 1,
  walkPath: 3,
  walk: 2,
  register: 4,
} as const satisfies Record<keyof LearnEngine, number>;

/** An engine with its disposal. */
export type LearnClient = LearnEngine & { dispose(): void };

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
  return { ...remote<LearnEngine>(client, ARITY), dispose: () => client.dispose() };
}
