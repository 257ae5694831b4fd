import { describe, expect, it } from "vitest";
import { ATTRIBUTES } from "./attributes";

describe("attributes", () => {
  it("take styles as links write them, and names alone", () => {
    expect(ATTRIBUTES.styles.parse("proud:0.5, old:0.5")).toEqual([
      { name: "proud", weight: 0.5 },
      { name: "old", weight: 0.5 },
    ]);
    expect(ATTRIBUTES.styles.parse("old")).toEqual([{ name: "old", weight: 1 }]);
    expect(ATTRIBUTES.styles.parse("old:much")).toBeUndefined();
  });

  it("take all controls, or some, and pass over what is none", () => {
    expect(ATTRIBUTES.controls.parse("")).toHaveLength(6);
    expect(ATTRIBUTES.controls.parse("seek play volume")).toEqual(["play", "seek"]);
  });

  it("keep numbers within their ranges", () => {
    expect(ATTRIBUTES.speed.parse("9")).toBe(4);
    expect(ATTRIBUTES.speed.parse("fast")).toBeUndefined();
  });
});
