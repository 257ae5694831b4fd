import { describe, expect, it } from "vitest";
import type { Caller } from "../rpc_server";
import { runToEnd } from "./time_slices";

const caller: Caller = { isCancelled: () => false, report: () => undefined };

/** A job of 300 frames of 0.3 ms each, timed by a clock with a resolution of `stepMs`. */
function timed(stepMs: number) {
  let nowMs = 0.1;
  const slices: number[] = [];
  const job = {
    done: 0,
    frames: 300,
    run(frames: number) {
      const slice = Math.min(frames, job.frames - job.done);
      slices.push(slice);
      job.done += slice;
      nowMs += 0.3 * slice;
      return job.done === job.frames;
    },
  };
  return { job, slices, clock: () => Math.floor(nowMs / stepMs) * stepMs };
}

describe.each([0.005, 1])("by a clock of %d ms steps", (stepMs) => {
  it("tells what a frame costs", async () => {
    const { job, clock } = timed(stepMs);
    expect(await runToEnd(job, caller, clock)).toBeCloseTo(0.3, 1);
  });

  it("answers other calls every few frames, and does not do the whole clip at once", async () => {
    const { job, slices, clock } = timed(stepMs);
    await runToEnd(job, caller, clock);
    // 8 ms are 26 frames; with a coarse clock a frame may look shorter at first.
    expect(Math.max(...slices)).toBeLessThan(100);
  });
});
