import { describe, expect, it } from "vitest";
import { JOINTS, POSE_FLOATS } from "../../../../humanoid";
import { CURVES, curveOf, plantedStretches, readStretches, spanOf, timingMap, unitOf, valueAt } from "./curves";

/** A T-pose with one joint rotated by `degrees` about an axis. */
function turned(joint: number, axis: [number, number, number], degrees: number): Float32Array {
  const pose = new Float32Array(POSE_FLOATS);
  for (let j = 0; j < JOINTS; j++) pose[3 + 4 * j + 3] = 1;
  const half = (degrees * Math.PI) / 360;
  pose.set([...axis.map((a) => a * Math.sin(half)), Math.cos(half)], 3 + 4 * joint);
  return pose;
}

describe("joint angles", () => {
  it("are the bend of knees and elbows", () => {
    expect(valueAt(turned(14, [1, 0, 0], 60), 0, CURVES["knee L"]!)).toBeCloseTo(60, 3);
    expect(valueAt(turned(11, [0, 1, 0], 90), 0, CURVES["elbow R"]!)).toBeCloseTo(90, 3);
  });

  it("are positive forward for hips and leans", () => {
    expect(valueAt(turned(13, [1, 0, 0], -30), 0, CURVES["hip L"]!)).toBeCloseTo(30, 3);
    expect(valueAt(turned(2, [1, 0, 0], 20), 0, CURVES["chest lean"]!)).toBeCloseTo(20, 3);
  });

  it("are the components of every joint's rotation vector", () => {
    const y = CURVES["left hand y"]!;
    expect(valueAt(turned(8, [0, 1, 0], 170), 0, y)).toBeCloseTo(170, 3);
    expect(valueAt(turned(8, [0, 1, 0], 200), 0, y), "the short way").toBeCloseTo(-160, 3);
    expect(valueAt(turned(8, [0, 1, 0], 0), 0, y)).toBe(0);
    expect([unitOf(y), unitOf(CURVES["hips height"]!)]).toEqual(["°", "cm"]);
  });

  it("come one a frame", () => {
    const clip = new Float32Array([...turned(18, [1, 0, 0], 10), ...turned(18, [1, 0, 0], 40)]);
    const curve = curveOf(clip, CURVES["knee R"]!);
    expect(curve[0]).toBeCloseTo(10, 3);
    expect(curve[1]).toBeCloseTo(40, 3);
  });

  it("share a span that a still joint does not blow up", () => {
    expect(spanOf([], 20)).toBeUndefined();
    const still = spanOf([new Float32Array([10, 10.5])], 20)!;
    expect(still.high - still.low).toBeGreaterThan(20);
    const wide = spanOf([new Float32Array([0, 50]), new Float32Array([-50])], 20)!;
    expect([wide.low, wide.high]).toEqual([-56, 56]);
  });
});

describe("the rows of the timeline", () => {
  it("hold a block for each time a foot is planted", () => {
    const left = [1, 1, 0, 0, 1];
    const contacts = Uint8Array.from(left.flatMap((l) => [l, 1 - l]));
    expect(plantedStretches(contacts, 0)).toEqual([
      [0, 2],
      [4, 5],
    ]);
    expect(plantedStretches(contacts, 1)).toEqual([[2, 4]]);
    expect(plantedStretches(new Uint8Array(0), 0)).toEqual([]);
  });

  it("join the times of input and output at even distances of the input", () => {
    const timeOut = Float32Array.from([0, 0.25, 0.5, 0.75, 1]);
    expect(timingMap(timeOut, 2)).toEqual([
      { frame: 0, timeOut: 0 },
      { frame: 2, timeOut: 0.5 },
      { frame: 4, timeOut: 1 },
    ]);
    expect(timingMap(new Float32Array(0), 2)).toEqual([]);
  });

  it("hold a stretch for each class that the input is read as", () => {
    const weights = Float32Array.from([0.75, 0.25, 1, 0, 0.25, 0.75]);
    expect(readStretches(weights, 2)).toEqual([
      { from: 0, to: 2, class: 0, weight: 0.875 },
      { from: 2, to: 3, class: 1, weight: 0.75 },
    ]);
    expect(readStretches(new Float32Array(0), 0)).toEqual([]);
  });
});
