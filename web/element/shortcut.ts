/** Keys of a player, in addition to those of its controls. */

/** Keys that move the handle of a slider. */
const SLIDER_KEYS = ["ArrowLeft", "ArrowRight", "Home", "End"];
/** Keys that press a button. */
const PRESSING_KEYS = [" ", "Enter"];

/** Whether a pressed key belongs to the player, not to the browser or to the focused control. */
export function isShortcut(event: KeyboardEvent): boolean {
  if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey) return false;
  const [target] = event.composedPath();
  if (target instanceof HTMLInputElement) return target.type !== "text" && !SLIDER_KEYS.includes(event.key);
  const isPressed = target instanceof HTMLButtonElement || target instanceof HTMLAnchorElement;
  return !(isPressed && PRESSING_KEYS.includes(event.key));
}
