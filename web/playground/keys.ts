/** The keys of the whole page. What has the focus goes first: a slider keeps its arrows, a text field its letters. */

export interface KeyActions {
  play(): void;
  frame(by: number): void;
  first(): void;
  last(): void;
  loop(): void;
  ghost(): void;
  trace(): void;
  follow(): void;
  panels(): void;
  /** The other of two settings. */
  other(): void;
  random(): void;
  /** A key of the style track at the playhead. */
  key(): void;
  /** The range begins, or ends, at the playhead, or there is none. */
  rangeFirst(): void;
  rangeLast(): void;
  noRange(): void;
  /** All of the style with this number, from 1. */
  style(number: number): void;
  help(): void;
  undo(): void;
  redo(): void;
}

/** Whether the element wants keys such as arrows, Home and letters for itself. */
function wantsKeys(element: Element | null): boolean {
  return element?.matches("input:not([type=checkbox]), select, textarea, [contenteditable]") ?? false;
}

/** Whether Space is the element's own. */
function takesSpace(element: Element | null): boolean {
  return element?.matches("button, a, select, [role=button], input[type=text], input[type=radio]") ?? false;
}

/** Listens to the page's keys until the signal aborts; while `active` is false to none but those of help and undo. */
export function listenToKeys(actions: KeyActions, active: () => boolean, signal: AbortSignal): void {
  const plain: Readonly<Record<string, () => void>> = {
    ArrowLeft: () => actions.frame(-1),
    ArrowRight: () => actions.frame(1),
    Home: actions.first,
    End: actions.last,
    l: actions.loop,
    g: actions.ghost,
    t: actions.trace,
    f: actions.follow,
    h: actions.panels,
    x: actions.other,
    r: actions.random,
    k: actions.key,
    i: actions.rangeFirst,
    o: actions.rangeLast,
    u: actions.noRange,
    "?": actions.help,
  };
  const onKeyDown = (event: KeyboardEvent): void => {
    if (event.defaultPrevented || document.querySelector("dialog[open]")) return;
    const focused = document.activeElement;
    if ((event.ctrlKey || event.metaKey) && !event.altKey) {
      const key = event.key.toLowerCase();
      if (focused?.matches("input[type=text]")) return;
      if (key === "z") (event.shiftKey ? actions.redo : actions.undo)();
      else if (key === "y") actions.redo();
      else return;
      event.preventDefault();
      return;
    }
    if (event.altKey) return;
    if (!active() && event.key !== "?") return;
    if (event.key === " ") {
      if (takesSpace(focused)) return;
      event.preventDefault();
      if (!event.repeat) actions.play();
      return;
    }
    if (wantsKeys(focused)) return;
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const action = plain[key] ?? (/^[1-9]$/.test(key) ? () => actions.style(Number(key)) : undefined);
    if (!action) return;
    event.preventDefault();
    action();
  };
  // What was pressed with the pointer gives the keys back to the page: Space plays, it does not press again.
  const onClick = (event: MouseEvent): void => {
    const focused = document.activeElement;
    if (event.detail === 0 || !focused?.matches("button, a, input[type=radio], [role=button]")) return;
    if (focused instanceof HTMLElement || focused instanceof SVGElement) focused.blur();
  };
  addEventListener("keydown", onKeyDown, { signal });
  addEventListener("click", onClick, { signal });
}
