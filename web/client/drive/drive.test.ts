/** Driving through the client, with the real engine and driver on this thread. */

import { afterEach, describe, expect, test } from "vitest";
import { walksIn } from "../../../tests/clips";
import { InlineBuildWorker } from "../../../tests/inline_build_worker";
import { InlineWorker } from "../../../tests/inline_worker";
import { DEFAULT_OPTIONS } from "../../engine/types";
import { POSE_FLOATS } from "../../humanoid";
import { BuildClient } from "../build/client";
import type { StrutClient } from "../client";
import { createStrutClient } from "../client";
import { type DriveControl, type DriveFrame, type Root, STILL } from "./protocol";

const DT = 1 / 60;
const ORIGIN: Root = [0, 0, 0];
const AHEAD: DriveControl = { move: [0, 1], gait: 1 };

let client: StrutClient | undefined;
let workers: InlineWorker[] = [];
afterEach(() => {
  client?.dispose();
  client = undefined;
  workers = [];
});

async function connect(): Promise<StrutClient> {
  client = await createStrutClient({
    spawn: () => {
      workers.push(new InlineWorker());
      return workers.at(-1)!;
    },
  });
  return client;
}

async function opened(root = ORIGIN) {
  const client = await connect();
  const database = await client.openDatabase({ kind: "demo" });
  const [name] = await client.builtInInputs();
  await client.openInput({ kind: "built-in", name: name! });
  const info = await client.openDrive(root);
  return { client, database, info };
}

/** Drives for a duration. */
async function driven(client: StrutClient, secs: number, control: DriveControl): Promise<DriveFrame[]> {
  const frames: DriveFrame[] = [];
  for (let i = 0; i < secs * 60; i++) frames.push(await client.drive(DT, control));
  return frames;
}

const placeOf = ({ pose }: DriveFrame) => [pose[0]!, pose[2]!] as const;
const isFinitePose = ({ pose, inputPose }: DriveFrame) => [...pose, ...inputPose].every(Number.isFinite);

describe("a driven character", () => {
  test("goes where it is steered, runs, and stands again", async () => {
    const { client, info } = await opened([3, -2, 0]);
    expect(info.note).toBe("");
    expect(info.speeds[1]).toBeGreaterThan(info.speeds[0]);
    const first = await client.drive(0, STILL);
    expect(Math.hypot(first.pose[0]! - 3, first.pose[2]! + 2)).toBeLessThan(0.2);
    expect([first.pose.length, first.asked.length, first.ahead.length]).toEqual([POSE_FLOATS, 9, 9]);

    const walk = await driven(client, 3, AHEAD);
    const [x, z] = placeOf(walk.at(-1)!);
    expect(z).toBeGreaterThan(0);
    expect(Math.abs(x - 3)).toBeLessThan(0.4);
    const run = await driven(client, 3, { ...AHEAD, gait: 2 });
    expect(run.at(-1)!.speed).toBeGreaterThan(1.5 * info.speeds[0]);
    const stop = await driven(client, 2.5, STILL);
    expect(stop.at(-1)!.speed).toBeLessThan(0.2);
    expect([...walk, ...run, ...stop].every(isFinitePose)).toBe(true);
    // The displayed frame lies between the last two frames, so it is at most one frame late.
    expect(walk.at(-1)!.inputFrame).toBeGreaterThan(160);
  });

  test("is styled as what it is, neutral, whatever is said of another input", async () => {
    const { client, database } = await opened();
    await client.configure({ ...DEFAULT_OPTIONS, styles: { proud: 1 }, action: "kick", inputStyle: "old" });
    const { reads } = (await driven(client, 2, AHEAD)).at(-1)!;
    expect(reads.map(({ style }) => style)).toEqual(reads.map(() => database.neutral));
    expect(reads[0]!.action).toBe("walk");
  });

  test("turns on the spot to a heading", async () => {
    const { client } = await opened();
    const frames = await driven(client, 3, { ...STILL, face: Math.PI / 2 });
    expect(Math.abs(frames.at(-1)!.root[2] - Math.PI / 2)).toBeLessThan(0.25);
    expect(Math.hypot(...placeOf(frames.at(-1)!))).toBeLessThan(0.5);
  });

  test("makes a move when it is asked to, once", async () => {
    const { client, info } = await opened();
    await driven(client, 1, STILL);
    const move = info.moves[0]!;
    const pressed = await client.drive(DT, { ...STILL, action: move });
    const after = [pressed, ...(await driven(client, 6, STILL))];
    const begins = after.filter((frame, i) => frame.move === move && after[i - 1]?.move !== move);
    expect(begins.length).toBe(1);
    expect(after.at(-1)!.move).toBeUndefined();
  });

  test("follows a path to its end, in a style", async () => {
    const { client, database } = await opened();
    const old = database.styles.find((style) => style === "old")!;
    await client.configure({ ...DEFAULT_OPTIONS, styles: { [old]: 1 } });
    const path = Float32Array.from(
      Array.from({ length: 60 }, (_, i) => [2 - 2 * Math.cos(i / 20), 2 * Math.sin(i / 20)]).flat(),
    );
    const frames = [await client.drive(DT, { ...STILL, path })];
    while (frames.at(-1)!.progress !== undefined && frames.length < 3000) frames.push(await client.drive(DT, STILL));
    expect(frames.length).toBeLessThan(3000);
    const off = frames.slice(120).map((frame) => {
      const [x, z] = placeOf(frame);
      return Math.abs(Math.hypot(x - 2, z) - 2);
    });
    expect(off.reduce((sum, distance) => sum + distance, 0) / off.length).toBeLessThan(0.1);
  });

  test("shows a change of style while it stands still in time", async () => {
    const { client, database } = await opened();
    await driven(client, 2, AHEAD);
    const before = await client.drive(0, STILL);
    await client.configure({ ...DEFAULT_OPTIONS, styles: { [database.styles[0]!]: 1 } });
    const after = await client.drive(0, STILL);
    for (const axis of [0, 1]) expect(placeOf(after)[axis]).toBeCloseTo(placeOf(before)[axis]!, 5);
    expect(after.inputPose).toEqual(before.inputPose);
    expect(after.pose.some((value, i) => Math.abs(value - before.pose[i]!) > 0.01)).toBe(true);
    const next = await client.drive(DT, AHEAD);
    expect(Math.hypot(next.pose[0]! - after.pose[0]!, next.pose[2]! - after.pose[2]!)).toBeLessThan(0.1);
  });
});

