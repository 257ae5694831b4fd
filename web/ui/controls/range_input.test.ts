import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { rangeInput } from "./range_input";

/** A slider without a page; the test sets it like the browser and fires its events. */
class FakeInput extends EventTarget {
  value = "10";
  getAttribute(): null {
    return null;
  }
  setAttribute(): void {}
  append(): void {}
}

let input: HTMLInputElement;
let log: string[];
const happens = (type: string) => input.dispatchEvent(new Event(type));

beforeEach(() => {
  vi.stubGlobal("document", { createElement: () => new FakeInput() });
  input = rangeInput({ min: 0, max: 100 });
  log = [];
  for (const type of ["input", "change"]) input.addEventListener(type, () => log.push(`${type} ${input.value}`));
});
afterEach(() => vi.unstubAllGlobals());

it("goes back to what it was where the browser takes the finger that set it for scrolling", () => {
  happens("pointerdown");
  input.value = "60";
  happens("input");
  happens("pointercancel");
  expect(log).toEqual(["input 60", "input 10", "change 10"]);
});

it("is left alone where it moved by itself under such a finger, as a time line does", () => {
  happens("pointerdown");
  input.value = "12";
  happens("pointercancel");
  expect(input.value).toBe("12");
  expect(log).toEqual([]);
});

it("keeps what a finger set that was lifted", () => {
  happens("pointerdown");
  input.value = "60";
  happens("input");
  happens("pointerup");
  expect(input.value).toBe("60");
});
