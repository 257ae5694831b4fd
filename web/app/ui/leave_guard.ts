/**
 * Has the browser ask before the page is left. It listens only while that is needed: a page that always listens to
 * `beforeunload` is kept out of some browsers' back-forward cache.
 */
export class LeaveGuard {
  #listening: AbortController | undefined;

  /** Whether something would be lost. */
  set needed(needed: boolean) {
    if (needed === (this.#listening !== undefined)) return;
    this.#listening?.abort();
    this.#listening = needed ? new AbortController() : undefined;
    const signal = this.#listening?.signal;
    if (signal) addEventListener("beforeunload", (event) => event.preventDefault(), { signal });
  }
}
