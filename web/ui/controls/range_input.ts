/** A slider of the browser. */

import { type Attributes, html } from "../dom";

/** `<input type="range">`. A finger that comes down on it and scrolls the page sets nothing. */
export function rangeInput(attributes: Attributes): HTMLInputElement {
  const input = html("input", { type: "range", ...attributes });
  let before = "";
  input.addEventListener("pointerdown", () => {
    before = input.value;
  });
  // The browser has taken the finger for scrolling, but set the value to its place before.
  input.addEventListener("pointercancel", () => {
    if (input.value === before) return;
    input.value = before;
    for (const type of ["input", "change"]) input.dispatchEvent(new Event(type));
  });
  return input;
}
