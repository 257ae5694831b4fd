import { describe, expect, it } from "vitest";
import type { Likeness } from "./likeness";
import { ReadAction } from "./read_action";

const frame = (action: string, weight: number) => [{ action, style: "neutral", weight }];
const like = (kind: Likeness["kind"], action: string): Likeness => ({
  kind,
  read: { action, style: "neutral", weight: 0.3 },
});

describe("the action of the title", () => {
  it("is that of the input that is open, not of the one before", () => {
    const read = new ReadAction();
    read.take(frame("punch", 1), 1000);
    expect(read.name).toBe("punch");
    read.forget();
    // A single change, at the first frame of the next input; no class of a recording needs half of the weight.
    expect(read.name).toBe("punch");
    expect(read.take(frame("kick", 0.3), 1050)).toBe(true);
    expect(read.name).toBe("kick");
  });

  it("changes within an input only where it is sure, and not all the time", () => {
    const read = new ReadAction();
    read.forget();
    read.take(frame("walk", 0.9), 1000);
    expect(read.take(frame("run", 0.4), 2000)).toBe(false);
    expect(read.take(frame("run", 0.9), 2000)).toBe(true);
    expect(read.take(frame("walk", 0.9), 2100)).toBe(false);
    expect(read.name).toBe("run");
  });

  it("is none where the input is unlike anything", () => {
    const read = new ReadAction();
    read.forget();
    read.take(frame("kick", 1), 1000);
    expect(read.takeWhole(like("still", "kick"))).toBe(true);
    expect(read.take(frame("kick", 1), 3000)).toBe(false);
    expect(read.name).toBeUndefined();
    // The next input is recognised again.
    read.forget();
    read.take(frame("walk", 0.05), 4000);
    expect(read.name).toBeUndefined();
    expect(read.takeWhole(like("action", "walk"))).toBe(true);
    expect(read.name).toBe("walk");
  });
});
