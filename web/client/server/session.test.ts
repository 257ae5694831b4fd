import { describe, expect, test } from "vitest";
import type { Styled } from "../../engine/types";
import { DEFAULT_OPTIONS } from "../../engine/types";
import { POSE_FLOATS } from "../../humanoid";
import type { BodyPart, StyleWeights, StylizeOptions } from "../protocol";
import { heaviest } from "../readings";
import { MAX_STEP_SECS } from "./output_clock";
import { LiveSession, type OnlineStylizer, WARM_UP_FRAMES } from "./session";

const RATE_HZ = 60;
const FRAMES = 120;
/** Frame duration of the fake engine: longer than in the input. */
const FRAME_SECS = 0.02;
const CLASSES = [
  { action: "walk", style: "neutral", frames: 100 },
  { action: "walk", style: "old", frames: 100 },
];

/** An input whose root moves along x by 1 per frame. */
const input = { frames: FRAMES, rateHz: RATE_HZ, poses: new Float32Array(FRAMES * POSE_FLOATS) };
for (let i = 0; i < FRAMES; i++) input.poses[i * POSE_FLOATS] = i;

/**
 * A fake engine. The styled root starts at the input's and moves twice as far; its height is the weight of the second
 * style.
 */
class FakeStylizer implements OnlineStylizer {
  classes = CLASSES;
  weights = new Float32Array(2);
  pushed: number[] = [];
  resets = 0;
  configured = 0;
  private first: number | undefined;

  configure() {
    this.configured++;
  }
  setWeights(weights: Float32Array) {
    this.told++;
    this.weights = weights.slice();
  }
  /** Number of times that weights were set. */
  told = 0;
  parts = new Map<BodyPart, Float32Array>();
  setPartWeights(part: BodyPart, weights: Float32Array | undefined) {
    this.told++;
    if (weights) this.parts.set(part, weights.slice());
    else this.parts.delete(part);
  }
  weightsOf(styles: StyleWeights) {
    return new Float32Array([styles.neutral ?? 0, styles.old ?? 0]);
  }
  reset() {
    this.resets++;
    this.first = undefined;
  }
  push(poses: Float32Array): Styled {
    const count = poses.length / POSE_FLOATS;
    const out = poses.slice();
    const durations = new Float32Array(count).fill(FRAME_SECS);
    for (let i = 0; i < count; i++) {
      const x = poses[i * POSE_FLOATS]!;
      this.pushed.push(x);
      if (this.first === undefined) durations[i] = 0;
      this.first ??= x;
      out[i * POSE_FLOATS] = this.first + 2 * (x - this.first);
      out[i * POSE_FLOATS + 1] = this.weights[1]!;
    }
    const planted = new Uint8Array(2 * count).fill(1);
    return { poses: out, durations, planted, classWeights: new Float32Array([0.25, 0.75]) };
  }
}

const lerp = (a: Float32Array, b: Float32Array, t: number) => a.map((v, i) => v + (b[i]! - v) * t);
const old = (weight: number): StylizeOptions => ({ ...DEFAULT_OPTIONS, styles: { old: weight } });

function open(options = old(0)) {
  const stylizer = new FakeStylizer();
  return { stylizer, session: new LiveSession(stylizer, input, options, lerp) };
}

describe("the output clock", () => {
  test("a step of nothing shows the first frame", () => {
    const { session } = open();
    const frame = session.step(0);
    expect([frame.inputFrame, frame.timeOut, frame.pose[0]]).toEqual([0, 0, 0]);
    expect([frame.looped, frame.ended, frame.planted]).toEqual([false, false, [true, true]]);
  });

  test("runs in output time and shows what lies between two frames", () => {
    const { session, stylizer } = open();
    const frame = session.step(2.5 * FRAME_SECS);
    expect(frame.inputFrame).toBeCloseTo(2.5, 4);
    expect(frame.pose[0]).toBeCloseTo(5, 4);
    expect(frame.inputPose[0]).toBeCloseTo(2.5, 4);
    expect(frame.timeOut).toBeCloseTo(2.5 * FRAME_SECS, 9);
    expect(stylizer.pushed).toEqual([0, 1, 2, 3]);
  });

  test("many small steps come to the same as few large ones", () => {
    const [a, b] = [open().session, open().session];
    let fine = a.step(0);
    for (let i = 0; i < 100; i++) fine = a.step(0.007);
    const coarse = b.step(0.7);
    expect(fine.inputFrame).toBeCloseTo(coarse.inputFrame, 4);
    expect(fine.pose[0]).toBeCloseTo(coarse.pose[0]!, 3);
  });

  test("does not catch up on a long sleep", () => {
    const { session } = open();
    expect(session.step(3600).timeOut).toBeCloseTo(MAX_STEP_SECS, 9);
  });

  test("names the classes, heaviest first, without those that have no weight", () => {
    const { session } = open();
    expect(session.step(0).reads).toEqual([
      { action: "walk", style: "old", weight: 0.75 },
      { action: "walk", style: "neutral", weight: 0.25 },
    ]);
    expect(heaviest(CLASSES, new Float32Array([0, 1]))).toHaveLength(1);
  });
});

