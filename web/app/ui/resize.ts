/** Observes the sizes of elements. */

/** Calls back with the present size of an element and after every change of it, until `signal` aborts. */
export function onResize(element: Element, callback: () => void, signal: AbortSignal): void {
  const observer = new ResizeObserver(callback);
  observer.observe(element);
  signal.addEventListener("abort", () => observer.disconnect(), { once: true });
}
