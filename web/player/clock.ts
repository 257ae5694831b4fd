/** The time step of playback. */

/** Longest time step: after a stall, or in a tab that was hidden, the motion continues instead of skipping ahead, seconds. */
const LONGEST_STEP_SECS = 0.1;

/** Time step in seconds between two animation frames at the given times in milliseconds. */
export function stepSecs(before: number, now: number): number {
  return Math.min(Math.max(0, (now - before) / 1000), LONGEST_STEP_SECS);
}
