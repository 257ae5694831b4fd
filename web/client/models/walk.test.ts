/** Walk models trained as on the page, and their walks: real packages on this thread. */

import { beforeAll, describe, expect, it } from "vitest";
import { InlineBuildWorker } from "../../../tests/inline_build_worker";
import { POSE_FLOATS } from "../../humanoid";
import type { TrainedWalk } from "../build/protocol";
import { type JointPath, openWalk, trainWalk, WalkModel, type Weights } from "./walk";

const spawn = () => new InlineBuildWorker();

let trained: TrainedWalk;
let model: WalkModel;
const heard: { label: string; fraction: number }[] = [];

beforeAll(async () => {
  trained = await trainWalk(undefined, { onProgress: (progress) => heard.push(progress) }, spawn);
  model = await openWalk({ file: trained.file });
});

/** One style for the steps of both feet, or another one for those of the right foot. */
const alone = (style: string, weight = 1, right = style): Weights => {
  const of = (wanted: string) => Float32Array.from(model.styles, (name) => (name === wanted ? weight : 0));
  return [of(style), of(right)];
};
/** Poses of `frames` frames. */
function walk(frames: number, weights: Weights, turn = 0): { way: number; aside: number; steps: number } {
  const walker = model.walker();
  walker.plan(weights, []);
  walker.turn = turn;
  walker.reset();
  for (let i = 0; i < frames; i++) walker.next();
  const { pose, step } = walker.frame;
  walker.dispose();
  return { way: pose[2]!, aside: pose[0]!, steps: step };
}

describe("training", () => {
  it("makes a small model of the built-in walks, says how far it is, and what it left out", () => {
    expect(model.styles).toEqual(["angry", "childlike", "depressed", "neutral", "old", "proud", "sexy", "strutting"]);
    expect(trained.file.length).toBeLessThan(300_000);
    expect(heard[0]!.label).toMatch(/^Reading \d+ walks, 1 done\.$/);
    const fractions = heard.map(({ fraction }) => fraction);
    expect(fractions).toEqual([...fractions].sort((a, b) => a - b));
    expect(fractions.at(-1)).toBe(1);
    expect(trained.refused[0]!.reason).toMatch(/^The body faces .*\.$/);
  });

  it("refuses what is no database and no model", async () => {
    const database = new Blob(["HIERARCHY"]);
    await expect(openWalk({ database }, {}, spawn)).rejects.toMatchObject({ code: "bad-file" });
    await expect(openWalk({ file: new TextEncoder().encode("HIERARCHY") })).rejects.toThrow(/not a walk model/);
  });
});

