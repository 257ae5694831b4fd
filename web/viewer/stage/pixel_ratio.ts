/**
 * Detects a change of the screen's pixel density. A window moved to another screen keeps its size in CSS pixels, so no
 * observer reports it.
 */

/** Calls back whenever the device pixel ratio has changed, until `signal` aborts. */
export function onPixelRatio(call: () => void, signal: AbortSignal): void {
  // A media query matches a single ratio.
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