describe("the end of the clip", () => {
  const clipSecs = (FRAMES - 1) * FRAME_SECS;

  test("begins anew with the rest of the step", () => {
    const { session, stylizer } = open();
    const frames = [1, 1, clipSecs - 2 + 0.5 * FRAME_SECS].map((dt) => session.step(dt));
    expect(frames.map((f) => f.looped)).toEqual([false, false, true]);
    expect(frames[2]!.inputFrame).toBeCloseTo(0.5, 4);
    expect(frames[2]!.timeOut).toBeCloseTo(0.5 * FRAME_SECS, 6);
    expect(stylizer.resets).toBe(2);
    expect(session.step(FRAME_SECS).looped).toBe(false);
  });

  test("is the last frame when looping is off, until looping is on again", () => {
    const { session } = open();
    session.loop = false;
    for (let i = 0; i < 3; i++) session.step(1);
    const last = session.step(1);
    expect([last.inputFrame, last.ended, last.looped]).toEqual([FRAMES - 1, true, false]);
    expect(last.timeOut).toBeCloseTo(clipSecs, 5);
    session.loop = true;
    const again = session.step(FRAME_SECS);
    expect([again.looped, again.ended]).toEqual([true, false]);
  });

  test("a clip of one frame stands still", () => {
    const one = { ...input, frames: 1 };
    const session = new LiveSession(new FakeStylizer(), one, old(0), lerp);
    expect(session.step(0.5).inputFrame).toBe(0);
    expect(session.seek(7).inputFrame).toBe(0);
  });
});

describe("a range", () => {
  test("begins anew at its first frame", () => {
    const { session } = open();
    session.range = { first: 30, last: 40 };
    expect(session.step(0).inputFrame).toBe(30);
    expect(session.step(9.5 * FRAME_SECS).inputFrame).toBeCloseTo(39.5, 4);
    const again = session.step(FRAME_SECS);
    expect(again.looped).toBe(true);
    expect(again.inputFrame).toBeCloseTo(30.5, 4);
  });

  test("ends at its last frame when looping is off; scrubbing may leave it", () => {
    const { session } = open();
    session.range = { first: 30, last: 40 };
    session.loop = false;
    session.seek(35);
    const end = session.step(1);
    expect([end.inputFrame, end.ended]).toEqual([40, true]);
    expect(session.seek(80.5).inputFrame).toBeCloseTo(80.5, 4);
  });
});

describe("a seek", () => {
  test("warms up on the second before it and stands where the input does", () => {
    const { session, stylizer } = open();
    const frame = session.seek(90.25);
    expect(stylizer.pushed[0]).toBe(90 - WARM_UP_FRAMES);
    expect(stylizer.pushed.at(-1)).toBe(91);
    expect(frame.inputFrame).toBeCloseTo(90.25, 4);
    expect(frame.pose[0]).toBeCloseTo(90.25, 4);
    expect(frame.timeOut).toBeCloseTo(0.25 * FRAME_SECS, 6);
  });

  test("goes on from there", () => {
    const { session } = open();
    const before = session.seek(90);
    const after = session.step(2 * FRAME_SECS);
    expect(after.pose[0]! - before.pose[0]!).toBeCloseTo(4, 3);
    expect(after.inputFrame).toBeCloseTo(92, 4);
  });

  test("stays within the clip, whatever it is asked for", () => {
    const { session } = open();
    expect(session.seek(-5).inputFrame).toBe(0);
    expect(session.seek(1e9).inputFrame).toBe(FRAMES - 1);
    expect(session.seek(Number.NaN).inputFrame).toBe(0);
  });
});

