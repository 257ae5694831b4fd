import { afterEach, describe, expect, test, vi } from "vitest";
import { InlineWorker } from "../../tests/inline_worker";
import { DEFAULT_OPTIONS } from "../engine/types";
import { POSE_FLOATS } from "../humanoid";
import type { StrutClient } from "./client";
import { createStrutClient } from "./client";
import type { Patience } from "./connection";
import { type Progress, type Restarted, StrutError } from "./protocol";
import type { WorkerPort } from "./rpc";

let workers: WorkerPort[] = [];
let client: StrutClient | undefined;
afterEach(() => {
  client?.dispose();
  client = undefined;
  workers = [];
});

/** Settings of a client in a test: its workers by index, and its patience. */
interface Start {
  spawn?: (count: number) => WorkerPort;
  patience?: Partial<Patience>;
}

async function connect({ spawn = () => new InlineWorker(), patience = {} }: Start = {}): Promise<StrutClient> {
  const counted = () => {
    const worker = spawn(workers.length);
    workers.push(worker);
    return worker;
  };
  client = await createStrutClient({ spawn: counted, patience });
  return client;
}

async function openDemo(start?: Start) {
  const client = await connect(start);
  const database = await client.openDatabase({ kind: "demo" });
  const [name] = await client.builtInInputs();
  const input = await client.openInput({ kind: "built-in", name: name! });
  const style = database.styles.find((s) => s !== database.neutral)!;
  return { client, database, input, style };
}

/** The worker that was started last. */
const worker = () => workers.at(-1) as InlineWorker;

/** A worker whose script cannot be loaded. */
function broken(): WorkerPort {
  const port: WorkerPort = { postMessage() {}, terminate() {}, onmessage: null, onerror: null };
  setTimeout(() => port.onerror?.({ message: "404" } as ErrorEvent), 0);
  return port;
}

