import { describe, expect, it } from "vitest";
import { type AppState, initialState } from "../../state/state";
import { otherSide } from "../../state/style_settings";
import { columnCaption, columnOptions, shownOrder } from "./columns";

const OLD = [{ name: "old", weight: 1 }];
const PROUD = [{ name: "proud", weight: 1 }];
const state: AppState = { ...initialState(), styles: OLD, method: "nn", k: 60 };

describe("a column", () => {
  it("is the input as it is, or a method with all the rest as it is set", () => {
    expect(columnOptions("input", state, "neutral")).toBeUndefined();
    expect(columnOptions("mar", state, "neutral")).toMatchObject({ method: "mar", k: 60, styles: { old: 1 } });
    expect(columnOptions("knn", state, "neutral")).toMatchObject({ method: "knn", k: 60 });
  });

  it("is one of two settings, whichever of them is shown", () => {
    const b = { ...state, ...otherSide(state), styles: PROUD, k: 20 };
    expect(columnOptions("a", b, "neutral")).toMatchObject({ styles: { old: 1 }, k: 60, method: "nn" });
    expect(columnOptions("b", b, "neutral")).toMatchObject({ styles: { proud: 1 }, k: 20, method: "nn" });
    const a = { ...b, ...otherSide(b) };
    expect(columnOptions("a", a, "neutral")).toEqual(columnOptions("a", b, "neutral"));
    expect(columnOptions("b", a, "neutral")).toEqual(columnOptions("b", b, "neutral"));
  });

  it("is both settings alike while there is only one", () => {
    expect(columnOptions("b", state, "neutral")).toEqual(columnOptions("a", state, "neutral"));
  });

  it("says what it is", () => {
    expect(columnCaption("input", "neutral walk", state)).toBe("neutral walk, unchanged");
    expect(columnCaption("knn", "neutral walk", state)).toBe("mean of the 60 closest frames");
  });
});

describe("the order of the columns", () => {
  it("is that of the link; on a narrow screen Strut is the first", () => {
    expect(shownOrder(["input", "nn", "mar", "real"], false)).toEqual([0, 1, 2, 3]);
    expect(shownOrder(["input", "nn", "mar", "real"], true)).toEqual([2, 0, 1, 3]);
    expect(shownOrder(["mar", "nn"], true)).toEqual([0, 1]);
    expect(shownOrder(["input", "nn"], true)).toEqual([0, 1]);
  });
});
