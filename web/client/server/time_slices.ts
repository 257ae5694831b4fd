/** Long work in time slices, so that the worker answers other calls in between. */
import { cancelled } from "../../engine/errors";
import type { Progress } from "../protocol";

/** Duration of a time slice: half a display frame. */
const SLICE_MS = 8;

/** The caller of long work: its cancellation and its progress. */
export interface Caller {
  /** Whether the answer is no longer wanted. */
  isCancelled(): boolean;
  report(progress: Progress): void;
}

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
  /** Does up to so many more frames; true once all are done. */
  run(frames: number): boolean;
}

/**
 * Runs a job to its end and gives the median cost of a frame, milliseconds.
 * @throws StrutError `cancelled`
 */
export async function runToEnd(job: Job, caller: Caller): Promise<number> {
  let frames = 1;
  const costsMs: number[] = [];
  for (;;) {
    const before = job.done;
    const started = performance.now();
    const ended = job.run(frames);
    const frameMs = (performance.now() - started) / (job.done - before);
    if (ended) return median(costsMs.length > 0 ? costsMs : [frameMs]);
    costsMs.push(frameMs);
    frames = Math.max(1, Math.floor(SLICE_MS / Math.max(frameMs, 0.01)));
    await stage(caller, "Styling the clip", job.done / job.frames);
  }
}

/** The median of some values; 0 if there are none. */
export function median(values: readonly number[]): number {
  const sorted = values.toSorted((a, b) => a - b);
  return sorted[sorted.length >> 1] ?? 0;
}
