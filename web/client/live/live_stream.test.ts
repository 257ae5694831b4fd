/** Live poses with the real engine and stream on this thread, and a clock that the tests advance. */
import { afterEach, describe, expect, test } from "vitest";
import { InlineWorker } from "../../../tests/inline_worker";
import { POSE_FLOATS } from "../../humanoid";
import { EngineClient } from "../engine_client";
import type { StylizeOptions } from "../protocol";
import { LiveStream } from "./live_stream";
import type { StreamFrame } from "./protocol";

const RATE_HZ = 60;

let engine: EngineClient | undefined;
let live: LiveStream | undefined;
afterEach(() => {
  live?.dispose();
  engine?.dispose();
  [live, engine] = [undefined, undefined];
});

/** A performer that sends the built-in walk, and the frames displayed. */
async function performer(options: Partial<StylizeOptions> = {}) {
  const workers: InlineWorker[] = [];
  engine = new EngineClient({
    spawn: () => {
      workers.push(new InlineWorker());
      return workers.at(-1)!;
    },
  });
  const database = await engine.openDatabase({ kind: "demo" });
  const [name] = await engine.builtInMotions();
  const { poses } = await (await engine.openMotion({ kind: "built-in", name: name! })).on(database);
  let nowSecs = 100;
  const stream = await LiveStream.open(engine, database, { delaySecs: 0.02, follows: true, options }, () => nowSecs);
  live = stream;
  const seen: StreamFrame[] = [];
  stream.onFrame = (frame) => seen.push(frame);
  const poseAt = (i: number) => poses.slice(i * POSE_FLOATS, (i + 1) * POSE_FLOATS);
  return {
    stream,
    seen,
    poseAt,
    database,
    fault: () => {
      workers.at(-1)!.faultAt = "push";
    },
    wait: (secs: number) => {
      nowSecs += secs;
    },
    /** Sends frames of the walk and advances after each; `moved` is the offset from its original position. */
    async perform(first: number, count: number, moved = 0) {
      for (let i = first; i < first + count; i++) {
        const pose = poseAt(i);
        pose[0]! += moved;
        stream.push(nowSecs, pose);
        nowSecs += 1 / RATE_HZ;
        await stream.advance();
      }
    },
  };
}

const distance = (a: Float32Array, b: Float32Array) => Math.hypot(a[0]! - b[0]!, a[2]! - b[2]!);
/** The largest distance that the figure moves in a frame, metres. */
const farthest = (seen: readonly StreamFrame[]) =>
  Math.max(...seen.slice(1).map(({ pose }, i) => distance(pose, seen[i]!.pose)));
/** Sum of the differences of rotations. */
const difference = (a: Float32Array, b: Float32Array) =>
  a.slice(3).reduce((sum, value, i) => sum + Math.abs(value - b[3 + i]!), 0);

describe("a performer", () => {
  test("is shown a frame a frame in a style, beside where they are", async () => {
    const { stream, seen, poseAt, perform } = await performer({ styles: { old: 1 } });
    await perform(0, 120);
    expect(seen.length).toBeGreaterThan(115);
    expect(seen.map(({ frame }) => frame)).toEqual(seen.map((_, i) => i));
    const last = seen.at(-1)!;
    expect(last.pose.every(Number.isFinite)).toBe(true);
    expect(difference(last.pose, last.inputPose)).toBeGreaterThan(1);
    expect(distance(last.pose, last.inputPose)).toBeLessThan(1);
    // The displayed pose was sent one delay earlier.
    expect(distance(last.inputPose, poseAt(118))).toBeLessThan(0.05);
    expect(last.reads[0]!.action).toBe("walk");
    expect(seen.some(({ planted }) => planted[0]) && seen.some(({ planted }) => planted[1])).toBe(true);
    expect(stream.stats).toMatchObject({ taken: 120, refused: 0, missing: 0, play: "sent", frames: seen.length });
    expect(1 / stream.stats.periodSecs).toBeCloseTo(RATE_HZ, 3);
  });

  test("changes styles within a frame", async () => {
    const { stream, seen, perform } = await performer();
    await perform(0, 60);
    const before = seen.at(-1)!;
    expect(difference(before.pose, before.inputPose)).toBeLessThan(1);
    stream.configure({ styles: { old: 1 } }, 0);
    await perform(60, 2);
    expect(difference(seen.at(-1)!.pose, seen.at(-1)!.inputPose)).toBeGreaterThan(1);
    expect(() => stream.configure({ styles: { none: 1 } })).toThrow("The database has no style 'none'.");
  });

  test("who is lost stays on screen, and goes on from there when they are back elsewhere", async () => {
    const { stream, seen, perform, wait } = await performer({ styles: { old: 1 } });
    await perform(0, 90);
    const unbroken = farthest(seen);
    for (let i = 0; i < 60; i++) {
      wait(1 / RATE_HZ);
      await stream.advance();
    }
    expect(stream.stats).toMatchObject({ play: "lost", losses: 0 });
    const left = seen.length;
    expect(left).toBeLessThan(130);
    await perform(0, 60, 5);
    expect(seen.length).toBeGreaterThan(left + 50);
    expect(stream.stats).toMatchObject({ play: "sent", losses: 1 });
    expect(farthest(seen)).toBeLessThan(unbroken + 0.02);
  });

  test("goes on without a leap where the page was out of sight", async () => {
    const { seen, perform, wait, stream, poseAt } = await performer();
    await perform(0, 60);
    const [before, unbroken] = [seen.length, farthest(seen)];
    // Frames arrived meanwhile, but none were requested.
    for (let i = 60; i < 200; i++) {
      stream.push(100 + i / RATE_HZ, poseAt(i));
      wait(1 / RATE_HZ);
    }
    await stream.advance();
    expect(seen.length).toBe(before + 1);
    await perform(200, 30);
    expect(farthest(seen)).toBeLessThan(unbroken + 0.02);
  });
});

describe("what goes wrong", () => {
  test("numbers that are no pose are counted, and the others are shown", async () => {
    const { stream, seen, perform, poseAt } = await performer();
    await perform(0, 30);
    const bad = poseAt(30);
    bad[10] = Number.NaN;
    for (const numbers of [bad, new Float32Array(3), new Float32Array(POSE_FLOATS)])
      expect(stream.push(101, numbers)).toBe(false);
    await perform(30, 30);
    expect(stream.stats.refused).toBe(3);
    expect(seen.length).toBeGreaterThan(55);
  });

  test("a skeleton that is no body's is refused with a sentence, and the one before stays", async () => {
    const { stream, perform, seen } = await performer();
    await perform(0, 10);
    const joints = { names: ["a", "b"], parents: [-1, 0], offsets: [0, 0, 0, 0, 1, 0], unit: 1 };
    expect(() => {
      stream.skeleton = { kind: "joints", ...joints };
    }).toThrow(/^No .* in this skeleton\. .*\.$/);
    expect(() => {
      stream.skeleton = { kind: "bvh", header: "HIERARCHY\nROOT {" };
    }).toThrow(/^Line 2, /);
    await perform(10, 20);
    expect(seen.length).toBeGreaterThan(25);
  });

  test("after a fault of the engine the figure goes on where it was", async () => {
    const { seen, perform, fault } = await performer({ styles: { old: 1 } });
    await perform(0, 60);
    const unbroken = farthest(seen);
    fault();
    await expect(perform(60, 1)).rejects.toMatchObject({ code: "fault" });
    await perform(61, 60);
    expect(seen.length).toBeGreaterThan(110);
    expect(farthest(seen)).toBeLessThan(unbroken + 0.05);
  });
});
