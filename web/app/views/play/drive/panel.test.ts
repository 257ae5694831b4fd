import { expect, test } from "vitest";
import { clipWords } from "./panel";

test("a clip is named by what is done in it", () => {
  const named = ["walk-pace_neutral", "halt-halt-from-a-stroll_neutral, mirrored", "dataset-2_walk_normal_001"];
  expect(named.map((name) => clipWords(name, name.includes("normal") ? "normal" : "neutral"))).toEqual([
    "walk pace",
    "halt from a stroll, mirrored",
    "dataset 2 walk",
  ]);
});
