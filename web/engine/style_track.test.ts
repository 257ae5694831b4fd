import { describe, expect, it } from "vitest";
import { weightsAt } from "./style_track";

const keys = [
  { frame: 10, weights: new Float32Array([1, 0]) },
  { frame: 20, weights: new Float32Array([0, 1]) },
  { frame: 40, weights: new Float32Array([0, 0.5]) },
];

/** The weights at a frame. */
function at(frame: number): number[] {
  const out = new Float32Array(2);
  weightsAt(keys, frame, out);
  return [...out];
}

describe("a style track", () => {
  it("stands still before its first key and after its last", () => {
    expect([at(0), at(9), at(40), at(1000)]).toEqual([
      [1, 0],
      [1, 0],
      [0, 0.5],
      [0, 0.5],
    ]);
  });

  it("goes straight from key to key, as long as they are apart", () => {
    expect([at(10), at(15), at(20), at(30)]).toEqual([
      [1, 0],
      [0.5, 0.5],
      [0, 1],
      [0, 0.75],
    ]);
  });
});
