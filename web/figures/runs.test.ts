import { expect, it } from "vitest";
import { runsOf } from "./runs";

it("finds the runs within a range", () => {
  const stands = [1, 1, 0, 1, 0, 0, 1, 1];
  const isIn = (i: number) => stands[i] === 1;
  expect(runsOf(0, 8, isIn)).toEqual([
    [0, 1],
    [3, 3],
    [6, 7],
  ]);
  expect(runsOf(1, 7, isIn)).toEqual([
    [1, 1],
    [3, 3],
    [6, 6],
  ]);
  expect(runsOf(4, 6, isIn)).toEqual([]);
});
