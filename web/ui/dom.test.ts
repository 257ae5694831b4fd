import { expect, it } from "vitest";
import { setAttributes } from "./dom";

it("writes styles without a style attribute, which the content security policy forbids", () => {
  const written: Record<string, string> = {};
  const element = {
    style: { cssText: "" },
    setAttribute: (name: string, value: string) => {
      written[name] = value;
    },
    removeAttribute: (name: string) => {
      delete written[name];
    },
  };
  setAttributes(element as unknown as Element, { id: "a", hidden: true, style: "--colour: red" });
  expect(element.style.cssText).toBe("--colour: red");
  expect(written).toEqual({ id: "a", hidden: "" });
  setAttributes(element as unknown as Element, { hidden: false });
  expect(written).toEqual({ id: "a" });
});
