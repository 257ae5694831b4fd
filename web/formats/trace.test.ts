import { describe, expect, it } from "vitest";
import { traceAsCsv, traceAsJson } from "./trace";

const traced = {
  analysis: {
    poses: new Float32Array(0),
    timeOut: Float32Array.from([0, 0.02]),
    planted: Uint8Array.from([1, 0, 1, 1]),
    classWeights: Float32Array.from([1, 0, 0, 0.75, 0.25, 0]),
    durationOutSecs: 0.04,
    distanceMetres: undefined,
  },
  input: { rateHz: 50 },
  classes: [
    { action: "walk", style: "neutral", frames: 9 },
    { action: "walk", style: "old, very", frames: 9 },
    { action: "run", style: "neutral", frames: 9 },
  ],
};

describe("a trace", () => {
  it("is a line of JSON a frame, as the command writes it", () => {
    expect(
      traceAsJson(traced)
        .trim()
        .split("\n")
        .map((line) => JSON.parse(line)),
    ).toEqual([
      { frame: 0, time_in: 0, time_out: 0, dt: 0, class_weights: { "walk/neutral": 1 }, planted: [1, 0] },
      {
        frame: 1,
        time_in: 0.02,
        time_out: 0.02,
        dt: 0.02,
        class_weights: { "walk/neutral": 0.75, "walk/old, very": 0.25 },
        planted: [1, 1],
      },
    ]);
  });

  it("is a table with a column for each class that has a weight", () => {
    expect(traceAsCsv(traced)).toBe(
      'frame,time_in,time_out,dt,planted_left,planted_right,walk/neutral,"walk/old, very"\n' +
        "0,0,0,0,1,0,1,0\n1,0.02,0.02,0.02,1,1,0.75,0.25\n",
    );
  });

  it("holds no formulas, and quotes every line break", () => {
    const [walk] = traced.classes;
    const classes = ["=HYPERLINK(1)", "+1", "-1", "@a", "two\rlines"].map((action) => ({ ...walk!, action }));
    const classWeights = Float32Array.from(Array.from({ length: 10 }, () => 0.2));
    const [header] = traceAsCsv({ ...traced, classes, analysis: { ...traced.analysis, classWeights } }).split("\n");
    expect(header).toBe(
      "frame,time_in,time_out,dt,planted_left,planted_right," +
        `'+1/neutral,'-1/neutral,'=HYPERLINK(1)/neutral,'@a/neutral,"two\rlines/neutral"`,
    );
  });
});
