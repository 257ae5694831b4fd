/** Observes the sizes of elements. */

/** Calls back with an element's current size and after every change, until `signal` aborts. */
export function onResize(element: Element, callback: () => void, signal: AbortSignal): void {
  const observer = new ResizeObserver(callback);
  observer.observe(element);
  signal.addEventListener("abort", () => observer.disconnect(), { once: true });
}
