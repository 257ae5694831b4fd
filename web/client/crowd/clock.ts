/** The time that a crowd is shown by; tests have one of their own. */
export interface Clock {
  /** Milliseconds. */
  now(): number;
  /** Calls back after so many milliseconds. @returns what ends it */
  after(ms: number, call: () => void): () => void;
}

/** The page's time, in which nothing is due while the page is hidden. */
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
