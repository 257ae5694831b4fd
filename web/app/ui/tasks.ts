/** Long work in several tasks, between which the browser does what else there is to do. */

/** What runs in one task, milliseconds; a step may take longer. */
const SLICE_MS = 8;

/** Lets the browser do what else there is to do: start workers, paint, take input. */
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