describe("bad input", () => {
  const BAD: readonly DriveControl[] = [
    { move: [Number.NaN, 0], gait: 1 },
    { move: [1e9, 1e9], gait: 99 },
    { move: [0, 1], gait: Number.POSITIVE_INFINITY },
    { ...AHEAD, face: Number.NaN },
    { ...AHEAD, path: Float32Array.of(Number.NaN, 0, 1, 1) },
    { ...AHEAD, path: Float32Array.of(1, 1) },
    { ...AHEAD, path: Float32Array.of(1, 1, 1, 1, 1, 1) },
    { ...AHEAD, path: Float32Array.of(0, 0, 10_000, 10_000) },
    { ...AHEAD, path: Float32Array.of(1, 2, 3) },
    { ...AHEAD, path: new Float32Array(1_000_000) },
    { ...AHEAD, path: Float32Array.from({ length: 4000 }, (_, i) => (i % 2 ? Math.cos(i) : Math.sin(i))) },
  ];

  test("never brings it out of step", async () => {
    const { client } = await opened();
    await driven(client, 1, AHEAD);
    for (const control of BAD) {
      const frames = await driven(client, 0.5, control);
      expect(frames.every(isFinitePose)).toBe(true);
      expect(Math.max(...frames.map(({ speed }) => speed))).toBeLessThan(4);
    }
    await driven(client, 1, { ...AHEAD, path: new Float32Array() });
    const [, from] = placeOf(await client.drive(0, AHEAD));
    const [, to] = placeOf((await driven(client, 3, AHEAD)).at(-1)!);
    expect(to).toBeGreaterThan(from + 1);
  });

  test("counts as the last good one", async () => {
    const { client } = await opened();
    await driven(client, 2, AHEAD);
    const frames = await driven(client, 2, { move: [Number.NaN, 0], gait: 1 });
    expect(frames.at(-1)!.speed).toBeGreaterThan(0.8);
  });

  test("a path with a number that is none leaves the one before", async () => {
    const { client } = await opened();
    await client.drive(DT, { ...STILL, path: Float32Array.of(0, 0, 0, 6) });
    const frame = await client.drive(DT, { ...STILL, path: Float32Array.of(0, Number.NaN, 0, 6) });
    expect(frame.progress).toBeDefined();
  });
});

