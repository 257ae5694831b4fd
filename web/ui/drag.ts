/** Dragging with the mouse, a finger or a pen. All drags of the page, except those of the 3-D camera, start here. */

/** Callbacks of one drag. */
export interface Drag {
  /** The pointer moved. */
  move: (event: PointerEvent) => void;
  /** Reverts the changes of the drag; called before {@link end} when the user presses Escape. */
  cancel: () => void;
  /** The drag is over. Called once, whether the pointer was released, lost or taken away by the browser. */
  end: () => void;
}

/** Called at the end of edits that belong together, such as a drag or a run of key presses: they are one undo step. */
export interface GestureListeners {
  /** The gesture is over: the next edit is a step of its own. */
  onSettle: () => void;
  /** The gesture was cancelled: its edits are to be reverted. */
  onCancel: () => void;
}

/**
 * Lets the primary button, a finger or a pen drag `target`, one pointer at a time.
 *
 * `begin` is called with each press and returns the drag that it starts, or `undefined` if there is nothing to drag.
 * The pointer is captured until it is released; Escape cancels the drag. `signal` ends a drag in progress and stops
 * listening.
 */
export function listenToDrags(
  target: HTMLElement | SVGElement,
  begin: (event: PointerEvent) => Drag | undefined,
  signal: AbortSignal = new AbortController().signal,
): void {
  // The union of both element types has no typed pointer events.
  const listen = (type: string, act: (event: PointerEvent) => void, { signal }: { signal: AbortSignal }) =>
    target.addEventListener(type, act as EventListener, { signal });
  let dragging = false;
  const onPress = (press: PointerEvent) => {
    if (press.button !== 0 || dragging) return;
    const drag = begin(press);
    if (!drag) return;
    dragging = true;
    const { pointerId } = press;
    const over = new AbortController();
    const end = () => {
      over.abort();
      dragging = false;
      // Already released unless the drag was cancelled.
      if (target.hasPointerCapture(pointerId)) target.releasePointerCapture(pointerId);
      drag.end();
    };
    const ofThisPointer = (act: (event: PointerEvent) => void) => (event: PointerEvent) => {
      if (event.pointerId === pointerId) act(event);
    };
    listen("pointermove", ofThisPointer(drag.move), over);
    for (const type of ["pointerup", "pointercancel", "lostpointercapture"]) listen(type, ofThisPointer(end), over);
    const onKey = (event: KeyboardEvent) => {
      if (event.key !== "Escape") return;
      // Escape cancels only the drag: a dialog around it stays open.
      event.preventDefault();
      event.stopImmediatePropagation();
      drag.cancel();
      end();
    };
    target.ownerDocument.addEventListener("keydown", onKey, { signal: over.signal, capture: true });
    signal.addEventListener("abort", end, { signal: over.signal });
    target.setPointerCapture(pointerId);
  };
  listen("pointerdown", onPress, { signal });
}
