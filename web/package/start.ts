/** Starts the engine of a page: in a worker; where that is forbidden in one from a blob; else on the page's thread. */
import type { BuildWorkerPort } from "../client/build/client";
import type { WorkerPort } from "../client/connection";
import { download } from "../engine/download";
import { cancelled, type ErrorParts, StrutError } from "../engine/errors";
import { type Boot, type FileRequest, STARTED } from "./boot";
import { LocalPort, structuredCopy } from "./local_port";
import type { Thread } from "./types";

/** A way to start the engine that works on this page. */
export interface Started {
  thread: Thread;
  /** Starts an engine; the first time it is the one that was tried. */
  spawn: () => WorkerPort;
  /** Starts what builds databases and trains models. */
  spawnBuild: () => BuildWorkerPort;
}

/** What differs between the package's entries. */
export interface Entry {
  /** Address of the worker's script; `undefined` where it has none. */
  workerUrl: string | undefined;
  /** The text of the worker's script. */
  workerText: () => Promise<string>;
  /** Address of the script of the worker that builds. */
  buildWorkerUrl: string;
  /** What serves on the page's thread, loaded when it is needed. */
  servers: () => Promise<Servers>;
  boot: Boot;
}

/** What serves on the calling thread. */
export type Servers = typeof import("./servers");

/**
 * Starts the engine in the first way that works.
 * @param worker whether workers are tried
 * @throws StrutError `cancelled`, or `load` if nothing works
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
      spawnBuild: () => spawnBooted(buildUrl, boot) as BuildWorkerPort,
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
  hint: "Check that assets/ lies beside the package's code, and the page's Content-Security-Policy.",
};

/** The ways to start a worker, the best first. */
function workersOf({ workerUrl, workerText }: Entry): { thread: Thread; address: () => Promise<string> }[] {
  return [
    ...(workerUrl === undefined ? [] : [{ thread: "worker" as const, address: async () => workerUrl }]),
    { thread: "blob", address: async () => blobOf(await workerText()) },
  ];
}

/** The address of a script with this text: one for each, as it is needed as long as workers may be started again. */
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

/** Tells a worker where the files lie, and lends it the page's right to fetch them. */
function sendBoot(worker: Worker, boot: Boot): void {
  const { port1, port2 } = new MessageChannel();
  const known = Object.values(boot.assets);
  port1.onmessage = async ({ data: [address, answer] }: MessageEvent<FileRequest>) => {
    const bytes = known.includes(address) ? await bytesAt(address).catch(() => null) : null;
    answer.postMessage(bytes, bytes ? [bytes] : []);
  };
  worker.postMessage({ ...boot, files: port2 } satisfies Boot, [port2]);
}

/** @throws StrutError `load` if the file cannot be had */
async function bytesAt(address: string): Promise<ArrayBuffer> {
  return (await download(new URL(address), "engine")).arrayBuffer();
}

/** Gives the first, then what `next` starts. */
function onceThen(first: WorkerPort, next: () => WorkerPort): () => WorkerPort {
  let unused: WorkerPort | undefined = first;
  return () => {
    const port = unused ?? next();
    unused = undefined;
    return port;
  };
}

/**
 * A worker whose script has begun to run; `undefined` where the browser refuses it or the script cannot be had.
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
    // A script that never answers must not keep who has given up.
    signal?.addEventListener("abort", cancel, { once: true });
    worker.onmessage = ({ data }) => {
      if (data !== STARTED) return;
      settle(worker as WorkerPort);
      sendBoot(worker, boot);
      resolve(worker as WorkerPort);
    };
    worker.onerror = (event) => {
      // The page's console need not hear of what is then tried in another way.
      event.preventDefault();
      settle(undefined);
      resolve(undefined);
    };
  });
}

/** The part of the Trusted Types API that is used; TypeScript's library does not have it yet. */
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

/** The address of a script as the page's policy `strut-motion` allows it. @throws where the page allows no such policy */
export function trusted(url: string): string | TrustedScriptURL {
  const { trustedTypes } = globalThis as { trustedTypes?: TrustedTypes };
  if (!trustedTypes) return url;
  policy ??= trustedTypes.createPolicy("strut-motion", { createScriptURL: (address) => address });
  return policy.createScriptURL(url);
}
