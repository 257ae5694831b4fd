import { expect, test } from "vitest";
import { trackOf } from "./kept";

test("what the weights lack to 1 is of the neutral style", () => {
  const keys = [
    { frame: 0, styles: {} },
    { frame: 30, styles: { proud: 0.6, neutral: 0.1 } },
    { frame: 60, styles: { old: 1 } },
  ];
  expect(trackOf(keys, "neutral")).toEqual([
    { frame: 0, styles: [{ name: "neutral", weight: 1 }] },
    {
      frame: 30,
      styles: [
        { name: "proud", weight: 0.6 },
        { name: "neutral", weight: 0.4 },
      ],
    },
    { frame: 60, styles: [{ name: "old", weight: 1 }] },
  ]);
});
