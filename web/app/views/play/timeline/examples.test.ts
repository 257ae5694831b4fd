import { describe, expect, it } from "vitest";
import { CURVES } from "./curves";
import { exampleCurves } from "./examples";

/** A rotation by `degrees` about +X. */
const pitched = (degrees: number): number[] => {
  const half = (degrees * Math.PI) / 360;
  return [Math.sin(half), 0, 0, Math.cos(half)];
};

describe("the examples beside a curve", () => {
  it("make a band of their weighted mean and standard deviation, frame by frame", () => {
    const examples = {
      subject: 14,
      counts: Uint16Array.of(2, 1),
      weights: Float32Array.of(1, 0.5, 1),
      values: Float32Array.from([...pitched(10), ...pitched(40), ...pitched(70)]),
    };
    const curves = exampleCurves(examples, CURVES["knee L"]!, Float32Array.of(20, 60));
    expect([...curves.starts]).toEqual([0, 2, 3]);
    expect([...curves.values].map(Math.round)).toEqual([10, 40, 70]);
    const deviation = Math.sqrt((100 + 0.5 * 400) / 1.5);
    expect(curves.low[0]).toBeCloseTo(20 - deviation, 2);
    expect(curves.high[0]).toBeCloseTo(20 + deviation, 2);
    expect([curves.low[1], curves.high[1]].map((v) => Math.round(v!))).toEqual([70, 70]);
  });

  it("are taken on the turn that is nearest to the curve's", () => {
    const values = Float32Array.from([...pitched(170), ...pitched(-170)]);
    const examples = { subject: 13, counts: Uint16Array.of(2), weights: Float32Array.of(1, 1), values };
    const { high, low } = exampleCurves(examples, CURVES["left upper leg x"]!, Float32Array.of(175));
    expect(low[0]).toBeCloseTo(170, 2);
    expect(high[0]).toBeCloseTo(190, 2);
  });

  it("are the height of the hips in centimetres", () => {
    const examples = {
      subject: "height" as const,
      counts: Uint16Array.of(1),
      weights: Float32Array.of(1),
      values: Float32Array.of(0.95),
    };
    expect(exampleCurves(examples, CURVES["hips height"]!, Float32Array.of(90)).values[0]).toBeCloseTo(95, 3);
  });

  it("leave the band on the curve where a frame has none", () => {
    const none = new Float32Array(0);
    const examples = { subject: 14, counts: Uint16Array.of(0), weights: none, values: none };
    const { low, high } = exampleCurves(examples, CURVES["knee L"]!, Float32Array.of(20));
    expect([low[0], high[0]]).toEqual([20, 20]);
  });
});