describe("a client with the built-in database", () => {
  test("gives its neutral clips as files and as what these were written from", async () => {
    const { client, database } = await openDemo();
    const clips = await client.neutralClips();
    expect(clips.map(({ name }) => name).join()).toMatch(/walk.*neutral/);
    const { clip, name } = clips[0]!;
    const { bvh, poses } = await client.clipOfDatabase(clip);
    const { proportions, rateHz } = database;
    const bytes = new TextEncoder().encode(bvh).buffer;
    const input = await client.openInput({ kind: "bvh", name, bytes, exact: { poses, proportions, rateHz } });
    expect(input.frames * POSE_FLOATS).toBe(poses.length);
    const apart = input.poses.reduce((most, value, i) => Math.max(most, Math.abs(value - poses[i]!)), 0);
    expect(apart).toBeLessThan(1e-4);
  });

  test("opens, plays, restyles and seeks", async () => {
    const { client, database, input, style } = await openDemo();
    expect(database.proportions).toHaveLength(63);
    expect(database.classes.reduce((sum, c) => sum + c.frames, 0)).toBe(database.frames);
    expect(input.poses).toHaveLength(input.frames * POSE_FLOATS);
    expect(input.contacts).toHaveLength(2 * input.frames);

    const first = await client.step(0);
    const later = await client.step(0.25);
    expect(later.inputFrame).toBeGreaterThan(first.inputFrame);
    expect(later.pose.every(Number.isFinite)).toBe(true);
    expect(later.reads.reduce((sum, r) => sum + r.weight, 0)).toBeGreaterThan(0.5);

    await client.configure({ ...DEFAULT_OPTIONS, styles: { [style]: 1 } });
    const restyled = await client.step(0);
    expect(restyled.inputFrame).toBeCloseTo(later.inputFrame, 3);
    expect(restyled.pose).not.toEqual(later.pose);
    expect((await client.seek(30)).inputFrame).toBeCloseTo(30, 5);
  });

  test("analyses the whole clip with progress, while it plays", async () => {
    const { client, input } = await openDemo();
    const progress: Progress[] = [];
    const analysing = client.analyse({ onProgress: (p) => progress.push(p) });
    const frame = await client.step(0.05);
    expect(frame.timeOut).toBeCloseTo(0.05, 6);
    const analysis = await analysing;
    expect(analysis.poses).toHaveLength(input.frames * POSE_FLOATS);
    expect(analysis.planted).toHaveLength(2 * input.frames);
    expect(analysis.timeOut).toHaveLength(input.frames);
    expect(analysis.timeOut.every((t, i, all) => i === 0 || t > all[i - 1]!)).toBe(true);
    expect(analysis.durationOutSecs).toBeGreaterThan(analysis.timeOut.at(-1)!);
    const fractions = progress.map((p) => p.fraction);
    expect(fractions.length).toBeGreaterThan(3);
    expect(fractions).toEqual(fractions.toSorted((a, b) => a - b));
  });

  test("shows the examples behind each frame, in the styles asked for", async () => {
    const { client, input, style } = await openDemo();
    const heights = async () => (await client.examples("height")).values;
    const neutral = await heights();
    await client.configure({ ...DEFAULT_OPTIONS, styles: { [style]: 1 } });
    const { counts, weights, values } = await client.examples(14);
    expect(counts).toHaveLength(input.frames);
    expect(counts.reduce((sum, n) => sum + n, 0)).toBe(weights.length);
    expect(values).toHaveLength(4 * weights.length);
    expect(weights.every((w) => w >= 0 && w <= 1)).toBe(true);
    const styled = await heights();
    expect(styled).toHaveLength(neutral.length);
    expect(styled).not.toEqual(neutral);
    await expect(client.examples(99)).rejects.toMatchObject({ code: "bad-input" });
  });

  test("looks only among examples of the labels that it is given", async () => {
    const { client, database, style } = await openDemo();
    const action = database.actions[1]!;
    await client.configure({ ...DEFAULT_OPTIONS, action, inputStyle: style });
    const { reads } = await client.step(0.05);
    expect(reads).toEqual([{ action, style, weight: 1 }]);
    await expect(client.configure({ ...DEFAULT_OPTIONS, action: "swim" })).rejects.toMatchObject({ code: "bad-input" });
  });

  test("exports a BVH that opens as an input again, on its own skeleton", async () => {
    const { client, style } = await openDemo();
    await client.configure({ ...DEFAULT_OPTIONS, styles: { [style]: 1 } });
    const text = await client.exportBvh();
    const bytes = new TextEncoder().encode(text).buffer;
    const input = await client.openInput({ kind: "bvh", name: "again", bytes });
    expect([input.name, input.source]).toEqual(["again", "bvh"]);
    const analysis = await client.analyse();
    expect(input.durationSecs).toBeGreaterThan(1);
    const again = await client.exportBvh();
    const hierarchy = (bvh: string) => bvh.slice(0, bvh.indexOf("MOTION"));
    expect(hierarchy(again)).toBe(hierarchy(text));
    const frames = Number(/Frames: (\d+)/.exec(again)?.[1]);
    expect(Math.abs(frames / input.rateHz - analysis.durationOutSecs)).toBeLessThan(0.1);
  });

  test("stops when its signal says so", async () => {
    const { client } = await openDemo();
    const controller = new AbortController();
    const analysing = client.analyse({ signal: controller.signal, onProgress: () => controller.abort() });
    await expect(analysing).rejects.toMatchObject({ name: "StrutError", code: "cancelled" });
    await expect(client.analyse({ signal: AbortSignal.abort() })).rejects.toMatchObject({ code: "cancelled" });
    await client.step(0.01);
  });
});

describe("refusals", () => {
  test("nothing can be played before it is open", async () => {
    const client = await connect();
    await expect(client.step(0)).rejects.toMatchObject({ code: "not-open", message: "No database is open." });
    await client.openDatabase({ kind: "demo" });
    await expect(client.step(0)).rejects.toMatchObject({ code: "not-open", message: "No input is open." });
  });

  test("bad bytes give a sentence and leave what is open", async () => {
    const { client, style } = await openDemo();
    const before = await client.step(0.1);
    const bytes = new TextEncoder().encode("not what it should be").buffer;
    for (const refused of [
      client.openDatabase({ kind: "strutdb", name: "x", file: new Blob([bytes]) }),
      client.openInput({ kind: "bvh", name: "x", bytes }),
    ]) {
      const error = await refused.catch((e: unknown) => e);
      expect(error).toBeInstanceOf(StrutError);
      expect(error).toMatchObject({ code: "bad-file" });
      expect((error as StrutError).message).toMatch(/^[A-Z].*\.$/);
    }
    await expect(client.openInput({ kind: "built-in", name: "none" })).rejects.toMatchObject({ code: "bad-input" });
    await expect(client.configure({ ...DEFAULT_OPTIONS, k: 0 })).rejects.toMatchObject({ code: "bad-input" });
    await expect(client.configure({ ...DEFAULT_OPTIONS, styles: { none: 1 } })).rejects.toMatchObject({
      code: "bad-input",
      hint: expect.stringContaining(style),
    });
    expect((await client.step(0)).inputFrame).toBeCloseTo(before.inputFrame, 6);
  });

  test("a disposed client takes no calls", async () => {
    const client = await connect();
    const waiting = client.openDatabase({ kind: "demo" });
    client.dispose();
    await expect(waiting).rejects.toMatchObject({ code: "disposed" });
    await expect(client.step(0)).rejects.toMatchObject({ code: "disposed" });
    expect(worker().terminated).toBe(true);
  });

  test("a worker that cannot start is an error, not a wait", async () => {
    await expect(createStrutClient({ spawn: broken })).rejects.toMatchObject({ code: "load" });
  });
});

