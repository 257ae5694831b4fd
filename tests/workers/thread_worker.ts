/**
 * Real workers for tests in Node: the worker's code in one file, run in threads, each with its own instance of the
 * engine.
 */
import { mkdtempSync, symlinkSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { Worker } from "node:worker_threads";
import { build } from "vite";
import type { Reply, Request, WorkerPort } from "../../web/client/rpc";
import { root } from "../recordings";

/** Builds the worker's code and returns its path. */
export async function buildWorker(): Promise<string> {
  const outDir = mkdtempSync(join(tmpdir(), "strut-worker-"));
  const ssr = join(root, "tests", "workers", "entry.ts");
  const target = "node20";
  await build({ configFile: false, publicDir: false, logLevel: "error", build: { ssr, outDir, target } });
  // The engine finds its files next to its code.
  for (const folder of ["pkg", "motions"]) symlinkSync(join(root, "web", "engine", folder), join(outDir, folder));
  return join(outDir, "entry.js");
}

export class ThreadWorker implements WorkerPort {
  onmessage: ((event: MessageEvent<Reply>) => void) | null = null;
  onerror: ((event: ErrorEvent) => void) | null = null;
  private readonly thread: Worker;

  /** @param path see {@link buildWorker} */
  constructor(path: string) {
    this.thread = new Worker(path);
    this.thread.on("message", (data: Reply) => this.onmessage?.({ data } as MessageEvent<Reply>));
    this.thread.on("error", ({ message }) => this.onerror?.({ message } as ErrorEvent));
  }

  postMessage(message: Request): void {
    this.thread.postMessage(message);
  }

  terminate(): void {
    void this.thread.terminate();
  }

  /** Ends the thread as an operating system without memory does: without notice. */
  async kill(): Promise<void> {
    await this.thread.terminate();
  }
}
