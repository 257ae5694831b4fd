/**
 * Makes the browser ask for confirmation before the page is left. It listens only while needed: some browsers do not put pages
 * that listen to `beforeunload` into the back/forward cache.
 */
export class LeaveGuard {
  #listening: AbortController | undefined;

  /** Whether leaving would lose something. */
  set needed(needed: boolean) {
    if (needed === (this.#listening !== undefined)) return;
    this.#listening?.abort();
    this.#listening = needed ? new AbortController() : undefined;
    const signal = this.#listening?.signal;
    if (signal) addEventListener("beforeunload", (event) => event.preventDefault(), { signal });
  }
}
