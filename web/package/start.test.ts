import { afterEach, expect, test, vi } from "vitest";
import { EngineClient } from "../client/engine_client";
import type { WorkerPort } from "../client/rpc";
import { type Boot, STARTED } from "./boot";
import { loadEngine } from "./load";
import { type Entry, type Started, startEngine } from "./start";

afterEach(() => vi.unstubAllGlobals());

let ended = 0;

/** A worker whose script never answers. */
class Silent implements WorkerPort {
  onmessage: WorkerPort["onmessage"] = null;
  onerror: WorkerPort["onerror"] = null;
  postMessage(): void {}
  terminate(): void {
    ended += 1;
  }
}

const BOOT = { assets: {} } as unknown as Boot;

test("a call that is given up while a worker's script says nothing is rejected, and its worker is ended", async () => {
  ended = 0;
  vi.stubGlobal("Worker", Silent);
  const entry: Entry = {
    workerUrl: "https://example.org/worker.js",
    workerText: async () => "",
    buildWorkerUrl: "",
    servers: () => Promise.reject(new Error("never")),
    boot: BOOT,
  };
  const abort = new AbortController();
  const started = startEngine(entry, true, abort.signal);
  const outcome = expect(started).rejects.toMatchObject({ code: "cancelled" });
  setTimeout(() => abort.abort(), 10);
  await outcome;
  expect(ended).toBe(1);
});

test("a call that was given up before the engine is waited for is rejected, and leaves no worker", async () => {
  const disposing = vi.spyOn(EngineClient.prototype, "dispose");
  const started = { thread: "worker", spawn: () => new Silent(), spawnBuild: () => new Silent() } as unknown as Started;
  await expect(loadEngine(BOOT, started, AbortSignal.abort())).rejects.toMatchObject({ code: "cancelled" });
  expect(disposing).toHaveBeenCalledTimes(1);
  disposing.mockRestore();
});

test("workers from a blob share one script, however often an engine is loaded", async () => {
  /** A worker whose script runs at once. */
  class Prompt extends Silent {
    constructor() {
      super();
      queueMicrotask(() => this.onmessage?.({ data: STARTED } as never));
    }
  }
  const create = vi.spyOn(URL, "createObjectURL").mockReturnValue("blob:script");
  vi.stubGlobal("Worker", Prompt);
  const entry: Entry = {
    workerUrl: undefined,
    workerText: async () => "the script of the engine",
    buildWorkerUrl: "https://example.org/build.js",
    servers: () => Promise.reject(new Error("never")),
    boot: BOOT,
  };
  for (let load = 0; load < 3; load++) expect(await startEngine(entry, true)).toMatchObject({ thread: "blob" });
  // The script of the engine, and that of builds.
  expect(create).toHaveBeenCalledTimes(2);
  create.mockRestore();
});
