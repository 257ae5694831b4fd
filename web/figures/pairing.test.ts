import fc from "fast-check";
import { beforeAll, expect, test } from "vitest";
import { createLearnTable } from "../client/learn/learn_table";
import { serveLearnPackage } from "../engine/learn/wasm";
import { createWorldPose, JOINT, JOINTS, POSE_FLOATS, worldFromLocal } from "../humanoid";
import { measurePair } from "./pair_measure";
import { PAIR_FIELDS, type PairState } from "./pair_state";
import { frameAtTime, jointDifferences, meanOf, type Pair, pairOf } from "./pairing";

beforeAll(serveLearnPackage);
const engine = createLearnTable();

/** The same result by another method: each pose is rotated by the heading of its hips. */
function independentDistances(pair: Pair, frame: number, other: number): number[] {
  const place = (poses: Float32Array, f: number) => {
    const world = createWorldPose();
    worldFromLocal(pair.proportions, poses.subarray(f * POSE_FLOATS, (f + 1) * POSE_FLOATS), world);
    const [x, y, z, w] = world.rotations.slice(0, 4) as unknown as [number, number, number, number];
    // The hips' forward axis on the ground.
    const [fx, fz] = [2 * (x * z + w * y), 1 - 2 * (x * x + y * y)];
    const length = Math.hypot(fx, fz);
    const at = (j: number, axis: number) => world.positions[3 * j + axis]! - (axis === 1 ? 0 : world.positions[axis]!);
    return Array.from({ length: JOINTS }, (_, j) => {
      const [px, py, pz] = [at(j, 0), at(j, 1), at(j, 2)];
      return [(px * fz - pz * fx) / length, py, (px * fx + pz * fz) / length];
    });
  };
  const [a, b] = [place(pair.input.poses, frame), place(pair.styled.poses, other)];
  return a.map((p, j) => 100 * Math.sqrt(p.reduce((s, v, k) => s + (v - b[j]![k]!) ** 2, 0)));
}

/** The mean distance. */
function independentDifference(pair: Pair, frame: number, other: number): number {
  let sum = 0;
  for (const distance of independentDistances(pair, frame, other)) sum += distance;
  return sum / JOINTS;
}

test("the difference is the mean distance of the joints, place and heading aside", async () => {
  const pair = (await pairOf(engine, "neutral walk", "proud"))!;
  for (const frame of [0, 160, 500, 881]) {
    const independent = independentDifference(pair, frame, frame);
    // A mutation: another instant must give another result.
    expect(Math.abs(pair.difference.content[frame]! - independent)).toBeLessThan(0.6);
    expect(
      Math.abs(pair.difference.content[frame]! - independentDifference(pair, frame, (frame + 20) % 880)),
    ).toBeGreaterThan(0.6);
    expect(meanOf(jointDifferences(pair, "content", frame))).toBeCloseTo(pair.difference.content[frame]!, 4);
  }
});

test("the same second is the frame of the styled walk that is reached then", async () => {
  const pair = (await pairOf(engine, "neutral walk", "proud"))!;
  for (const frame of [160, 300, 700]) {
    let other = 0;
    while (pair.styled.timeOut[other + 1]! <= frame / pair.rateHz) other += 1;
    expect(Math.abs(pair.difference.second[frame]! - independentDifference(pair, frame, other))).toBeLessThan(1);
    expect(
      Math.abs(pair.difference.second[frame]! - independentDifference(pair, frame, frame)),
      "mutation: paired by content",
    ).toBeGreaterThan(3);
  }
});

test("the mean of a joint is that of its distances in all frames", async () => {
  const pair = (await pairOf(engine, "neutral walk", "old"))!;
  const state: PairState = { motion: "neutral walk", style: "old", pairing: "content", at: 0, joint: "head" };
  const { jointMean, farthestMean } = await measurePair(engine, state);
  const means = Array.from({ length: JOINTS }, () => 0);
  const frames = Array.from({ length: 44 }, (_, i) => 20 * i);
  for (const frame of frames)
    for (const [j, distance] of independentDistances(pair, frame, frame).entries())
      means[j]! += distance / frames.length;
  expect(Math.abs(means[JOINT.head]! - Number(jointMean))).toBeLessThan(1);
  expect(Math.max(...means)).toBe(means[JOINT.head]);
  expect(jointMean).toBe(farthestMean);
  expect(Math.abs(means[JOINT.neck]! - Number(jointMean)), "mutation: its neighbour").toBeGreaterThan(4);
});

test("the same second ends with a faster performance", async () => {
  const pair = (await pairOf(engine, "neutral walk", "childlike"))!;
  expect(pair.frames.second.at(-1)).toBeNaN();
  expect(Number.isFinite(meanOf(pair.difference.second))).toBe(true);
  expect(await pairOf(engine, "neutral walk", "no such style")).toBeUndefined();
});

test("times are found between the samples", () => {
  // With a share of 1 these round to more than the last time.
  const rounded = [
    0.23597234353997798, 0.1072628133754667, 0.3940807800084778, 0.047408432538957934, 0.45124797407709955,
  ];
  const increasing = fc.array(fc.double({ min: 0.01, max: 1, noNaN: true }), { minLength: 2, maxLength: 40 });
  fc.assert(
    fc.property(increasing, fc.double({ min: 0, max: 1, noNaN: true }), (steps, share) => {
      const times: number[] = [];
      for (const step of steps) times.push((times.at(-1) ?? 0) + step);
      const time = Math.min(times.at(-1)!, times[0]! + share * (times.at(-1)! - times[0]!));
      const at = frameAtTime(times, time);
      const [i, t] = [Math.min(Math.floor(at), times.length - 2), at - Math.min(Math.floor(at), times.length - 2)];
      expect(times[i]! + t * (times[i + 1]! - times[i]!)).toBeCloseTo(time, 6);
    }),
    { examples: [[rounded, 1]] },
  );
  expect(frameAtTime([0, 1], 2)).toBeNaN();
});

test("a measure has the numbers that the figure shows", async () => {
  const pair = (await pairOf(engine, "neutral walk", "old"))!;
  const state: PairState = { motion: "neutral walk", style: "old", pairing: "content", at: 99_999, joint: "head" };
  const measure = await measurePair(engine, state);
  expect(measure.at, "clamped to the motion").toBe(pair.input.frames - 1);
  expect(measure.content).toBe(pair.difference.content.at(-1));
  expect(measure).toMatchObject({ nearest: "sexy", nearestBySecond: "childlike", farthest: "head" });
  expect(Object.keys(PAIR_FIELDS)).toEqual(expect.arrayContaining(Object.keys(state)));
});
