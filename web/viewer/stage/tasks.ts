/** Yields to other tasks of the page: long work is split into tasks. */
export function otherTasks(): Promise<void> {
  return new Promise((resolve) => setTimeout(resolve));
}
