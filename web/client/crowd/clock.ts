/** Clock of a crowd's display; tests use their own. */
export interface Clock {
  /** Milliseconds. */
  now(): number;
  /** Calls back after `ms` milliseconds. @returns a function that cancels it */
  after(ms: number, call: () => void): () => void;
}

/** The page's clock. Callbacks do not run while the page is hidden. */
export const PAGE_CLOCK: Clock = {
  now: () => performance.now(),
  after(ms, call) {
    const waiting = new AbortController();
    const act = () => {
      waiting.abort();
      call();
    };
    const timer = setTimeout(() => {
      if (!globalThis.document?.hidden) return act();
      document.addEventListener("visibilitychange", () => !document.hidden && act(), { signal: waiting.signal });
    }, ms);
    return () => {
      clearTimeout(timer);
      waiting.abort();
    };
  },
};
