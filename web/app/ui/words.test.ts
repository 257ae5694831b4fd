import { describe, expect, it } from "vitest";
import { isCancellation } from "../../client/protocol";
import { errorText, exportName, stageCaption, stageTitle } from "./words";

const mix = (weights: Record<string, number>) => Object.entries(weights).map(([name, weight]) => ({ name, weight }));
const title = (weights: Record<string, number>, intensity = 1) =>
  stageTitle("walk", mix(weights), intensity, "neutral");

describe("the title", () => {
  it("says how the character moves", () => {
    expect(title({ proud: 0.62, old: 0.12, childlike: 0.26 })).toBe("Walk, mostly proud");
    expect(title({ proud: 1, old: 0 })).toBe("Walk, proud");
    expect(title({ proud: 0.45, old: 0.4, childlike: 0.15 })).toBe("Walk, proud and old");
    expect(title({ a: 0.2, b: 0.2, c: 0.2, d: 0.2, e: 0.2 })).toBe("Walk, a mix of five styles");
    expect(title({ neutral: 0.8, old: 0.2 }, 0.3)).toBe("Walk, mostly neutral");
  });

  it("says how much", () => {
    expect(title({ proud: 0.62, old: 0.38 }, 0)).toBe("Walk, neutral");
    expect(title({ proud: 0.62, old: 0.38 }, 0.4)).toBe("Walk, a little proud");
    expect(title({ proud: 1 }, 1.5)).toBe("Walk, very proud");
    expect(title({ proud: 0.62, old: 0.38 }, 1.5)).toBe("Walk, mostly proud, exaggerated");
    expect(title({ proud: 0.62, old: 0.38 }, -1)).toBe("Walk, the opposite of proud");
  });

  it("speaks names that files spell with hyphens", () => {
    expect(stageTitle("walk-turn-left", mix({ "not-confident": 1 }), 1, "normal")).toBe(
      "Walk turn left, not confident",
    );
    expect(stageCaption("neutral walk", { styles: 1, parts: 0, keys: 0 }, 60)).toBe(
      "neutral walk in · 1 style · 60 Hz",
    );
    expect(stageCaption("walk", { styles: 3, parts: 2, keys: 4 }, 60)).toBe(
      "walk in · 3 styles · 2 body parts styled separately · 4 keys · 60 Hz",
    );
  });
});

describe("names and errors", () => {
  it("names an export after its input and its style", () => {
    expect(exportName("dataset-2_walk 001.bvh", mix({ proud: 0.6, old: 0.4 }))).toBe("dataset-2-walk-001-proud.bvh");
    expect(exportName("…", [])).toBe("motion-styled.bvh");
  });

  it("puts the hint after the sentence", () => {
    expect(errorText({ message: "Line 3 is empty.", hint: "Export again." })).toBe("Line 3 is empty. Export again.");
    expect(errorText(new Error("No."))).toBe("No.");
    for (const message of [
      "Failed to fetch dynamically imported module: https://host/assets/a.js",
      "error loading dynamically imported module: https://host/assets/a.js",
      "Importing a module script failed.",
      "Unable to preload CSS for /assets/a.css",
    ])
      expect(errorText(new TypeError(message))).toMatch(/^A part of this page could not be loaded/);
    expect(errorText({})).toBe("An unknown error occurred.");
  });

  it("knows a cancellation", () => {
    expect(isCancellation({ code: "cancelled" })).toBe(true);
    expect(isCancellation(new DOMException("", "AbortError"))).toBe(true);
    expect(isCancellation(new Error("cancelled"))).toBe(false);
  });
});
