import fc from "fast-check";
import { describe, expect, it } from "vitest";
import {
  allOf,
  drop,
  engineWeights,
  firstSelection,
  fromPolygon,
  isBeyondData,
  type Selection,
  select,
  toTriangle,
  vertexOrder,
  weightOf,
  withWeight,
} from "./selection";

const XIA = ["angry", "childlike", "depressed", "neutral", "old", "proud", "sexy", "strutting"];
const three: Selection = [
  { name: "proud", weight: 0.62 },
  { name: "old", weight: 0.12 },
  { name: "childlike", weight: 0.26 },
];
const total = (selection: Selection) => selection.reduce((sum, s) => sum + s.weight, 0);

describe("the order of the vertices", () => {
  it("is the design's for the paper's eight styles", () => {
    expect(vertexOrder(XIA, "neutral")).toEqual([
      "proud",
      "strutting",
      "angry",
      "childlike",
      "neutral",
      "old",
      "sexy",
      "depressed",
    ]);
  });

  it("holds every style once, whatever the database has", () => {
    fc.assert(
      fc.property(fc.uniqueArray(fc.string({ minLength: 1 }), { minLength: 1, maxLength: 20 }), (styles) => {
        const neutral = styles[styles.length - 1]!;
        expect([...vertexOrder(styles, neutral)].sort()).toEqual([...styles].sort());
      }),
    );
  });

  it("keeps neutral at the bottom of four", () => {
    const order = vertexOrder(["neutral", "proud", "old", "depressed"], "neutral");
    expect(order[0]).toBe("proud");
    expect(order[2]).toBe("neutral");
  });
});

describe("editing a selection", () => {
  it("starts mostly proud, or with what the database has", () => {
    expect(firstSelection(XIA, "neutral").map((s) => s.name)).toEqual(["proud", "old", "childlike"]);
    const namco = firstSelection(["active", "elderly", "normal"], "normal");
    expect(namco.map((s) => s.name)).toEqual(["active", "elderly", "normal"]);
    expect(total(namco)).toBeCloseTo(1);
  });

  it("gives a new style the place of the one that weighs least", () => {
    const next = select(three, "angry");
    expect(next.map((s) => s.name)).toEqual(["proud", "angry", "childlike"]);
    expect(weightOf(next, "angry")).toBe(0.12);
    expect(select(three, "old")).toBe(three);
  });

  it("shares the weight of a dropped style, and keeps the last", () => {
    const two = drop(three, "proud");
    expect(total(two)).toBeCloseTo(1);
    expect(weightOf(two, "childlike") / weightOf(two, "old")).toBeCloseTo(0.26 / 0.12);
    expect(drop([{ name: "old", weight: 1 }], "old")).toHaveLength(1);
  });

  it("takes all of one style", () => {
    expect(allOf(three, "sexy").map((s) => s.weight)).toEqual([0, 1, 0]);
  });

  it("goes from the polygon to the nearest triangle and keeps the sum", () => {
    const mixed = fromPolygon(XIA, [0.3, 0.2, 0.1, 0.1, 0.1, 0.1, 0.1, 0.001]);
    expect(mixed).toHaveLength(7);
    const triangle = toTriangle(mixed, XIA);
    expect(triangle.map((s) => s.name)).toEqual(["angry", "childlike", "depressed"]);
    expect(total(triangle)).toBeCloseTo(1);
  });

  it("makes the triangle of one or two styles as wide as it can be", () => {
    const vertices = Array.from({ length: 24 }, (_, i) => `style ${i}`);
    const names = (...selected: string[]) =>
      toTriangle(
        selected.map((name) => ({ name, weight: 1 / selected.length })),
        vertices,
      ).map((s) => s.name);
    expect(toTriangle([{ name: "proud", weight: 1 }], vertexOrder(XIA, "neutral")).map((s) => s.name)).toEqual([
      "proud",
      "childlike",
      "old",
    ]);
    expect(names("style 4")).toEqual(["style 4", "style 12", "style 20"]);
    expect(names("style 0", "style 6")).toEqual(["style 0", "style 6", "style 15"]);
    expect(toTriangle([{ name: "old", weight: 1 }], ["proud", "old"])).toEqual([
      { name: "old", weight: 1 },
      { name: "proud", weight: 0 },
    ]);
  });
});

describe("a weight that is typed", () => {
  it("leaves the others their proportions", () => {
    const before = [
      { name: "a", weight: 0.6 },
      { name: "b", weight: 0.1 },
      { name: "c", weight: 0.3 },
    ];
    const after = withWeight(before, "a", 0.2);
    expect(after.map((s) => s.name)).toEqual(["a", "b", "c"]);
    expect(after.map((s) => s.weight)).toEqual([0.2, expect.closeTo(0.2), expect.closeTo(0.6)]);
  });

  it("shares the rest equally where the others had none", () => {
    const all = [
      { name: "a", weight: 1 },
      { name: "b", weight: 0 },
      { name: "c", weight: 0 },
    ];
    expect(withWeight(all, "a", 0.5).map((s) => s.weight)).toEqual([0.5, 0.25, 0.25]);
  });

  it("changes nothing alone, or of a style that is not selected", () => {
    const alone = [{ name: "a", weight: 1 }];
    expect(withWeight(alone, "a", 0.5)).toBe(alone);
    expect(withWeight(alone, "b", 0.5)).toBe(alone);
  });

  it("keeps the sum at one", () => {
    const weight = fc.double({ min: 0, max: 1, noNaN: true });
    fc.assert(
      fc.property(fc.array(weight, { minLength: 2, maxLength: 8 }), weight, (weights, typed) => {
        const selection = weights.map((w, i) => ({ name: String(i), weight: w }));
        const sum = withWeight(selection, "0", typed).reduce((total, s) => total + s.weight, 0);
        expect(sum).toBeCloseTo(1, 9);
      }),
    );
  });
});

describe("what the engine is asked for", () => {
  it("scales by the intensity and leaves the rest to neutral", () => {
    const selection = [...three.slice(0, 2), { name: "neutral", weight: 0.26 }];
    expect(engineWeights(selection, 0.5, "neutral")).toEqual({ proud: 0.31, old: 0.06 });
  });

  it("is beyond the data below 0 and above 1", () => {
    expect(isBeyondData(three, 1)).toBe(false);
    expect(isBeyondData(three, 1.5)).toBe(false);
    expect(isBeyondData(three, 1.7)).toBe(true);
    expect(isBeyondData(three, -0.5)).toBe(true);
  });
});
