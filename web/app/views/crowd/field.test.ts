import { expect, test } from "vitest";
import { firstField, unknownStyle, withoutVertex, withStyle, withVertex } from "./field";

const STYLES = ["angry", "childlike", "neutral", "old", "proud"];

test("the first field has three styles that differ, none of them neutral", () => {
  const field = firstField(STYLES, "neutral");
  expect(field.map(({ style }) => style)).toEqual(["proud", "old", "childlike"]);
  for (const [i, a] of field.entries())
    for (const b of field.slice(0, i)) expect(Math.hypot(a.x - b.x, a.z - b.z)).toBeGreaterThan(5);
  expect(firstField(["walk"], "").map(({ style }) => style)).toEqual(["walk"]);
});

test("a vertex keeps to its ranges, and to what links can say", () => {
  const field = firstField(STYLES, "neutral");
  expect(withVertex(field, 1, { x: 1.23456, z: -500 })[1]).toMatchObject({ style: "old", x: 1.23, z: -100 });
  expect(withVertex(field, 0, { reach: 0.01 })[0]!.reach).toBe(0.5);
  expect(withVertex(field, 0, { intensity: 7 })[0]!.intensity).toBe(2);
  expect(withVertex(field, 0, { x: 9 }).slice(1)).toEqual(field.slice(1));
});

test("a new vertex is where there is room, and there are twelve at most", () => {
  let field = firstField(STYLES, "neutral");
  for (let i = 0; i < 9; i++) {
    field = withStyle(field, "angry", 16);
    const added = field.at(-1)!;
    for (const other of field.slice(0, -1))
      expect(Math.hypot(added.x - other.x, added.z - other.z)).toBeGreaterThanOrEqual(2.99);
    expect(Math.hypot(added.x, added.z)).toBeLessThan(16);
  }
  expect(field.length).toBe(12);
  expect(withStyle(field, "angry", 16)).toEqual(field);
  expect(withStyle([], "old", 8)).toMatchObject([{ style: "old", x: 0, z: 0 }]);
});

test("vertices go, and unknown styles are found", () => {
  const field = firstField(STYLES, "neutral");
  expect(withoutVertex(field, 1).map(({ style }) => style)).toEqual(["proud", "childlike"]);
  expect(unknownStyle(field, STYLES)).toBeUndefined();
  expect(unknownStyle(field, ["proud", "childlike"])).toBe("old");
});
