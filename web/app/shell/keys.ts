/** Keyboard shortcuts of the page and of the current view. The focused control has precedence. */
import type { KeyTable } from "../view";

export interface PageKeys {
  undo(): void;
  redo(): void;
  help(): void;
  /** Opens a file, and saves the project. */
  open(): void;
  save(): void;
  /** The keys of the current view. */
  view(): KeyTable | undefined;
  /** Whether single-character shortcuts are on. Space is not one of them. */
  singleKeys(): boolean;
}

/** Types of `<input>` without text entry. */
const NO_TEXT = ["checkbox", "radio", "range", "file", "color", "button", "submit"];

/** Whether the element accepts text, so that it handles letters and undo itself. */
function isTextField(element: Element | null): boolean {
  if (!element) return false;
  const { localName } = element;
  if (localName === "input") return !NO_TEXT.includes(element.getAttribute("type") ?? "text");
  return localName === "textarea" || element.matches("[contenteditable]");
}

/** Whether the element handles arrows, Home and letters itself; `byKeys` tells whether it got the focus by the keyboard. */
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
  // A clicked control keeps the focus, for screen readers and switch devices, but leaves Space and arrows to the page.
  // `:focus-visible` is not sufficient: it also matches elements focused by a script, such as the polygon.
  let byKeys = true;
  const onKeyDown = (event: KeyboardEvent): void => {
    if (event.key === "Tab") byKeys = true;
    if (event.defaultPrevented || document.querySelector("dialog[open]")) return;
    const action = actionOf(event, document.activeElement, keys, byKeys);
    if (event.key === " ") tookSpace = action !== undefined;
    if (!action) return;
    event.preventDefault();
    // Key repeat would toggle playback repeatedly.
    if (event.key !== " " || !event.repeat) action();
  };
  // Firefox clicks the focused button when Space is released.
  const onKeyUp = (event: KeyboardEvent): void => {
    if (event.key === " " && tookSpace) event.preventDefault();
  };
  // Elements that handle keys themselves, the picture and corners of the polygon, lose the focus on a click, so that
  // the page handles Space and arrows. With Tab, the user can still reach them.
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
 * The action of a key press; `undefined` if the focused element or the browser handles it.
 * @param byKeys whether the focused element got the focus by the keyboard, not by a click
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
    // The browser would open a file instead of the page, or save the page.
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

/** Looks up own properties only: inherited ones such as `constructor` are not actions. */
function own(table: KeyTable | undefined, key: string): (() => void) | undefined {
  return table && Object.hasOwn(table, key) ? table[key] : undefined;
}
