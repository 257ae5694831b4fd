import { describe, expect, test } from "vitest";
import { weightsAt } from "../../engine/style_track";
import { POSE_FLOATS } from "../../humanoid";
import { Recording } from "./recording";

const pose = (number: number) => new Float32Array(POSE_FLOATS).fill(number);

/** A recording of frames that contain their index, in a style whose weight is `of(frame)`. */
function recorded(frames: number, of: (frame: number) => number): Recording {
  const recording = new Recording(["old"]);
  for (let frame = 0; frame < frames; frame++) recording.add(pose(frame), Float32Array.of(of(frame)));
  return recording;
}

describe("frames", () => {
  test("are given as they came", () => {
    const recording = recorded(2500, () => 0);
    const last = recording.last(900);
    expect([recording.frames, last.length / POSE_FLOATS]).toEqual([2500, 900]);
    for (const frame of [0, 450, 899]) expect(last[frame * POSE_FLOATS]).toBe(1600 + frame);
    expect(recording.last(9999).length / POSE_FLOATS).toBe(2500);
  });

  test("of the last five minutes are kept", () => {
    const recording = recorded(25_000, () => 0);
    expect(recording.frames).toBeGreaterThanOrEqual(18_000);
    expect(recording.frames).toBeLessThanOrEqual(19_800);
    expect(recording.last(1)[0]).toBe(24_999);
  });
});

describe("styles", () => {
  test("that do not change are one key", () => {
    expect(recorded(100, () => 0.5).track(100)).toEqual([{ frame: 0, styles: { old: 0.5 } }]);
  });

  test("are shown again as they were", () => {
    // Zero for two seconds, then a ramp of half a second to 1, and a sudden return to 0.
    const weight = (frame: number) => (frame < 120 ? 0 : frame < 150 ? (frame - 120) / 30 : frame < 300 ? 1 : 0);
    const track = recorded(400, weight).track(400);
    const keys = track.map(({ frame, styles }) => ({ frame, weights: Float32Array.of(styles.old ?? 0) }));
    const out = new Float32Array(1);
    for (let frame = 0; frame < 400; frame++) {
      weightsAt(keys, frame, out);
      // A sudden change takes as long as the distance of the keys.
      const isLeap = Math.abs(frame - 300) <= 6;
      expect(Math.abs(out[0]! - weight(frame)), `frame ${frame}`).toBeLessThan(isLeap ? 1.01 : 0.21);
      if (frame < 110 || (frame > 160 && frame < 290) || frame > 310)
        expect(out[0], `frame ${frame}`).toBeCloseTo(weight(frame), 2);
    }
    expect(track.at(-1)!.styles).toEqual({});
    expect(track.every(({ frame }, i) => i === 0 || frame > track[i - 1]!.frame)).toBe(true);
    expect(track.length).toBeLessThan(16);
  });

  test("that are eased end where they come to", () => {
    const eased = (frame: number) => (frame < 100 ? Math.fround(1 - 0.9 ** frame) : 1);
    expect(recorded(200, eased).track(200).at(-1)!.styles).toEqual({ old: 1 });
  });

  test("of the last frames begin with what they were then", () => {
    const track = recorded(1000, (frame) => (frame < 500 ? 0.2 : 0.8)).track(100);
    expect(track).toEqual([{ frame: 0, styles: { old: 0.8 } }]);
  });
});