describe("an exchange of the database", () => {
  const FIRST = { kind: "demo", set: "first" } as const;

  async function playingFirst() {
    const client = await connect();
    const first = await client.openDatabase(FIRST);
    await client.openInput({ kind: "built-in", name: "neutral walk", set: "first" });
    await client.configure({ ...DEFAULT_OPTIONS, styles: { proud: 1 } });
    return { client, database: first };
  }

  test("goes on from the shown frame, where it is shown and as it looks", async () => {
    const { client, database } = await playingFirst();
    let before = await client.step(0);
    // By now the walker is not at the input's position.
    for (let i = 0; i < 180; i++) before = await client.step(1 / 60);
    const first = worker();
    const exchanging = client.exchangeDatabase({ kind: "demo" });
    before = await client.step(1 / 60);
    const whole = await exchanging;
    expect(whole.frames).toBeGreaterThan(2 * database.frames);
    expect(whole.styles).toEqual(database.styles);
    expect(await client.builtInInputs()).toContain("neutral run");
    const after = await client.step(1 / 60);
    expect(after.inputFrame - before.inputFrame).toBeGreaterThan(0.5);
    expect(after.inputFrame - before.inputFrame).toBeLessThan(1.5);
    expect(after.timeOut).toBeCloseTo(before.timeOut + 1 / 60, 6);
    // A walk at 1.5 m/s moves 0.025 m in a frame; a displaced root would move by decimetres.
    expect(Math.hypot(after.pose[0]! - before.pose[0]!, after.pose[2]! - before.pose[2]!)).toBeLessThan(0.04);
    const turns = after.pose.map((v, i) => Math.abs(v - before.pose[i]!));
    expect(Math.max(...turns.slice(3))).toBeLessThan(0.1);
    expect(worker()).not.toBe(first);
    await vi.waitFor(() => expect(first.terminated).toBe(true));
  });

  test("answers what was asked before it", async () => {
    const { client } = await playingFirst();
    const exchanging = client.exchangeDatabase({ kind: "demo" });
    const analysing = client.analyse();
    await exchanging;
    expect((await analysing).timeOut.length).toBeGreaterThan(100);
  });

  test("that is cancelled or fails leaves what is open", async () => {
    const { client } = await playingFirst();
    const first = worker();
    const abort = new AbortController();
    const exchanging = client.exchangeDatabase({ kind: "demo" }, { signal: abort.signal });
    abort.abort();
    await expect(exchanging).rejects.toMatchObject({ code: "cancelled" });
    const broken = { kind: "strutdb", name: "broken", file: new Blob(["no database"]) } as const;
    await expect(client.exchangeDatabase(broken)).rejects.toMatchObject({ code: "bad-file" });
    expect(workers.slice(1).every((port) => (port as InlineWorker).terminated)).toBe(true);
    expect(first.terminated).toBe(false);
    expect((await client.step(0.1)).timeOut).toBeCloseTo(0.1, 6);
  });
});

