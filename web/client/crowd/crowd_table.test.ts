/** The crowd of the real package on this thread, with a clock that the tests control. */
import { expect, test } from "vitest";
import { InlineWorker } from "../../../tests/inline_worker";
import { DEFAULT_OPTIONS } from "../../engine/types";
import { CROWD_JOINT_FLOATS, JOINT, type Role } from "../../humanoid";
import { createStrutClient } from "../client";
import { createCrowdTable } from "./crowd_table";

const WALKERS = { kind: "walkers" } as const;

/** A crowd whose ticks take these milliseconds, one after another; the last value repeats. */
async function crowdOf(count: number, tickMs: number[] = [1]) {
  let [time, calls] = [0, 0];
  // Every tick reads the clock twice.
  const table = createCrowdTable(() => {
    if (calls % 2 === 1) time += tickMs[Math.min(Math.floor(calls / 2), tickMs.length - 1)]!;
    calls += 1;
    return time;
  });
  const facts = await table.open(WALKERS, { count, seed: 3 });
  return { table, facts };
}

test("everybody has joints in the world and weights", async () => {
  const { table, facts } = await crowdOf(20);
  await table.setField([{ style: "old", x: 0, z: 0, reach: 10, intensity: 1 }]);
  let tick = await table.tick(undefined);
  for (let i = 0; i < 60; i++) tick = await table.tick(tick.joints.buffer as ArrayBuffer);
  expect([facts.rateHz, tick.count, tick.radius, tick.tickMs]).toEqual([30, 20, 8, 1]);
  expect([tick.joints.length, tick.weights.length]).toEqual([20 * 21 * 8, 20 * facts.styles.length]);
  const old = facts.styles.indexOf("old");
  for (let walker = 0; walker < 20; walker++) {
    const hips = tick.joints.subarray(168 * walker, 168 * walker + 8);
    expect(Math.hypot(hips[0]!, hips[2]!)).toBeLessThan(1.2 * tick.radius);
    expect(hips[1]).toBeGreaterThan(0.6);
    expect(hips[3]).toBe(0);
    expect(Math.hypot(...hips.subarray(4))).toBeCloseTo(1, 4);
    expect(tick.weights[walker * facts.styles.length + old]).toBeGreaterThan(100);
  }
});

test("a buffer is used again while the count stays", async () => {
  const { table } = await crowdOf(5);
  const first = await table.tick(undefined);
  const buffer = first.joints.buffer as ArrayBuffer;
  expect((await table.tick(buffer)).joints.buffer).toBe(buffer);
  await table.setCount(6);
  const { joints, count } = await table.tick(buffer);
  expect(joints.buffer).not.toBe(buffer);
  expect(count).toBe(6);
});

test("three slow ticks in a row halve the count", async () => {
  const counts = async (tickMs: number[]) => {
    const { table } = await crowdOf(9, tickMs);
    const ticks = [];
    for (let i = 0; i < 8; i++) ticks.push((await table.tick(undefined)).count);
    return ticks;
  };
  expect(await counts([30, 30, 1, 30, 30, 24, 30, 1])).toEqual(Array(8).fill(9));
  expect(await counts([26])).toEqual([9, 9, 9, 4, 4, 4, 2, 2]);
});

test("the next seconds of a walker are a BVH file", async () => {
  const { table } = await crowdOf(3);
  const bvh = await table.exportBvh(2, 2);
  expect(bvh).toMatch(/^HIERARCHY/);
  expect(bvh).toMatch(/Frames: 60\n/);
  await expect(table.exportBvh(3, 2)).rejects.toMatchObject({ code: "bad-input" });
  await expect(table.exportBvh(0, 0)).rejects.toMatchObject({ code: "bad-input" });
});

