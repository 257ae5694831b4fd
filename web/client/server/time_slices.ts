/** Long work in time slices, so that the worker answers other calls in between. */
import { cancelled } from "../../engine/errors";
import type { Caller } from "../rpc_server";

/** Duration of a time slice: half a display frame. */
const SLICE_MS = 8;

/** Lets pending messages, such as a cancellation, be handled. */
export function otherMessages(): Promise<void> {
  return new Promise((resolve) => {
    // A timer would wait 4 ms each time.
    const { port1, port2 } = new MessageChannel();
    port1.onmessage = () => {
      port1.close();
      resolve();
    };
    port2.postMessage(undefined);
  });
}

/**
 * Reports a stage and lets a pending cancellation take effect.
 * @throws StrutError `cancelled`
 */
export async function stage(caller: Caller, label: string, fraction: number): Promise<void> {
  caller.report({ label, fraction });
  await otherMessages();
  if (caller.isCancelled()) throw cancelled();
}

/** Work on frames, one after another. */
interface Job {
  readonly done: number;
  readonly frames: number;
  /** Does up to `frames` more frames. Returns true once all are done. */
  run(frames: number): boolean;
}

/**
 * Runs a job to its end and returns the mean cost of a frame, milliseconds. Some browsers' clocks have a resolution of
 * whole milliseconds, which is longer than a frame, so most single measurements are 0.
 * @param nowMs a clock
 * @throws StrutError `cancelled`
 */
export async function runToEnd(job: Job, caller: Caller, nowMs = () => performance.now()): Promise<number> {
  const before = job.done;
  let [frames, spentMs] = [1, 0];
  for (;;) {
    const started = nowMs();
    const ended = job.run(frames);
    spentMs += nowMs() - started;
    const frameMs = spentMs / Math.max(1, job.done - before);
    if (ended) return frameMs;
    // At most doubled: the cost of a frame is unknown until the clock has advanced.
    frames = Math.max(1, Math.min(2 * frames, Math.floor(SLICE_MS / frameMs)));
    await stage(caller, "Styling the clip", job.done / job.frames);
  }
}
