import { describe, expect, it } from "vitest";
import type { FileReading } from "../client/protocol";
import { decodeReading, encodeReading, sameReading, saysNothing } from "./reading";

describe("a reading in a link", () => {
  it("is read as it was written", () => {
    const readings: FileReading[] = [
      {},
      { up: "-z", floor: -0.93, mirrored: false, unit: 0.0254 },
      { swapSides: true },
      { joints: {} },
      { joints: { hips: "Bip01", left_hand: "L ~ Hand; №1", chest: null } },
    ];
    for (const reading of readings) expect(decodeReading(encodeReading(reading))).toEqual(reading);
    expect(encodeReading({ up: "z", joints: { chest: null } })).toBe("up~z;joints~1;chest~");
  });

  it("is none where an entry is none", () => {
    for (const text of ["up", "up~w", "floor~", "floor~low", "unit~0", "mirrored~2", "tail~Tail", "joints~1;hips~%"])
      expect(decodeReading(text), text).toBeUndefined();
    // Names of roles alone do not mean that the joints were mapped.
    expect(decodeReading("hips~Bip01")).toEqual({});
  });

  it("is compared by what it says", () => {
    expect(sameReading({ up: "z", unit: 1 }, { unit: 1, up: "z" })).toBe(true);
    expect(sameReading({}, { mirrored: false })).toBe(false);
    expect([saysNothing({}), saysNothing({ floor: 0 })]).toEqual([true, false]);
  });
});
