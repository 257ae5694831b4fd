/** Keys of a player, beside those of the controls inside it. */

/** Keys that move the handle of a slider. */
const SLIDER_KEYS = ["ArrowLeft", "ArrowRight", "Home", "End"];
/** Keys that press a button. */
const PRESSING_KEYS = [" ", "Enter"];

/** Whether a key that was pressed is the player's: not the browser's, nor that of the control which has the focus. */
export function isShortcut(event: KeyboardEvent): boolean {
  if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey) return false;
  const [target] = event.composedPath();
  if (target instanceof HTMLInputElement) return target.type !== "text" && !SLIDER_KEYS.includes(event.key);
  const isPressed = target instanceof HTMLButtonElement || target instanceof HTMLAnchorElement;
  return !(isPressed && PRESSING_KEYS.includes(event.key));
}
