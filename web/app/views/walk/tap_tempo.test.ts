import { describe, expect, it } from "vitest";
import { TapTempo } from "./tap_tempo";

describe("a beaten tempo", () => {
  it("is the mean of the last beats", () => {
    const tempo = new TapTempo();
    expect(tempo.tap(1000)).toBeUndefined();
    expect(tempo.tap(1500)).toBe(120);
    expect(tempo.tap(2100)).toBeCloseTo(109.1, 1);
    for (const at of [2600, 3100, 3600, 4100, 4600]) tempo.tap(at);
    expect(tempo.tap(5100), "the slow beat is forgotten").toBe(120);
  });

  it("begins anew after a pause", () => {
    const tempo = new TapTempo();
    tempo.tap(0);
    tempo.tap(500);
    expect(tempo.tap(9000)).toBeUndefined();
    expect(tempo.tap(10_000)).toBe(60);
  });
});
