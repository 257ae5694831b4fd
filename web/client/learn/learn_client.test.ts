import { afterEach, expect, it, vi } from "vitest";
import { createLearnClient } from "./learn_client";

afterEach(() => vi.unstubAllGlobals());

it("an engine from another origin is started again by the same script", async () => {
  const started: string[] = [];
  let made = 0;
  /** A worker that fails at the first call. */
  class FailingWorker {
    onmessage = null;
    onerror: ((event: { message: string }) => void) | null = null;
    constructor(address: string) {
      started.push(address);
    }
    postMessage(): void {
      queueMicrotask(() => this.onerror?.({ message: "ended for the test" }));
    }
    terminate(): void {}
  }
  vi.stubGlobal("Worker", FailingWorker);
  vi.stubGlobal("self", { origin: "https://elsewhere.example" });
  vi.stubGlobal(
    "URL",
    class extends URL {
      static override createObjectURL = () => `blob:${++made}`;
    },
  );
  const engine = createLearnClient();
  for (let start = 0; start < 3; start++) await expect(engine.inputs()).rejects.toMatchObject({ code: "load" });
  expect(started).toEqual(["blob:1", "blob:1", "blob:1"]);
  engine.dispose();
});
