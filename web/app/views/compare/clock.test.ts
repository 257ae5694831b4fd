import { expect, test } from "vitest";
import { advanced } from "./clock";

const running = { speed: 0.5, rateHz: 60, frames: 100, range: undefined, loop: true };

test("the clock runs at its speed, and at the end of the range begins again or stops", () => {
  expect(advanced(10, 0.1, running)).toEqual({ frame: 13, event: undefined });
  expect(advanced(98, 0.1, running)).toEqual({ frame: 0, event: "restarted" });
  expect(advanced(98, 0.1, { ...running, loop: false })).toEqual({ frame: 99, event: "ended" });
  const range = { first: 20, last: 40 };
  expect(advanced(39, 0.1, { ...running, range })).toEqual({ frame: 20, event: "restarted" });
  expect(advanced(39, 0.1, { ...running, range: { first: 20, last: 400 } }).frame).toBe(42);
});
