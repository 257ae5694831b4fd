/** A slider of the browser. */

import { type Attributes, html } from "../dom";

/** `<input type="range">`. A finger that comes down on it and scrolls the page sets nothing. */
export function rangeInput(attributes: Attributes): HTMLInputElement {
  const input = html("input", { type: "range", ...attributes });
  let before = "";
  /** Whether the pointer has set the value; a time line moves by itself as well. */
  let isSet = false;
  input.addEventListener("pointerdown", () => {
    before = input.value;
    isSet = false;
  });
  input.addEventListener("input", () => {
    isSet = true;
  });
  // The browser has taken the finger for scrolling, but set the value to its place before.
  input.addEventListener("pointercancel", () => {
    if (!isSet) return;
    input.value = before;
    for (const type of ["input", "change"]) input.dispatchEvent(new Event(type));
  });
  return input;
}
