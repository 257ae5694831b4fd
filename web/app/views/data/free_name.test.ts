import { expect, test } from "vitest";
import { freeName } from "./free_name";

test("a name that is taken gets the lowest free number", () => {
  expect(freeName("My clips", [])).toBe("My clips");
  expect(freeName("My clips", ["My clips"])).toBe("My clips 2");
  expect(freeName("My clips", ["My clips", "My clips 2", "My clips 4"])).toBe("My clips 3");
  expect(freeName("constructor", [])).toBe("constructor");
});