describe("after a fault", () => {
  const restarted = (client: StrutClient) =>
    new Promise<Restarted>((resolve) => {
      client.onRestart = resolve;
    });

  test("a new worker stands where the old one stood", async () => {
    const { client, style } = await openDemo();
    await client.configure({ ...DEFAULT_OPTIONS, styles: { [style]: 1 } });
    await client.setLoop(false);
    const before = await client.seek(100);
    const first = worker();
    first.faultAt = "step";
    const restart = restarted(client);
    await expect(client.step(0.1)).rejects.toMatchObject({ code: "fault" });
    const next = client.step(0);
    expect(await restart).toEqual({ why: "The engine failed: unreachable.", lost: [], reason: "" });
    expect(first.terminated).toBe(true);
    expect(worker().calls().slice(0, 3)).toEqual(["openDatabase", "openMotion", "createSession"]);
    const frame = await next;
    expect(frame.inputFrame).toBeCloseTo(100, 5);
    expect(frame.pose).toEqual(before.pose);
  });

  test("whatever was under way is rejected", async () => {
    const { client } = await openDemo();
    await client.step(0);
    const analysing = client.analyse();
    const outcome = expect(analysing).rejects.toMatchObject({ code: "fault" });
    const restart = restarted(client);
    await vi.waitFor(() => expect(worker().calls()).toContain("analyse"));
    worker().onerror?.({ message: "out of memory" } as ErrorEvent);
    await outcome;
    expect((await restart).why).toContain("out of memory");
  });

  test("a worker that says nothing any more is replaced", async () => {
    const { client } = await openDemo({ patience: { silenceMs: 1000, pingMs: 1000 } });
    const before = await client.seek(50);
    worker().deaf = true;
    const restart = restarted(client);
    await expect(client.step(0.1)).rejects.toMatchObject({ code: "fault" });
    expect((await restart).why).toContain("does not answer");
    expect((await client.step(0)).inputFrame).toBeCloseTo(before.inputFrame, 5);
  });

  test("one that says nothing while it reads a file is waited for longer, but not for ever", async () => {
    const { client } = await openDemo({ patience: { silenceMs: 50, pingMs: 50, readingMs: 200 } });
    await client.step(0);
    worker().deaf = true;
    const restart = restarted(client);
    await expect(client.openInput({ kind: "built-in", name: "neutral walk" })).rejects.toMatchObject({ code: "fault" });
    expect((await restart).why).toContain("does not answer");
  });

  test("what fails again at once is not opened a third time", async () => {
    const { client } = await openDemo();
    await client.step(0);
    worker().faultAt = "step";
    let restart = restarted(client);
    await client.step(0.1).catch(() => {});
    await restart;
    worker().faultAt = "step";
    restart = restarted(client);
    await client.step(0.1).catch(() => {});
    expect((await restart).lost).toEqual(["database", "input"]);
    expect(worker().calls()).toEqual([]);
    await expect(client.step(0)).rejects.toMatchObject({ code: "not-open" });
  });

  test("a source that cannot be opened again is closed, and the next one opens", async () => {
    const refused = { code: "bad-file" as const, message: "The file is gone.", hint: "" };
    const spawn = (count: number) =>
      new InlineWorker(({ method }) => (count === 1 && method === "openDatabase" ? refused : undefined));
    const { client } = await openDemo({ spawn });
    await client.step(0);
    const restart = restarted(client);
    worker().faultAt = "step";
    await client.step(0.1).catch(() => {});
    expect(await restart).toMatchObject({ lost: ["database", "input"], reason: "The file is gone." });
    await expect(client.step(0)).rejects.toMatchObject({ code: "not-open" });
    expect(await client.builtInInputs()).toContain("neutral walk");
  });

  test("a worker that cannot be started again is tried again by the next call", async () => {
    const { client } = await openDemo({ spawn: (count) => (count === 1 ? broken() : new InlineWorker()) });
    const before = await client.seek(40);
    const restart = restarted(client);
    worker().faultAt = "step";
    await expect(client.step(0.1)).rejects.toMatchObject({ code: "fault" });
    await expect(client.step(0)).rejects.toMatchObject({ code: "load" });
    expect((await client.step(0)).pose).toEqual(before.pose);
    expect((await restart).lost).toEqual([]);
  });

  test("whatever was styled proves the worker", async () => {
    const { client } = await openDemo();
    for (let fault = 0; fault < 3; fault++) {
      await client.style(DEFAULT_OPTIONS);
      const restart = restarted(client);
      worker().faultAt = "stylize";
      await expect(client.style(DEFAULT_OPTIONS)).rejects.toMatchObject({ code: "fault" });
      expect((await restart).lost).toEqual([]);
    }
    await client.style(DEFAULT_OPTIONS);
  });

  test("a worker that was asleep is asked before it is replaced", async () => {
    const { client } = await openDemo({ patience: { silenceMs: 200, pingMs: 60_000 } });
    await client.step(0);
    worker().sleep();
    const step = client.step(0.1);
    setTimeout(() => worker().wake(), 400);
    expect((await step).inputFrame).toBeGreaterThan(0);
    expect(workers).toHaveLength(1);
  });
});
