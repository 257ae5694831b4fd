import { expect, test } from "vitest";
import { recordedPart } from "./recording";

test("a motion is recorded as far as there is room for it", () => {
  const minute = { frames: 3600, rateHz: 60 };
  expect(recordedPart({ frames: 500, rateHz: 60 }, 8, undefined)).toEqual({ first: 0, frames: 500 });
  expect(recordedPart(minute, 8, undefined), "30 s").toEqual({ first: 0, frames: 1800 });
  expect(recordedPart(minute, 100, undefined), "32 MB").toEqual({ first: 0, frames: 1126 });
  expect(recordedPart(minute, 8, { first: 3000, last: 3199 }), "a range").toEqual({ first: 3000, frames: 200 });
  expect(recordedPart(minute, 8, { first: 3500, last: 9000 })).toEqual({ first: 3500, frames: 100 });
  expect(recordedPart(minute, 8, { first: 4000, last: 9000 }), "beyond the end").toEqual({ first: 3600, frames: 0 });
});
