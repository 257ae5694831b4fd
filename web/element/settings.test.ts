import { describe, expect, it } from "vitest";
import { completed, triangleOf } from "./settings";

const database = {
  styles: ["angry", "childlike", "depressed", "neutral", "old", "proud", "sexy", "strutting"],
  neutral: "neutral",
};
const only = (name: string) => [{ name, weight: 1 }];

describe("the small polygon", () => {
  it("has the styles that are mixed, and the first choice where these are fewer than three", () => {
    const { vertices, selection } = triangleOf(only("angry"), database);
    expect([...vertices].sort()).toEqual(["angry", "old", "proud"]);
    expect(selection.find(({ name }) => name === "angry")?.weight).toBe(1);
  });

  it("keeps its corners as long as it can", () => {
    expect(triangleOf(only("sexy"), database, ["angry", "sexy", "old"]).vertices.sort()).toEqual([
      "angry",
      "old",
      "sexy",
    ]);
  });

  it("has the heaviest three of more, which then are the whole", () => {
    const styles = ["angry", "old", "proud", "sexy"].map((name, i) => ({ name, weight: 0.1 * (i + 1) }));
    const { vertices, selection } = triangleOf(styles, database);
    expect(vertices).not.toContain("angry");
    expect(selection.reduce((sum, { weight }) => sum + weight, 0)).toBeCloseTo(1);
  });
});

describe("what weights leave of 1", () => {
  it("is neutral, and less than nothing where they exaggerate", () => {
    expect(completed([{ name: "old", weight: 0.25 }], "neutral")).toContainEqual({ name: "neutral", weight: 0.75 });
    expect(completed([{ name: "old", weight: 1.5 }], "neutral")).toContainEqual({ name: "neutral", weight: -0.5 });
    expect(completed(only("old"), "neutral")).toEqual(only("old"));
  });
});