describe("a database with too little neutral walking", () => {
  /** A database of clips, each a BVH file. */
  async function databaseOf(files: Readonly<Record<string, string>>, neutral: string): Promise<Blob> {
    const builds = new BuildClient(() => new InlineBuildWorker());
    const { clips, pattern } = await builds.open(
      Object.entries(files).map(([path, text]) => ({ path, file: new File([text], path) })),
    );
    const labels = await builds.label(pattern, undefined);
    const chosen = clips.map(({ path, licence }, index) => {
      const label = labels[index]!;
      if ("reason" in label) throw new Error(label.reason);
      return { ...label, index, path, licence, roles: undefined };
    });
    const { file } = await builds.build(chosen, neutral);
    builds.dispose();
    return new Blob([file]);
  }

  test.each(["walk", "punch"])("is driven with built-in clips, and says so: %s", async (action) => {
    const { neutral, old } = await walksIn(["neutral", "old"]);
    const files = { [`${action}_neutral_1.bvh`]: neutral, [`${action}_old_1.bvh`]: old };
    const client = await connect();
    await client.openDatabase({ kind: "strutdb", name: "short", file: await databaseOf(files, "neutral") });
    const [name] = await client.builtInInputs();
    await client.openInput({ kind: "built-in", name: name! });
    const { note, frames, speeds } = await client.openDrive(ORIGIN);
    expect(note).toMatch(/neutral clips have .* s of walking; driving needs 5 s/);
    expect(frames).toBeGreaterThan(3600);
    const walk = await driven(client, 3, AHEAD);
    expect(walk.at(-1)!.speed).toBeGreaterThan(0.7 * speeds[0]);
    expect(walk.every(isFinitePose)).toBe(true);
  });
});

describe("what was driven", () => {
  test("is an input of the same neutral frames, with the styles it was shown in", async () => {
    const { client, database } = await opened();
    const frames = await driven(client, 2, AHEAD);
    await client.configure({ ...DEFAULT_OPTIONS, styles: { old: 1 } });
    frames.push(...(await driven(client, 2, AHEAD)));
    const { bvh, frames: count, poses, track } = await client.driven();
    expect(Math.abs(count - frames.at(-1)!.inputFrame)).toBeLessThan(3);
    expect(track[0]).toEqual({ frame: 0, styles: {} });
    expect(track.at(-1)!.styles.old).toBeCloseTo(1, 1);

    const bytes = new TextEncoder().encode(bvh).buffer;
    const { proportions, rateHz } = database;
    const input = await client.openInput({
      kind: "bvh",
      name: "driven 1",
      bytes,
      exact: { poses, proportions, rateHz },
    });
    expect([input.frames, input.rateHz]).toEqual([count, rateHz]);
    // Up to rounding: rotations are normalised again.
    expect(Math.max(...input.poses.map((value, i) => Math.abs(value - poses[i]!)))).toBeLessThan(5e-7);
    // The displayed pose was between two of them, except for the feet that were planted then, and the hips that were
    // adjusted.
    const shown = frames.at(100)!;
    const whole = Math.floor(shown.inputFrame);
    for (let axis = 3; axis < 7; axis++) {
      const [a, b] = [0, 1].map((next) => input.poses[(whole + next) * POSE_FLOATS + axis]!).sort((p, q) => p - q);
      expect(shown.inputPose[axis]).toBeGreaterThan(a! - 1e-4);
      expect(shown.inputPose[axis]).toBeLessThan(b! + 1e-4);
    }
    await expect(client.drive(DT, STILL)).rejects.toMatchObject({ code: "not-open" });
  });

  test("is nothing to begin with but the first frame, and nothing of before after a reset", async () => {
    const { client } = await opened();
    await driven(client, 1, AHEAD);
    await client.resetDrive([5, 5, 0]);
    const frame = await client.drive(0, STILL);
    expect(Math.hypot(frame.pose[0]! - 5, frame.pose[2]! - 5)).toBeLessThan(0.2);
    expect((await client.driven()).frames).toBe(1);
  });
});

describe("a fault", () => {
  test("has it stand where it was", async () => {
    const { client } = await opened();
    await driven(client, 3, AHEAD);
    const before = await client.drive(DT, AHEAD);
    const restarted = new Promise((resolve) => {
      client.onRestart = resolve;
    });
    workers.at(-1)!.faultAt = "drive";
    await expect(client.drive(DT, AHEAD)).rejects.toMatchObject({ code: "fault" });
    await restarted;
    const after = await client.drive(DT, AHEAD);
    expect(Math.hypot(after.root[0] - before.root[0], after.root[1] - before.root[1])).toBeLessThan(0.2);
  });
});
