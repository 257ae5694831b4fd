/** Lets the browser do what else there is to do: start workers, paint, take input. */
export function otherTasks(): Promise<void> {
  return new Promise((resolve) => setTimeout(resolve));
}
