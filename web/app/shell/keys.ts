/** Keyboard shortcuts of the page and of the view that is shown. The focused control has precedence. */
import type { KeyTable } from "../view";

export interface PageKeys {
  undo(): void;
  redo(): void;
  help(): void;
  /** The keys of the view that is shown. */
  view(): KeyTable | undefined;
  /** Whether single-character shortcuts are on; Space is not one of them. */
  singleKeys(): boolean;
}

/** Whether the element handles arrows, Home and letters itself. */
function wantsKeys(element: Element | null): boolean {
  return element?.matches("input:not([type=checkbox]), select, textarea, [contenteditable]") ?? false;
}

/** Whether the element handles Space itself. */
function takesSpace(element: Element | null): boolean {
  return element?.matches("button, a, select, summary, [role=button], input[type=text], input[type=radio]") ?? false;
}

/** Listens to the page's keys until the signal aborts. */
export function listenToKeys(keys: PageKeys, signal: AbortSignal): void {
  const onKeyDown = (event: KeyboardEvent): void => {
    if (event.defaultPrevented || document.querySelector("dialog[open]")) return;
    const action = actionOf(event, document.activeElement, keys);
    if (!action) return;
    event.preventDefault();
    // Key repeat would toggle playback again and again.
    if (event.key !== " " || !event.repeat) action();
  };
  // A control that was clicked loses the focus, so that Space plays instead of clicking it again, as does the picture, so that
  // arrows step through the frames. Who comes there by Tab turns the camera with them.
  const onClick = (event: MouseEvent): void => {
    const focused = document.activeElement;
    if (event.detail === 0 || !focused?.matches("button, a, input[type=radio], [role=button], canvas")) return;
    if (focused instanceof HTMLElement || focused instanceof SVGElement) focused.blur();
  };
  addEventListener("keydown", onKeyDown, { signal });
  addEventListener("click", onClick, { signal });
}

type Pressed = Pick<KeyboardEvent, "key" | "ctrlKey" | "metaKey" | "altKey" | "shiftKey">;

/** The action of a key press; `undefined` where the focused element or the browser handles it. */
export function actionOf(pressed: Pressed, focused: Element | null, keys: PageKeys): (() => void) | undefined {
  const key = pressed.key.length === 1 ? pressed.key.toLowerCase() : pressed.key;
  if (pressed.altKey) return undefined;
  if (pressed.ctrlKey || pressed.metaKey) {
    if (focused?.matches("input[type=text]")) return undefined;
    if (key === "z") return pressed.shiftKey ? keys.redo : keys.undo;
    return key === "y" ? keys.redo : undefined;
  }
  if (key === " ") return takesSpace(focused) ? undefined : own(keys.view(), key);
  if (wantsKeys(focused) || (key.length === 1 && !keys.singleKeys())) return undefined;
  return own(keys.view(), key) ?? (key === "?" ? keys.help : undefined);
}

/** Looks up an own member only: inherited ones such as `constructor` are not actions. */
function own(table: KeyTable | undefined, key: string): (() => void) | undefined {
  return table && Object.hasOwn(table, key) ? table[key] : undefined;
}
