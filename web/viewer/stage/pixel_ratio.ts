/** Screens of other densities: a window that is moved to one keeps its size in CSS pixels, and no observer tells of it. */

/** Calls back whenever the pixels of the screen per CSS pixel have changed, until `signal` aborts. */
export function onPixelRatio(call: () => void, signal: AbortSignal): void {
  // A query is about one ratio.
  const watch = () => {
    if (signal.aborted) return;
    matchMedia(`(resolution: ${devicePixelRatio}dppx)`).addEventListener(
      "change",
      () => {
        call();
        watch();
      },
      { once: true, signal },
    );
  };
  watch();
}
