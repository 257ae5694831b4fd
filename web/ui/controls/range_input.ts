/** A native slider. */

import { type Attributes, html } from "../dom";

/** `<input type="range">`. A touch that scrolls the page does not change it. */
export function rangeInput(attributes: Attributes): HTMLInputElement {
  const input = html("input", { type: "range", ...attributes });
  let before = "";
  /** Whether the pointer has set the value; a timeline also moves by itself. */
  let isSet = false;
  input.addEventListener("pointerdown", () => {
    before = input.value;
    isSet = false;
  });
  input.addEventListener("input", () => {
    isSet = true;
  });
  // The browser has used the touch for scrolling, but had set the value to its position before.
  input.addEventListener("pointercancel", () => {
    if (!isSet) return;
    input.value = before;
    for (const type of ["input", "change"]) input.dispatchEvent(new Event(type));
  });
  return input;
}
