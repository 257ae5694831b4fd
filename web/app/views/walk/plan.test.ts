import { describe, expect, it } from "vitest";
import type { WalkBlock } from "../../state/walk";
import {
  addBlock,
  changesOf,
  firstBlocks,
  moveBlock,
  removeBlock,
  segmentsOf,
  sharesAt,
  shiftTransition,
  stepsOf,
  withBlock,
  withKnownStyles,
} from "./plan";

const block = (name: string, steps: number, transition: number): WalkBlock => ({
  styles: [{ name, weight: 1 }],
  intensity: 1,
  steps,
  transition,
});
/** The fourteen steps of the design's picture. */
const PLAN = [block("neutral", 3, 3), block("proud", 4, 2), block("old", 3, 2)];

describe("the row of steps", () => {
  it("has blocks and the ways between them", () => {
    const row = segmentsOf(PLAN, false);
    expect(stepsOf(row)).toBe(14);
    expect(row.map(({ first, steps }) => [first, steps])).toEqual([
      [0, 3],
      [3, 2],
      [5, 4],
      [9, 2],
      [11, 3],
    ]);
  });

  it("ends with the way back where it begins again", () => {
    const row = segmentsOf(PLAN, true);
    expect(row.at(-1)).toEqual({ kind: "transition", from: 2, to: 0, first: 14, steps: 3 });
    expect(segmentsOf([PLAN[0]!], true), "one block goes on as it is").toHaveLength(1);
  });

  it("mixes on the way, state after state", () => {
    const row = segmentsOf(PLAN, false);
    expect(sharesAt(row, 2)).toEqual([{ block: 0, share: 1 }]);
    expect(sharesAt(row, 3)).toEqual([
      { block: 0, share: 0.75 },
      { block: 1, share: 0.25 },
    ]);
    expect(sharesAt(row, 4, 0.9)[1]!.share).toBeCloseTo(0.95);
    expect(sharesAt(row, 5)).toEqual([{ block: 1, share: 1 }]);
  });

  it("changes abruptly where nothing is in between", () => {
    const row = segmentsOf([block("a", 2, 0), block("b", 2, 0)], false);
    expect(stepsOf(row)).toBe(4);
    expect(changesOf(row, 10)).toEqual([{ step: 12, between: 0, block: 1 }]);
  });
});

describe("edits", () => {
  it("keep counts in their ranges", () => {
    expect(withBlock(PLAN, 1, { steps: 99, transition: -3 })[1]).toMatchObject({ steps: 16, transition: 0 });
    expect(withBlock(PLAN, 0, { steps: 0 })[0]!.steps).toBe(1);
  });

  it("move a transition without making the walk longer, and not beyond its neighbours", () => {
    const moved = shiftTransition(PLAN, 1, 2);
    expect(moved.map((b) => b.steps)).toEqual([5, 2, 3]);
    expect(shiftTransition(PLAN, 1, 9).map((b) => b.steps)).toEqual([6, 1, 3]);
    expect(shiftTransition(PLAN, 1, -9).map((b) => b.steps)).toEqual([1, 6, 3]);
    expect(shiftTransition(PLAN, 0, 1)).toEqual(PLAN);
  });

  it("add, move and remove blocks, but never the last one", () => {
    expect(addBlock(PLAN, 0, [{ name: "sexy", weight: 1 }]).map((b) => b.styles[0]!.name)).toEqual([
      "neutral",
      "sexy",
      "proud",
      "old",
    ]);
    expect(moveBlock(PLAN, 2, 0).map((b) => b.styles[0]!.name)).toEqual(["old", "neutral", "proud"]);
    expect(removeBlock([PLAN[0]!], 0)).toHaveLength(1);
  });

  it("know which styles there are", () => {
    expect(firstBlocks(["angry", "neutral", "old", "proud"], "neutral").map((b) => b.styles[0]!.name)).toEqual([
      "neutral",
      "proud",
      "old",
    ]);
    expect(firstBlocks(["a", "b"], undefined)).toHaveLength(2);
    const names = (blocks: WalkBlock[] | undefined) => blocks?.map((b) => b.styles[0]!.name);
    expect(names(withKnownStyles(PLAN, ["neutral", "proud"], undefined))).toEqual(["neutral", "proud"]);
    expect(names(withKnownStyles(PLAN, ["normal", "old"], "normal"))).toEqual(["normal", "normal", "old"]);
    expect(withKnownStyles(PLAN, ["neutral", "proud", "old"], "neutral")).toBeUndefined();
    const limping = [{ ...PLAN[0]!, right: [{ name: "gone", weight: 1 }] }];
    expect(withKnownStyles(limping, ["neutral"], undefined)).toEqual([{ ...PLAN[0]!, right: undefined }]);
  });
});
