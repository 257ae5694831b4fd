import { describe, expect, it } from "vitest";
import { trimBetween, trimOf, trimSecs, withEdge } from "./trim";

describe("a trim", () => {
  it("is the whole motion unless one is set, and stays within the motion", () => {
    expect(trimOf(undefined, 100)).toEqual({ first: 0, last: 99 });
    expect(trimOf({ first: 20, last: 400 }, 100)).toEqual({ first: 20, last: 99 });
    expect(trimOf({ first: 200, last: 400 }, 100)).toEqual({ first: 98, last: 99 });
  });

  it("has ends that move up to each other and to the ends of the motion", () => {
    expect(withEdge(undefined, "first", 12.4, 100)).toEqual({ first: 12, last: 99 });
    expect(withEdge({ first: 12, last: 99 }, "last", 60, 100)).toEqual({ first: 12, last: 60 });
    expect(withEdge({ first: 12, last: 60 }, "first", 80, 100)).toEqual({ first: 59, last: 60 });
    expect(withEdge({ first: 12, last: 60 }, "last", 3, 100)).toEqual({ first: 12, last: 13 });
    expect(withEdge({ first: 12, last: 60 }, "last", 700, 100)).toEqual({ first: 12, last: 99 });
  });

  it("ends where it contains the whole motion", () => {
    expect(withEdge({ first: 12, last: 99 }, "first", -5, 100)).toBeUndefined();
    expect(withEdge({ first: 0, last: 60 }, "last", 99, 100)).toBeUndefined();
    expect(trimBetween(99, 0, 100)).toBeUndefined();
  });

  it("is between two frames in either order, and two frames long at least", () => {
    expect(trimBetween(60.2, 12, 100)).toEqual({ first: 12, last: 60 });
    expect(trimBetween(12, 12, 100)).toEqual({ first: 12, last: 13 });
    expect(trimBetween(99, 99, 100)).toEqual({ first: 98, last: 99 });
  });

  it("has a length", () => {
    const input = { frames: 601, rateHz: 60 };
    expect(trimSecs(undefined, input)).toBe(10);
    expect(trimSecs({ first: 60, last: 150 }, input)).toBe(1.5);
  });
});
