/** Lets the page do what it has to do besides: what takes long is done in tasks of its own. */
export function otherTasks(): Promise<void> {
  return new Promise((resolve) => setTimeout(resolve));
}
