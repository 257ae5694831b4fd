import { describe, expect, it } from "vitest";
import { ReadingMemory } from "./reading_memory";

function storage(): Pick<Storage, "getItem" | "setItem"> {
  const kept = new Map<string, string>();
  return { getItem: (key) => kept.get(key) ?? null, setItem: (key, value) => void kept.set(key, value) };
}

describe("what is remembered of skeletons", () => {
  it("is there in the next page, without the floor", () => {
    const kept = storage();
    new ReadingMemory(() => kept).keep("a", { up: "z", floor: 1, joints: { chest: null } });
    expect(new ReadingMemory(() => kept).all()).toEqual({ a: { up: "z", joints: { chest: null } } });
  });

  it("is forgotten where nothing is said any more", () => {
    const memory = new ReadingMemory(storage);
    const kept = storage();
    const other = new ReadingMemory(() => kept);
    other.keep("a", { up: "z" });
    other.keep("a", { floor: 1 });
    expect([memory.all(), other.all()]).toEqual([{}, {}]);
  });

  it("is of a hundred skeletons at most, the newest", () => {
    const kept = storage();
    const memory = new ReadingMemory(() => kept);
    for (let i = 0; i < 101; i++) memory.keep(`skeleton ${i}`, { up: "z" });
    memory.keep("skeleton 1", { up: "x" });
    memory.keep("one more", { up: "z" });
    const known = Object.keys(memory.all());
    expect(known).toHaveLength(100);
    expect(known).toContain("skeleton 1");
    expect(known).not.toContain("skeleton 2");
  });

  it("lasts as long as the page where storage refuses, and survives what is no memory", () => {
    const refusing = {
      getItem: () => "[1, {}",
      setItem: () => {
        throw new Error("full");
      },
    };
    const memory = new ReadingMemory(() => refusing);
    expect(memory.all()).toEqual({});
    memory.keep("a", { unit: 0.01 });
    expect(memory.all()).toEqual({ a: { unit: 0.01 } });
    const foreign = { getItem: () => '{"a": "up~w", "b": 3, "c": "up~z"}', setItem: () => {} };
    expect(new ReadingMemory(() => foreign).all()).toEqual({ c: { up: "z" } });
  });
});
