/** Starts the engine of a page: in a worker; if that is forbidden, in a worker from a blob; otherwise on the page's thread. */
import type { WorkerPort } from "../client/rpc";
import { download } from "../engine/download";
import { cancelled, type ErrorParts, StrutError } from "../engine/errors";
import { type Boot, type FileRequest, STARTED } from "./boot";
import { LocalPort, structuredCopy } from "./local_port";
import type { Thread } from "./types";

/** A method of starting the engine that works on this page. */
export interface Started {
  thread: Thread;
  /** Starts an engine; the first time it returns the one that was tried. */
  spawn: () => WorkerPort;
  /** Starts the worker that builds databases and trains models. */
  spawnBuild: () => WorkerPort;
}

/** Properties that differ between the package's entries. */
export interface Entry {
  /** URL of the worker's script; `undefined` if it has none. */
  workerUrl: string | undefined;
  /** The text of the worker's script. */
  workerText: () => Promise<string>;
  /** URL of the build worker's script. */
  buildWorkerUrl: string;
  /** The servers on the page's thread, loaded on demand. */
  servers: () => Promise<Servers>;
  boot: Boot;
}

/** The servers on the calling thread. */
export type Servers = typeof import("./servers");

/**
 * Starts the engine with the first method that works.
 * @param worker whether workers are tried
 * @throws StrutError `cancelled`, or `load` if no method works
 */
export async function startEngine(entry: Entry, worker: boolean, signal?: AbortSignal): Promise<Started> {
  const { boot, buildWorkerUrl } = entry;
  for (const { thread, address } of worker && typeof Worker === "function" ? workersOf(entry) : []) {
    if (signal?.aborted) throw cancelled(signal.reason);
    const url = await address()
      .then(trusted)
      .catch(() => undefined);
    const first = url === undefined ? undefined : await tryWorker(url, boot, signal);
    if (!first || url === undefined) continue;
    const buildUrl = trusted(
      thread === "worker" ? buildWorkerUrl : blobOf(`importScripts(${JSON.stringify(buildWorkerUrl)})`),
    );
    return {
      thread,
      spawn: onceThen(first, () => spawnBooted(url, boot) as WorkerPort),
      spawnBuild: () => spawnBooted(buildUrl, boot) as WorkerPort,
    };
  }
  if (signal?.aborted) throw cancelled(signal.reason);
  const servers = await entry.servers().catch((cause) => {
    throw new StrutError(NOTHING_WORKS, cause);
  });
  return { thread: "page", ...localPorts(servers) };
}

/** The servers on the calling thread. */
export function localPorts({ serve, serveBuilds }: Servers): Pick<Started, "spawn" | "spawnBuild"> {
  return {
    spawn: () => new LocalPort((port) => void serve(port), structuredCopy),
    spawnBuild: () => new LocalPort(serveBuilds),
  };
}

const NOTHING_WORKS: ErrorParts = {
  code: "load",
  message: "The engine could not be started: neither in a worker nor on the page.",
  hint: "Check that assets/ is next to the package's code, and check the page's Content-Security-Policy.",
};

/** The methods of starting a worker, the best first. */
function workersOf({ workerUrl, workerText }: Entry): { thread: Thread; address: () => Promise<string> }[] {
  return [
    ...(workerUrl === undefined ? [] : [{ thread: "worker" as const, address: async () => workerUrl }]),
    { thread: "blob", address: async () => blobOf(await workerText()) },
  ];
}

/** The URL of a script with this text: one per text, since workers may be started again later. */
function blobOf(text: string): string {
  const known = blobs.get(text) ?? URL.createObjectURL(new Blob([text], { type: "text/javascript" }));
  blobs.set(text, known);
  return known;
}
const blobs = new Map<string, string>();

function spawnBooted(url: string | TrustedScriptURL, boot: Boot): Worker {
  const worker = new Worker(url as string, { name: "strut-motion" });
  sendBoot(worker, boot);
  return worker;
}

/** Sends a worker the locations of the files, and a port through which the page fetches files for it. */
function sendBoot(worker: Worker, boot: Boot): void {
  const { port1, port2 } = new MessageChannel();
  const known = Object.values(boot.assets);
  port1.onmessage = async ({ data: [address, answer] }: MessageEvent<FileRequest>) => {
    const bytes = known.includes(address) ? await bytesAt(address).catch(() => null) : null;
    answer.postMessage(bytes, bytes ? [bytes] : []);
  };
  worker.postMessage({ ...boot, files: port2 } satisfies Boot, [port2]);
}

/** @throws StrutError `load` if the file cannot be loaded */
async function bytesAt(address: string): Promise<ArrayBuffer> {
  return (await download(new URL(address), "engine")).arrayBuffer();
}

/** Returns the first worker once, then those that `next` starts. */
function onceThen(first: WorkerPort, next: () => WorkerPort): () => WorkerPort {
  let unused: WorkerPort | undefined = first;
  return () => {
    const port = unused ?? next();
    unused = undefined;
    return port;
  };
}

/**
 * A worker whose script has started to run; `undefined` if the browser refuses it or the script cannot be loaded.
 * @throws StrutError `cancelled`
 */
function tryWorker(
  url: string | TrustedScriptURL,
  boot: Boot,
  signal: AbortSignal | undefined,
): Promise<WorkerPort | undefined> {
  let worker: Worker;
  try {
    worker = new Worker(url as string, { name: "strut-motion" });
  } catch {
    return Promise.resolve(undefined);
  }
  return new Promise((resolve, reject) => {
    const settle = (port: WorkerPort | undefined) => {
      [worker.onmessage, worker.onerror] = [null, null];
      signal?.removeEventListener("abort", cancel);
      if (!port) worker.terminate();
    };
    const cancel = () => {
      settle(undefined);
      reject(cancelled(signal?.reason));
    };
    // A script that never answers must not delay a cancelled call.
    signal?.addEventListener("abort", cancel, { once: true });
    worker.onmessage = ({ data }) => {
      if (data !== STARTED) return;
      settle(worker as WorkerPort);
      sendBoot(worker, boot);
      resolve(worker as WorkerPort);
    };
    worker.onerror = (event) => {
      // Another method will be tried, so the error must not appear in the page's console.
      event.preventDefault();
      settle(undefined);
      resolve(undefined);
    };
  });
}

/** The part of the Trusted Types API that is used; it is not in TypeScript's library yet. */
interface TrustedScriptURL {
  toString(): string;
}
interface TrustedTypes {
  createPolicy(
    name: string,
    rules: { createScriptURL: (url: string) => string },
  ): {
    createScriptURL(url: string): TrustedScriptURL;
  };
}

let policy: ReturnType<TrustedTypes["createPolicy"]> | undefined;

/** The URL of a script, approved by the page's policy `strut-motion`. @throws if the page allows no such policy */
export function trusted(url: string): string | TrustedScriptURL {
  const { trustedTypes } = globalThis as { trustedTypes?: TrustedTypes };
  if (!trustedTypes) return url;
  policy ??= trustedTypes.createPolicy("strut-motion", { createScriptURL: (address) => address });
  return policy.createScriptURL(url);
}
