/** Keyboard shortcuts of the page and of the view that is shown. The focused control has precedence. */
import type { KeyTable } from "../view";

export interface PageKeys {
  undo(): void;
  redo(): void;
  help(): void;
  /** Opens a file, and saves the project. */
  open(): void;
  save(): void;
  /** The keys of the view that is shown. */
  view(): KeyTable | undefined;
  /** Whether single-character shortcuts are on; Space is not one of them. */
  singleKeys(): boolean;
}

/** Kinds of `<input>` that no text is typed into. */
const NO_TEXT = ["checkbox", "radio", "range", "file", "color", "button", "submit"];

/** Whether text is typed into the element, so that letters and undo are its own. */
function isTextField(element: Element | null): boolean {
  if (!element) return false;
  const { localName } = element;
  if (localName === "input") return !NO_TEXT.includes(element.getAttribute("type") ?? "text");
  return localName === "textarea" || element.matches("[contenteditable]");
}

/** Whether the element handles arrows, Home and letters itself; `byKeys` is whether the keyboard led to it. */
function wantsKeys(element: Element | null, byKeys: boolean): boolean {
  if (isTextField(element) || element?.matches("select, input[type=range]")) return true;
  return byKeys && (element?.matches("input[type=radio]") ?? false);
}

const PRESSED = "button, a, summary, [role=button], input[type=radio], input[type=checkbox]";

/** Whether the element handles Space itself. */
function takesSpace(element: Element | null, byKeys: boolean): boolean {
  if (isTextField(element) || element?.matches("select")) return true;
  return byKeys && (element?.matches(PRESSED) ?? false);
}

/** Listens to the page's keys until the signal aborts. */
export function listenToKeys(keys: PageKeys, signal: AbortSignal): void {
  let tookSpace = false;
  // A control that was clicked keeps the focus, for screen readers and switch devices, but leaves Space and arrows to the page.
  // `:focus-visible` would not do: it holds of what a script gives the focus, as the polygon does.
  let byKeys = true;
  const onKeyDown = (event: KeyboardEvent): void => {
    if (event.key === "Tab") byKeys = true;
    if (event.defaultPrevented || document.querySelector("dialog[open]")) return;
    const action = actionOf(event, document.activeElement, keys, byKeys);
    if (event.key === " ") tookSpace = action !== undefined;
    if (!action) return;
    event.preventDefault();
    // Key repeat would toggle playback again and again.
    if (event.key !== " " || !event.repeat) action();
  };
  // Firefox clicks the focused button when Space is let go.
  const onKeyUp = (event: KeyboardEvent): void => {
    if (event.key === " " && tookSpace) event.preventDefault();
  };
  // What acts on keys itself, the picture and corners of the polygon, loses the focus with a click, so that Space and arrows
  // are the page's. Who comes there by Tab uses them.
  const onClick = (event: MouseEvent): void => {
    const focused = document.activeElement;
    if (event.detail === 0 || !focused?.matches("canvas, [role=button]")) return;
    if (focused instanceof HTMLElement || focused instanceof SVGElement) focused.blur();
  };
  const onPointer = () => {
    byKeys = false;
  };
  addEventListener("pointerdown", onPointer, { signal, capture: true });
  addEventListener("keydown", onKeyDown, { signal });
  addEventListener("keyup", onKeyUp, { signal });
  addEventListener("click", onClick, { signal });
}

type Pressed = Pick<KeyboardEvent, "key" | "ctrlKey" | "metaKey" | "altKey" | "shiftKey">;

/**
 * The action of a key press; `undefined` where the focused element or the browser handles it.
 * @param byKeys whether the keyboard led to the focused element, not a click
 */
export function actionOf(
  pressed: Pressed,
  focused: Element | null,
  keys: PageKeys,
  byKeys: boolean,
): (() => void) | undefined {
  const key = pressed.key.length === 1 ? pressed.key.toLowerCase() : pressed.key;
  if (pressed.altKey) return undefined;
  if (pressed.ctrlKey || pressed.metaKey) {
    // The browser would open a file in the place of the page, or save the page.
    if (key === "o" && !pressed.shiftKey) return keys.open;
    if (key === "s" && !pressed.shiftKey) return keys.save;
    if (isTextField(focused)) return undefined;
    if (key === "z") return pressed.shiftKey ? keys.redo : keys.undo;
    return key === "y" ? keys.redo : undefined;
  }
  if (key === " ") return takesSpace(focused, byKeys) ? undefined : own(keys.view(), key);
  if (wantsKeys(focused, byKeys) || (key.length === 1 && !keys.singleKeys())) return undefined;
  return own(keys.view(), key) ?? (key === "?" ? keys.help : undefined);
}

/** Looks up an own member only: inherited ones such as `constructor` are not actions. */
function own(table: KeyTable | undefined, key: string): (() => void) | undefined {
  return table && Object.hasOwn(table, key) ? table[key] : undefined;
}
