import { describe, expect, it } from "vitest";
import { Hints } from "./hints";

/** A storage of its own. */
function memory() {
  const values = new Map<string, string>();
  return {
    getItem: (key: string) => values.get(key) ?? null,
    setItem: (key: string, value: string) => void values.set(key, value),
  };
}

describe("the hints", () => {
  it("come one after another, and none that was followed before its turn", () => {
    const hints = new Hints(memory);
    expect(hints.text).toMatch(/^Drag the point/);
    hints.follow("part");
    expect(hints.text).toMatch(/^Drag the point/);
    hints.follow("drag");
    expect(hints.text).toMatch(/^Press K/);
    hints.follow("key");
    expect(hints.text).toBe("");
  });

  it("do not come again", () => {
    const kept = memory();
    new Hints(() => kept).follow("drag");
    expect(new Hints(() => kept).text).toMatch(/^Click a part/);
  });

  it("do without storage", () => {
    const hints = new Hints(() => {
      throw new Error("refused");
    });
    hints.follow("drag");
    expect(hints.text).toMatch(/^Click a part/);
  });
});
