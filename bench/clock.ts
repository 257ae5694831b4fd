/** Time measurement with the rounded clock of browsers. */

/** Returns the smallest observable step of `performance.now()`, milliseconds. */
export function clockResolution(): number {
  let least = Infinity;
  for (let i = 0; i < 20; i++) {
    const start = performance.now();
    let now = start;
    while (now === start) now = performance.now();
    least = Math.min(least, now - start);
  }
  return least;
}

/** Smallest number of clock steps per sample, so that rounding is at most 5 %. */
const STEPS = 20;

/** Returns how many frames of about `frameMs` are measured together: one if the clock is fine enough. */
export function batchFor(frameMs: number, resolutionMs: number): number {
  return Math.max(1, Math.ceil((STEPS * resolutionMs) / Math.max(frameMs, 1e-4)));
}

/** Returns the duration of some work, milliseconds. */
export function timed(work: () => void): number {
  const started = performance.now();
  work();
  return performance.now() - started;
}

/** Returns the duration of a call, milliseconds. It is repeated until the clock is accurate enough. */
export function timedOften(work: () => void, resolutionMs: number): number {
  const started = performance.now();
  let calls = 0;
  let elapsed = 0;
  do {
    work();
    calls++;
    elapsed = performance.now() - started;
  } while (elapsed < STEPS * resolutionMs);
  return elapsed / calls;
}