describe("walking", () => {
  it("goes ahead in every style, and to the left where it shall", () => {
    for (const style of model.styles) {
      const { way, aside, steps } = walk(300, alone(style));
      expect(way, style).toBeGreaterThan(3);
      expect(Math.abs(aside), style).toBeLessThan(0.2 * way);
      expect(steps, style).toBeGreaterThan(10);
    }
    expect(walk(150, alone("neutral"), 0.1).aside).toBeGreaterThan(1);
  });

  it("stops, and goes again with shorter steps", () => {
    const walker = model.walker();
    walker.plan(alone("neutral"), []);
    walker.reset();
    const way = (frames: number) => {
      const from = walker.frame.pose[2]!;
      for (let i = 0; i < frames; i++) walker.next();
      return walker.frame.pose[2]! - from;
    };
    const before = way(150);
    walker.walks = false;
    way(60);
    expect(way(60)).toBeLessThan(0.01);
    walker.walks = true;
    walker.stride = 0.7;
    way(45);
    const share = way(150) / before;
    expect(share).toBeGreaterThan(0.6);
    expect(share).toBeLessThan(0.8);
  });

  it("differs from style to style, and ends where it always ends", () => {
    expect(walk(200, alone("old")).way).toBeLessThan(0.9 * walk(200, alone("proud")).way);
    expect(walk(200, alone("old"))).toEqual(walk(200, alone("old")));
  });

  it("limps where the feet are given different styles", () => {
    const between = walk(300, alone("proud", 1, "old")).way;
    expect(between).toBeGreaterThan(1.02 * walk(300, alone("old")).way);
    expect(between).toBeLessThan(0.98 * walk(300, alone("proud")).way);
  });

  it("falls in with a beat", () => {
    const walker = model.walker();
    walker.plan(alone("neutral"), []);
    walker.tempo = { kind: "fixed", cadence: 100 };
    walker.reset();
    for (let i = 0; i < 25; i++) walker.next();
    // 18 frames per step; the beat is now, in the middle of a step.
    walker.beatNow(100);
    const strikes: number[] = [];
    for (let frame = 1, { step } = walker.frame; frame < 250; frame++) {
      if (walker.next().step !== step) strikes.push(frame);
      step = walker.frame.step;
    }
    const off = strikes.map((frame) => ((frame + 9) % 18) - 9);
    expect(off.length).toBeGreaterThan(12);
    expect(Math.max(...off.slice(6).map(Math.abs)), off.join(" ")).toBeLessThanOrEqual(1);
    // Setting the tempo again in another frame does not change the beat.
    walker.tempo = { kind: "fixed", cadence: 100 };
    walker.next();
    expect(walker.frame.durations.reduce((sum, secs) => sum + secs)).toBeCloseTo(18, 0);
  });

  it("takes the screen's time, in any portions", () => {
    const [one, other] = [model.walker(), model.walker()];
    for (let i = 0; i < 60; i++) one.advance(1 / 60);
    for (let i = 0; i < 10; i++) other.advance(0.1);
    for (let i = 0; i < POSE_FLOATS; i++) expect(one.frame.pose[i]).toBeCloseTo(other.frame.pose[i]!, 4);
    other.advance(Number.NaN);
    expect(other.frame.pose.every(Number.isFinite)).toBe(true);
  });

  it("refuses weights that are none, and goes on", () => {
    const walker = model.walker();
    expect(() => walker.plan([new Float32Array(3), new Float32Array(3)], [])).toThrow(
      /3 weights were given for 8 styles/,
    );
    expect(() => walker.plan(alone("old", Number.NaN), [])).toThrow();
    expect(walker.next().pose.every(Number.isFinite)).toBe(true);
  });

  it("has the built-in model packed, which is what training makes", async () => {
    const builtIn = await WalkModel.builtIn();
    expect(builtIn.styles).toEqual(model.styles);
    expect(builtIn.path(alone("neutral"), 13, 0)).toEqual(model.path(alone("neutral"), 13, 0));
  });

  it("follows one degree of freedom, with other variances and durations", () => {
    const plain = model.path(alone("neutral"), 13, 0);
    const firm = model.path(alone("neutral"), 13, 0, { variance: [0.001, 1, 1] });
    const off = ({ c, mean }: JointPath) => Math.max(...c.map((angle, t) => Math.abs(angle - mean[t]!)));
    expect(off(firm)).toBeLessThan(0.3 * off(plain));
    const alike = model.path(alone("neutral"), 13, 0, { variance: [1, 1000, 1000] });
    expect(off(alike), "only what a promise is worth beside the others counts").toBeCloseTo(off(firm), 4);
    const firmest = model.path(alone("neutral"), 13, 0, { variance: [0.001, 1000, 1000] });
    expect(off(firmest)).toBeLessThan(0.001 * off(plain));
    expect(firm.deviation[0]).toBeCloseTo(Math.sqrt(0.001) * plain.deviation[0]!, 6);
    const slow = model.path(alone("neutral"), 13, 0, { rho: [1, 1] });
    expect(slow.c.length).toBeGreaterThan(plain.c.length);
    expect(() => model.path(alone("neutral"), 13, 3)).toThrow(/no axis 3/);
    expect(() => model.path(alone("neutral"), 99, 0)).toThrow(/no such joint/);
    expect(() => model.path(alone("neutral"), 13, 0, { variance: [0, 1, 1] })).toThrow(/from 0.001 to 1000/);
    expect(() => model.path(alone("neutral"), 13, 0, { rho: [1] })).toThrow(/two values/);
  });

  it("draws a knee that bends, and writes BVH", () => {
    const curve = model.curve(alone("neutral"), 14);
    const range = Math.max(...curve.angle) - Math.min(...curve.angle);
    expect(range).toBeGreaterThan(0.5);
    const walker = model.walker();
    expect(model.toBvh(walker.frame.pose)).toMatch(/^HIERARCHY\nROOT/);
    expect(() => model.toBvh(new Float32Array(POSE_FLOATS + 1))).toThrow(/whole number of poses/);
  });
});
