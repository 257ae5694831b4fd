import { expect, test } from "vitest";
import { isSupported } from "./baseline";

test("a browser is supported where it has everything that is looked for", () => {
  expect(isSupported([() => true, () => true])).toBe(true);
  expect(isSupported([() => true, () => false])).toBe(false);
});

test("a browser in which looking throws is not supported", () => {
  const absent = () => {
    throw new ReferenceError("DecompressionStream is not defined");
  };
  expect(isSupported([absent])).toBe(false);
});
