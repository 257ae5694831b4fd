/** Splits long work into tasks, between which the browser can do other work. */

/** Duration of one task, milliseconds; a step may take longer. */
const SLICE_MS = 8;

/** Yields to the browser: to start workers, paint, and handle input. */
export function otherTasks(): Promise<void> {
  return new Promise((resolve) => setTimeout(resolve));
}

/** Runs the steps of long work. */
export async function inSlices(steps: Iterable<unknown>): Promise<void> {
  await otherTasks();
  let began = performance.now();
  for (const _ of steps) {
    if (performance.now() - began < SLICE_MS) continue;
    await otherTasks();
    began = performance.now();
  }
  await otherTasks();
}
