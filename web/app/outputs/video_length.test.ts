import { expect, test } from "vitest";
import { checkVideoLength } from "./video_length";

test("a video of ten minutes can be made", () => {
  expect(() => checkVideoLength(600)).not.toThrow();
});

test("a longer one is refused with its length, the limit and a next step", () => {
  expect(() => checkVideoLength(31.2 * 60)).toThrow(
    "The video would last 32 minutes; at most 10 can be recorded. Choose a shorter range, or a higher speed.",
  );
});
