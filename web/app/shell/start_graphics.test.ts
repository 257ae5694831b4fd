import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { PATIENCE_MS, startGraphics } from "./start_graphics";

beforeEach(() => void vi.useFakeTimers());
afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

/** Fake workers that answer as the test specifies. */
function workersThat(answer: (worker: { onmessage?: (event: { data: unknown }) => void }) => void) {
  const terminate = vi.fn();
  vi.stubGlobal(
    "Worker",
    class {
      terminate = terminate;
      constructor() {
        answer(this as never);
      }
    },
  );
  return terminate;
}

describe("what draws", () => {
  it("is what the worker says", async () => {
    const terminate = workersThat((worker) => setTimeout(() => worker.onmessage?.({ data: "hardware" }), 10));
    const detected = startGraphics();
    await vi.advanceTimersByTimeAsync(10);
    expect(await detected).toBe("hardware");
    expect(terminate).toHaveBeenCalledOnce();
  });

  it("is found out by the page where the worker does not answer in time", async () => {
    const terminate = workersThat(() => {});
    const detected = startGraphics();
    await vi.advanceTimersByTimeAsync(PATIENCE_MS);
    expect(await detected).toBeUndefined();
    expect(terminate).toHaveBeenCalledOnce();
  });

  it("is found out by the page where there are no workers", async () => {
    workersThat(() => {
      throw new Error("blocked");
    });
    expect(await startGraphics()).toBeUndefined();
  });
});