describe("a change of style", () => {
  test("fades in with its half-life while playing", () => {
    const { session } = open();
    session.step(10 * FRAME_SECS);
    session.configure(old(1));
    // 6 input frames are 100 ms, one half-life; the displayed pose is the later of its two frames.
    const heights = Array.from({ length: 60 }, () => session.step(FRAME_SECS).pose[1]!);
    expect(heights[0]).toBeGreaterThan(0);
    expect(heights[5]).toBeGreaterThan(0.4);
    expect(heights[5]).toBeLessThan(0.6);
    for (let i = 1; i < heights.length; i++) expect(heights[i]).toBeGreaterThanOrEqual(heights[i - 1]!);
    expect(heights.at(-1)).toBeCloseTo(1, 2);
  });

  test("acts at once on a resting character, which stays where it stands", () => {
    const { session, stylizer } = open();
    const before = session.step(40.5 * FRAME_SECS);
    session.configure(old(1));
    const after = session.step(0);
    expect(after.pose[1]).toBeCloseTo(1, 5);
    expect(after.pose[0]).toBeCloseTo(before.pose[0]!, 3);
    expect(after.inputFrame).toBeCloseTo(before.inputFrame, 4);
    expect(after.timeOut).toBeCloseTo(before.timeOut, 6);
    const pushes = stylizer.pushed.length;
    session.step(0);
    expect(stylizer.pushed.length, "nothing changed, nothing is done").toBe(pushes);
    const next = session.step(FRAME_SECS);
    expect(next.pose[0]! - after.pose[0]!).toBeCloseTo(2, 3);
  });

  test("that is refused leaves the old one", () => {
    const { session, stylizer } = open(old(0.5));
    stylizer.weightsOf = () => {
      throw new Error("no such style");
    };
    expect(() => session.configure(old(1))).toThrow("no such style");
    expect(session.step(0).pose[1]).toBeCloseTo(0.5, 6);
    expect(stylizer.configured, "nothing else of it holds").toBe(1);
  });

  test("is not taken up where the engine refuses other options", () => {
    const { session, stylizer } = open(old(0.5));
    stylizer.configure = () => {
      throw new Error("k is 0");
    };
    expect(() => session.configure(old(1))).toThrow("k is 0");
    for (let i = 0; i < 60; i++) session.step(FRAME_SECS);
    expect(session.step(0).pose[1]).toBeCloseTo(0.5, 6);
  });
});

describe("a part of the body", () => {
  const legs = (weight: number): StylizeOptions => ({ ...old(0), parts: { legs: { old: weight } } });

  test("has its own styles from the start", () => {
    const { stylizer } = open(legs(1));
    expect([...stylizer.parts]).toEqual([["legs", new Float32Array([0, 1])]]);
  });

  test("costs nothing once its styles have arrived", () => {
    const { session, stylizer } = open(legs(1));
    session.step(FRAME_SECS);
    const told = stylizer.told;
    for (let i = 0; i < 20; i++) session.step(FRAME_SECS);
    expect(stylizer.told).toBe(told);
  });

  test("takes up its own styles from those of the whole body, and follows it again at once", () => {
    const { session, stylizer } = open(old(0));
    session.step(FRAME_SECS);
    session.configure(legs(1));
    session.step(FRAME_SECS);
    const early = stylizer.parts.get("legs")![1]!;
    expect(early).toBeGreaterThan(0);
    expect(early).toBeLessThan(0.5);
    for (let i = 0; i < 60; i++) session.step(FRAME_SECS);
    expect(stylizer.parts.get("legs")![1]).toBe(1);
    session.configure(old(0));
    session.step(FRAME_SECS);
    expect(stylizer.parts.size).toBe(0);
  });
});

describe("a style track", () => {
  const track: StylizeOptions = {
    ...old(0),
    track: [
      { frame: 40, styles: {} },
      { frame: 60, styles: { old: 1 } },
    ],
  };

  test("is followed frame by frame while playing", () => {
    const { session, stylizer } = open(track);
    const height = (frames: number) => {
      session.step(frames * FRAME_SECS);
      return stylizer.weights[1]!;
    };
    expect(height(39)).toBe(0);
    // The engine is a frame ahead of the display.
    expect(height(11)).toBeCloseTo(11 / 20, 5);
    expect(height(20)).toBe(1);
  });

  test("shows the styles of the frame that is sought", () => {
    const { session } = open(track);
    expect(session.seek(50).pose[1]).toBeCloseTo(0.5, 5);
    expect(session.seek(10).pose[1]).toBe(0);
  });
});

test("options that the engine refuses change nothing, their styles neither", () => {
  const { session, stylizer } = open(old(0));
  session.step(FRAME_SECS);
  stylizer.configure = () => {
    throw new Error("refused");
  };
  expect(() => session.configure(old(1))).toThrow("refused");
  for (let i = 0; i < 50; i++) session.step(FRAME_SECS);
  expect(stylizer.weights[1]).toBe(0);
});
