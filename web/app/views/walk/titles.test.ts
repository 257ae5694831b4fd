/** Names of blocks and plans. */
import { describe, expect, it } from "vitest";
import type { WalkBlock } from "../../state/walk";
import { blockName, planTitle } from "./titles";

const block = (patch: Partial<WalkBlock> = {}): WalkBlock => ({
  styles: [{ name: "old", weight: 1 }],
  intensity: 1,
  steps: 4,
  transition: 2,
  ...patch,
});

describe("the name of a block", () => {
  it("tells its style and how strong it is", () => {
    expect(blockName(block())).toBe("old");
    expect(blockName(block({ intensity: 1.5 }))).toBe("very old");
    expect(blockName(block({ intensity: 0.5 }))).toBe("slightly old");
    expect(blockName(block({ intensity: -1 }))).toBe("opposite of old");
    expect(blockName(block({ intensity: 0 }))).toBe("average");
  });

  it("tells the styles of both feet where they differ", () => {
    expect(blockName(block({ right: [{ name: "high-heels", weight: 1 }] }))).toBe("old left, high heels right");
  });

  it("passes over weights that cannot be seen", () => {
    const styles = [
      { name: "old", weight: 1 },
      { name: "proud", weight: 0.001 },
    ];
    expect(blockName(block({ styles }))).toBe("old");
  });
});

describe("the title of a plan", () => {
  it("counts steps and styles, each style once", () => {
    const proud = block({ styles: [{ name: "proud", weight: 1 }] });
    expect(planTitle([block(), proud, block()], 16, "neutral")).toBe("16 steps, two styles");
    expect(planTitle([block({ styles: [{ name: "old", weight: 0 }] })], 4, "neutral")).toBe("Four steps, one style");
  });
});