test("joints lie on the bones that are given", async () => {
  const { table, facts } = await crowdOf(3);
  const bones = facts.proportions.slice();
  const neck = 3 * JOINT.neck;
  bones[neck + 1]! += 0.2;
  await table.setBones(bones);
  const { joints } = await table.tick(undefined);
  const at = (role: Role) => joints.subarray(CROWD_JOINT_FLOATS * JOINT[role]).subarray(0, 3);
  const [a, b] = [at("neck"), at("chest")];
  expect(Math.hypot(a[0]! - b[0]!, a[1]! - b[1]!, a[2]! - b[2]!)).toBeCloseTo(
    Math.hypot(...bones.subarray(neck, neck + 3)),
    4,
  );
  await expect(table.setBones(bones.subarray(3))).rejects.toMatchObject({ code: "bad-input" });
  await expect(table.setBones(bones.map(() => Number.NaN))).rejects.toMatchObject({ code: "bad-input" });
});

test("what is no crowd, no field and no route is refused, and nothing changes", async () => {
  for (const count of [0, 1001])
    await expect(createCrowdTable().open(WALKERS, { count })).rejects.toMatchObject({ code: "bad-input" });
  const { table } = await crowdOf(3);
  const vertex = { style: "old", x: 0, z: 0, reach: 2, intensity: 1 };
  const fields = [
    [{ ...vertex, style: "mother" }],
    [{ ...vertex, x: Number.NaN }],
    [{ ...vertex, reach: 11 }],
    [{ ...vertex, intensity: -2 }],
    Array(13).fill(vertex),
  ];
  for (const field of fields) await expect(table.setField(field)).rejects.toMatchObject({ code: "bad-input" });
  await expect(table.setRoute([[0, 0]])).rejects.toMatchObject({ code: "bad-input" });
  await expect(table.setCount(0)).rejects.toMatchObject({ code: "bad-input" });
  expect((await table.tick(undefined)).weights.every((weight) => weight === 0)).toBe(true);
  await expect(createCrowdTable().tick(undefined)).rejects.toMatchObject({ code: "not-open" });
});

test("people perform what the engine recorded of a motion, in the styles of their places", async () => {
  const client = await createStrutClient({ spawn: () => new InlineWorker() });
  await client.openDatabase({ kind: "demo", set: "first" });
  const [name] = await client.builtInInputs();
  await client.openInput({ kind: "built-in", name: name!, set: "first" });
  const recorded = await client.record(DEFAULT_OPTIONS, { first: 60, last: 299 });
  await expect(client.record(DEFAULT_OPTIONS, { first: 60, last: 70 })).rejects.toMatchObject({ code: "bad-input" });
  client.dispose();
  expect(recorded.secs).toBe(4);

  const table = createCrowdTable();
  const field = [{ style: "old", x: 0, z: 0, reach: 10, intensity: 1 }];
  const facts = await table.open({ kind: "performers", recorded }, { count: 10, field });
  expect([facts.rateHz, facts.styles]).toEqual([30, recorded.styles]);
  const places: number[][] = [];
  // Beyond the end of the recording, which loops.
  for (let i = 0; i < 180; i++) {
    const { joints, weights } = await table.tick(undefined);
    places.push([joints[0]!, joints[1]!, joints[2]!]);
    // All agents begin in the neutral style and take on the style of the place within a second.
    if (i >= facts.rateHz) expect(weights[facts.styles.indexOf("old")]).toBeGreaterThan(100);
  }
  const steps = places
    .slice(1)
    .map(([x, y, z], i) => Math.hypot(x! - places[i]![0]!, y! - places[i]![1]!, z! - places[i]![2]!));
  expect(Math.max(...steps), "nobody jumps").toBeLessThan(0.1);
  expect(
    steps.reduce((sum, step) => sum + step),
    "they walk",
  ).toBeGreaterThan(2);
  expect(await table.exportBvh(3, 1)).toMatch(/Frames: 30\n/);
  const broken = { ...recorded, numbers: recorded.numbers.slice(1) };
  await expect(createCrowdTable().open({ kind: "performers", recorded: broken }, { count: 3 })).rejects.toMatchObject({
    code: "bad-input",
  });
});

test("a seed gives the same bits", async () => {
  const run = async () => {
    const { table } = await crowdOf(10);
    let tick = await table.tick(undefined);
    for (let i = 0; i < 50; i++) tick = await table.tick(tick.joints.buffer as ArrayBuffer);
    return new Uint8Array(tick.joints.buffer as ArrayBuffer);
  };
  expect(await run()).toEqual(await run());
});
