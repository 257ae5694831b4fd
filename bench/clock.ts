/** Measuring with a clock that browsers round. */

/** The least step of `performance.now()` that can be seen, milliseconds. */
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

/** Steps of the clock that a sample takes at least, so that rounding is 5 % of it at most. */
const STEPS = 20;

/** Frames that are measured together when one takes about `frameMs`: a single one where the clock is fine enough. */
export function batchFor(frameMs: number, resolutionMs: number): number {
  return Math.max(1, Math.ceil((STEPS * resolutionMs) / Math.max(frameMs, 1e-4)));
}

/** Milliseconds that something takes. */
export function timed(work: () => void): number {
  const started = performance.now();
  work();
  return performance.now() - started;
}

/** Milliseconds that a call takes; it is repeated until the clock can tell. */
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
