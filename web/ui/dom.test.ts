import { expect, it } from "vitest";
import { setAttributes } from "./dom";

/** An element that logs what was written. */
function fakeElement() {
  const written: Record<string, string> = {};
  const writes: string[] = [];
  const element = {
    style: { cssText: "" },
    getAttribute: (name: string) => written[name] ?? null,
    setAttribute: (name: string, value: string) => {
      written[name] = value;
      writes.push(name);
    },
    removeAttribute: (name: string) => {
      delete written[name];
    },
  };
  return { element: element as unknown as HTMLElement, written, writes };
}

it("writes styles without a style attribute, which the content security policy forbids", () => {
  const { element, written } = fakeElement();
  setAttributes(element, { id: "a", hidden: true, style: "--colour: red" });
  expect(element.style.cssText).toBe("--colour: red");
  expect(written).toEqual({ id: "a", hidden: "" });
  setAttributes(element, { hidden: false });
  expect(written).toEqual({ id: "a" });
});

it("writes an attribute only where it differs", () => {
  const { element, writes } = fakeElement();
  setAttributes(element, { cx: 1.5, hidden: true });
  setAttributes(element, { cx: "1.5", hidden: true });
  setAttributes(element, { cx: 2 });
  expect(writes).toEqual(["cx", "hidden", "cx"]);
});
