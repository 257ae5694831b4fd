import { describe, expect, it } from "vitest";
import { MAX_POINTS } from "../../state/key_style";
import { keysOf, lengthOf, Recorder, valuesAt } from "./trail";

/** A pointer that moves one unit per second, sampled sixty times per second. */
function drag(secs: number): Recorder {
  const recorder = new Recorder();
  recorder.begin();
  for (let frame = 0; frame <= secs * 60; frame++) recorder.add(100 + frame / 60, [frame / 60, -frame / 60]);
  return recorder;
}

describe("a trail", () => {
  it("begins at no time, keeps its end, and is where the hand was", () => {
    const { trail } = drag(1.03);
    expect(trail[0]).toEqual({ secs: 0, values: [0, -0] });
    expect(lengthOf(trail)).toBeCloseTo(1.02, 1);
    expect(valuesAt(trail, 0.512)[0]).toBeCloseTo(0.512, 1);
    expect(valuesAt(trail, -1)[0]).toBe(0);
    expect(valuesAt(trail, 99)).toEqual(trail.at(-1)!.values);
    for (const [i, { secs }] of trail.entries()) expect(i === 0 || secs > trail[i - 1]!.secs).toBe(true);
  });

  it("forgets what is long past", () => {
    const { trail } = drag(20);
    expect(trail.length).toBeLessThanOrEqual(MAX_POINTS);
    expect(trail[0]!.values[0]).toBeGreaterThan(13);
  });

  it("is none before anything moved", () => {
    expect(new Recorder().trail).toEqual([]);
    expect(lengthOf([])).toBe(0);
  });

  it("becomes keys", () => {
    const keys = keysOf(drag(2).trail, 0.5, 60);
    expect(keys.map(({ secs }) => secs)).toEqual([0, 0.5, 1, 1.5, 2]);
    expect(keys[2]!.values[0]).toBeCloseTo(1);
    expect(keysOf(drag(2).trail, 0.01, 12)).toHaveLength(12);
    expect(keysOf(drag(0).trail, 0.5, 60)).toHaveLength(1);
  });
});
