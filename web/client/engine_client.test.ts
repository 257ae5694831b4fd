import { afterEach, beforeAll, describe, expect, test } from "vitest";
import { walksIn } from "../../tests/clips";
import { InlineBuildWorker } from "../../tests/inline_build_worker";
import { InlineWorker } from "../../tests/inline_worker";
import { POSE_FLOATS } from "../humanoid";
import { EngineClient, type EngineRestart } from "./engine_client";
import type { ClientSession } from "./handles";
import { OPTION_RANGES } from "./options";
import { DEFAULT_OPTIONS, MAX_PUSH_FRAMES, type Progress } from "./protocol";

let workers: InlineWorker[] = [];
let clients: EngineClient[] = [];
afterEach(() => {
  for (const client of clients) client.dispose();
  clients = [];
  workers = [];
});

function connect(): EngineClient {
  const spawn = () => {
    workers.push(new InlineWorker());
    return workers.at(-1)!;
  };
  const client = new EngineClient({ spawn, spawnBuild: () => new InlineBuildWorker() });
  clients.push(client);
  return client;
}

/** The worker that was started last. */
const worker = () => workers.at(-1)!;

/** A client with the built-in database and one of its motions. */
async function openDemo(name = "neutral walk") {
  const client = connect();
  const database = await client.openDatabase({ kind: "demo" });
  const motion = await client.openMotion({ kind: "built-in", name });
  return { client, database, motion, info: await motion.on(database) };
}

const restarted = (client: EngineClient) =>
  new Promise<EngineRestart>((resolve) => {
    client.onRestart = resolve;
  });

/** The poses of `steps` steps of 1/60 s. */
async function played(session: ClientSession, steps: number): Promise<Float32Array[]> {
  const poses: Float32Array[] = [];
  for (let i = 0; i < steps; i++) poses.push((await session.step(1 / 60)).pose);
  return poses;
}

let proudWalk: ArrayBuffer;
beforeAll(async () => {
  const { proud } = await walksIn(["proud"]);
  proudWalk = new TextEncoder().encode(proud).buffer as ArrayBuffer;
});

/** A reactive object as in Vue, Svelte and MobX: each object in it is a proxy, which no port can send. */
function reactive<T extends object>(value: T): T {
  return new Proxy(value, {
    get: (target, name) => {
      const found: unknown = Reflect.get(target, name);
      const isPlain = Array.isArray(found) || Object.prototype.toString.call(found) === "[object Object]";
      return isPlain ? reactive(found as object) : found;
    },
  });
}

describe("what frameworks give", () => {
  test("styles and readings that are proxies are taken as what they hold", async () => {
    const { client, database, motion } = await openDemo();
    const given = reactive({ ...DEFAULT_OPTIONS, styles: { proud: 0.7 } });
    const styled = await motion.stylize(database, given);
    const plainly = await motion.stylize(database, { ...DEFAULT_OPTIONS, styles: { proud: 0.7 } });
    expect(styled.poses).toEqual(plainly.poses);
    const session = await client.createSession(database, motion, reactive({ styles: { old: 1 } }));
    expect((await played(session, 1))[0]).toHaveLength(POSE_FLOATS);
    await client.openMotion(reactive({ kind: "bvh", name: "mine", bytes: proudWalk } as const));
  });

  test("what no worker takes is refused, and the engine is idle again", async () => {
    const { client, database, motion } = await openDemo();
    const function_ = { ...DEFAULT_OPTIONS, inputStyle: (() => "") as unknown as string };
    await expect(motion.stylize(database, function_)).rejects.toMatchObject({ code: "bad-input" });
    await client.retire();
  });
});

describe("handles", () => {
  test("a whole motion is styled while another session plays", async () => {
    const { client, database, motion } = await openDemo();
    const session = await client.createSession(database, motion, { styles: { old: 1 } });
    const alone = await motion.stylize(database, { ...DEFAULT_OPTIONS, styles: { proud: 0.7 } });
    const progress: Progress[] = [];
    const styling = motion.stylize(database, { ...DEFAULT_OPTIONS, styles: { proud: 0.7 } }, true, {
      onProgress: (p) => progress.push(p),
    });
    const frames = await played(session, 5);
    const { bvh, poses } = await styling;
    expect(frames).toHaveLength(5);
    expect(poses).toEqual(alone.poses);
    expect(bvh).toMatch(/^HIERARCHY/);
    const fractions = progress.map(({ fraction }) => fraction);
    expect(fractions).toEqual(fractions.toSorted((a, b) => a - b));
    expect(fractions.length).toBeGreaterThan(3);
  });

  test("a motion is used with two databases, each with its own humanoid", async () => {
    const { client, database } = await openDemo();
    const motion = await client.openMotion({ kind: "bvh", name: "mine", bytes: proudWalk });
    const other = await client.openDatabase({ kind: "demo" });
    expect((await motion.on(other)).poses).toEqual((await motion.on(database)).poses);
    const blob = await client.openMotion({ kind: "bvh", name: "mine", bytes: new Blob([proudWalk]) });
    expect((await blob.on(other)).poses, "a file that is held elsewhere").toEqual((await motion.on(other)).poses);
    database.dispose();
    const session = await client.createSession(other, motion);
    expect((await session.step(0)).pose).toHaveLength(POSE_FLOATS);
  });

  test("a file is read as a person says, and says how it was read", async () => {
    const { client, database } = await openDemo();
    const reading = { floor: 0.5, unit: 0.01 };
    const motion = await client.openMotion({ kind: "bvh", name: "mine", bytes: proudWalk, reading });
    const info = await motion.on(database);
    expect(info.reading).toMatchObject({ floorMetres: 0.5, floorFrom: "said", said: reading });
    expect((await motion.read()).reading).toEqual(info.reading);
    const { id } = info.reading!.skeleton;
    const remembered = { [id]: { unit: 0.01 } };
    const next = await client.openMotion({ kind: "bvh", name: "next", bytes: proudWalk, remembered });
    expect((await next.on(database)).reading).toMatchObject({ said: { unit: 0.01 }, remembered: true });
    const unlike = await client.openMotion({ kind: "bvh", name: "unlike", bytes: proudWalk, reading: {}, remembered });
    expect((await unlike.on(database)).reading).toMatchObject({ said: {}, remembered: false });
  });

  test("disposing of a database closes what was made of it, and only that", async () => {
    const { client, database, motion, info } = await openDemo();
    const other = await client.openDatabase({ kind: "demo" });
    const [first, second] = [await client.createSession(database, motion), await client.createSession(other, motion)];
    const stylizer = await client.createStylizer(database);
    const analysing = first.analyse();
    database.dispose();
    await expect(analysing).rejects.toMatchObject({ code: "cancelled" });
    await expect(first.step(0)).rejects.toMatchObject({ code: "disposed" });
    await expect(stylizer.push(info.poses.slice(0, POSE_FLOATS))).rejects.toMatchObject({ code: "disposed" });
    await expect(client.createSession(database, motion)).rejects.toMatchObject({ code: "disposed" });
    expect((await second.step(0)).inputFrame).toBe(0);
  });

  test("a cancelled opening is refused at once, and nothing of it stays open", async () => {
    const { client } = await openDemo();
    const controller = new AbortController();
    const opening = client.openDatabase({ kind: "demo" }, { signal: controller.signal });
    await new Promise((resolve) => setTimeout(resolve));
    controller.abort("changed my mind");
    await expect(opening).rejects.toMatchObject({ code: "cancelled", cause: "changed my mind" });
    // The worker opens no more objects than it closes.
    await client.builtInMotions();
    await new Promise((resolve) => setTimeout(resolve, 2000));
    const restart = restarted(client);
    worker().onerror?.({ message: "killed" } as ErrorEvent);
    await restart;
    expect(worker().calls()).toEqual(["openDatabase", "openMotion"]);
  });

  test("bad bytes and unknown options are refused", async () => {
    const { client, database, motion } = await openDemo();
    const bytes = new TextEncoder().encode("HIERARCHY").buffer as ArrayBuffer;
    const unreadable = await client.openMotion({ kind: "bvh", name: "x", bytes });
    await expect(unreadable.on(database)).rejects.toMatchObject({ code: "bad-file" });
    const wrong: object[] = [
      { styles: { none: 1 } },
      { k: 0 },
      { bogus: 1 },
      { action: "swim" },
      { parts: { tail: {} } },
    ];
    for (const options of wrong)
      await expect(client.createSession(database, motion, options)).rejects.toMatchObject({ code: "bad-input" });
  });

  test("a motion says what its file holds before there is a database", async () => {
    const client = connect();
    const mine = await client.openMotion({ kind: "bvh", name: "mine", bytes: proudWalk });
    const { frames, rateHz, durationSecs, note } = await mine.read();
    const text = new TextDecoder().decode(proudWalk);
    expect(frames).toBe(Number(/Frames:\s*(\d+)/.exec(text)![1]));
    expect(1 / rateHz).toBeCloseTo(Number(/Frame Time:\s*(\S+)/.exec(text)![1]), 12);
    expect(durationSecs).toBe(frames / rateHz);
    expect(note).toMatch(/\.$/);
    const walk = await client.openMotion({ kind: "built-in", name: "neutral walk" });
    expect((await walk.read()).rateHz).toBe(60);
    const bytes = new TextEncoder().encode("HIERARCHY").buffer as ArrayBuffer;
    const unreadable = await client.openMotion({ kind: "bvh", name: "x", bytes });
    await expect(unreadable.read()).rejects.toMatchObject({ code: "bad-file" });
  });

  test("the size of the engine's memory is told: whole pages of WebAssembly, never fewer than before", async () => {
    const client = connect();
    const before = await client.memory();
    expect(before.wasmBytes).toBeGreaterThan(0);
    expect(before.wasmBytes % 65_536).toBe(0);
    const database = await client.openDatabase({ kind: "demo" });
    const opened = await client.memory();
    // The database's poses alone.
    expect(opened.wasmBytes).toBeGreaterThan(database.info.frames * POSE_FLOATS * 4);
    expect(opened.wasmBytes).toBeGreaterThanOrEqual(before.wasmBytes);
    database.dispose();
    expect((await client.memory()).wasmBytes).toBe(opened.wasmBytes);
  });

  test("what is open is told, with estimates of what it takes, until it is disposed of", async () => {
    const client = connect();
    expect((await client.memory()).open).toEqual([]);
    const database = await client.openDatabase({ kind: "demo" });
    const motion = await client.openMotion({ kind: "bvh", name: "mine", bytes: proudWalk });
    const file = proudWalk.byteLength;
    expect((await client.memory()).open[1]).toEqual({ kind: "motion", bytes: file });
    const session = await client.createSession(database, motion);
    await client.createStylizer(database);
    const { frames } = await motion.on(database);
    const { open, wasmBytes } = await client.memory();
    expect(open.map(({ kind }) => kind)).toEqual(["database", "motion", "session", "stylizer"]);
    // Its poses, and the search index.
    expect(open[0]!.bytes).toBeGreaterThan(database.info.frames * POSE_FLOATS * 4);
    expect(open[1]!.bytes).toBeGreaterThan(file + frames * POSE_FLOATS * 4);
    expect(open.reduce((sum, { bytes }) => sum + bytes, 0)).toBeLessThan(wasmBytes + file);
    await session.analyse();
    expect((await client.memory()).open[2]!.bytes).toBeGreaterThan(open[2]!.bytes);
    motion.dispose();
    expect((await client.memory()).open.map(({ kind }) => kind)).toEqual(["database", "stylizer"]);
  });

  test("the source of a motion may be changed by its caller", async () => {
    const { client, database } = await openDemo();
    const bytes = proudWalk.slice(0);
    const motion = await client.openMotion({ kind: "bvh", name: "mine", bytes });
    const session = await client.createSession(database, motion);
    const before = await session.seek(30);
    new Uint8Array(bytes).fill(0);
    const restart = restarted(client);
    worker().onerror?.({ message: "killed" } as ErrorEvent);
    expect((await restart).lost).toEqual([]);
    expect((await session.step(0)).pose).toEqual(before.pose);
  });
});

describe("a live stylizer", () => {
  const OLD = { styles: { old: 1 } };

  test("gives the same for one batch and for many, with a change of style between", async () => {
    const { client, database, info } = await openDemo();
    const poses = info.poses.subarray(0, 60 * POSE_FLOATS);
    const pushed = async (batch: number) => {
      const stylizer = await client.createStylizer(database, OLD);
      const out: number[] = [];
      for (let frame = 0; frame < 60; frame += batch) {
        if (frame === 30) stylizer.setStyles({ proud: 1 });
        const { poses: styled } = await stylizer.push(
          poses.subarray(frame * POSE_FLOATS, (frame + batch) * POSE_FLOATS),
        );
        out.push(...styled);
      }
      stylizer.dispose();
      return out;
    };
    const whole = await pushed(30);
    expect(whole).toEqual(await pushed(1));
    expect(whole).toHaveLength(60 * POSE_FLOATS);
    expect(whole.every(Number.isFinite)).toBe(true);
  });

  test("takes a change at once where the half-life is none", async () => {
    const { client, database, info } = await openDemo();
    const poses = info.poses.subarray(0, 40 * POSE_FLOATS);
    const changed = await client.createStylizer(database, OLD);
    changed.setStyles({ proud: 1 }, { halfLifeSecs: 0 });
    const proud = await client.createStylizer(database, { styles: { proud: 1 } });
    expect((await changed.push(poses)).poses).toEqual((await proud.push(poses)).poses);
  });

  test("refuses at once what is out of range, and goes on", async () => {
    const { client, database, info } = await openDemo();
    const pose = info.poses.subarray(0, POSE_FLOATS);
    const stylizer = await client.createStylizer(database);
    expect(() => stylizer.setStyles({ none: 1 })).toThrow(/no style 'none'/);
    expect(() => stylizer.setStyles({ old: Number.NaN })).toThrow(/NaN/);
    expect(() => stylizer.configure({ rho: 2 })).toThrow(/rho is 2/);
    await expect(stylizer.push(new Float32Array(POSE_FLOATS + 1))).rejects.toMatchObject({ code: "bad-input" });
    const many = new Float32Array((MAX_PUSH_FRAMES + 1) * POSE_FLOATS);
    await expect(stylizer.push(many)).rejects.toMatchObject({ code: "bad-input" });
    expect((await stylizer.push(pose)).durations).toEqual(new Float32Array([0]));
    await stylizer.push(pose);
    stylizer.reset();
    expect((await stylizer.push(pose)).durations).toEqual(new Float32Array([0]));
  });
});

test("the ranges of options are the engine's", async () => {
  const { client, database, motion } = await openDemo();
  const session = await client.createSession(database, motion);
  for (const [name, [min, max]] of Object.entries(OPTION_RANGES)) {
    const outside = [min === 0 ? -1 : min / 2, max * 1.02];
    for (const value of [min, max].filter(Number.isFinite))
      await session.configure({ ...DEFAULT_OPTIONS, [name]: value });
    for (const value of outside.filter(Number.isFinite))
      await expect(session.configure({ ...DEFAULT_OPTIONS, [name]: value }), `${name} ${value}`).rejects.toMatchObject({
        code: "bad-input",
      });
  }
});

describe("a worker that is killed", () => {
  /** Three sessions and a stylizer, over two databases and two motions, each at a different position. */
  async function openThree() {
    const { client, database, motion, info } = await openDemo();
    const other = await client.openDatabase({ kind: "demo" });
    const mine = await client.openMotion({ kind: "bvh", name: "mine", bytes: proudWalk });
    const sessions = [
      await client.createSession(database, motion, { styles: { old: 1 } }),
      await client.createSession(other, motion, { styles: { proud: 0.5 } }),
      await client.createSession(other, mine, { k: 10 }),
    ];
    await sessions[0]!.setLoop(false);
    await sessions[2]!.setLoop(true, { first: 10, last: 50 });
    const stylizer = await client.createStylizer(database);
    stylizer.setStyles({ old: 1 });
    await sessions[1]!.configure({ ...DEFAULT_OPTIONS, styles: { proud: 1 } });
    const frames = await Promise.all(sessions.map((session, i) => session.seek(20 + 10 * i)));
    return { client, database, info, sessions, stylizer, frames };
  }

  test("comes back with all three of its sessions, each at its place", async () => {
    const { client, database, info, sessions, stylizer, frames } = await openThree();
    const poses = info.poses.subarray(0, 30 * POSE_FLOATS);
    const first = worker();
    const restart = restarted(client);
    const waiting = sessions[0]!.analyse();
    await Promise.resolve();
    first.onerror?.({ message: "killed" } as ErrorEvent);
    await expect(waiting).rejects.toMatchObject({ code: "fault" });
    expect(await restart).toEqual({ message: "The engine failed: killed.", lost: [] });
    expect(first.terminated).toBe(true);
    const again = await Promise.all(sessions.map((session) => session.step(0)));
    expect(again.map(({ pose }) => pose)).toEqual(frames.map(({ pose }) => pose));
    expect(again.map(({ inputFrame }) => inputFrame)).toEqual([20, 30, 40]);
    expect((await sessions[2]!.step(0.5)).looped).toBe(true);
    await sessions[0]!.seek(info.frames);
    expect((await sessions[0]!.step(1)).ended).toBe(true);
    const fresh = await client.createStylizer(database, { styles: { old: 1 } });
    expect((await stylizer.push(poses)).poses).toEqual((await fresh.push(poses)).poses);
  });

  test("while it is reopening, is replaced by one where all is closed", async () => {
    const { client, sessions } = await openThree();
    const restart = restarted(client);
    worker().onerror?.({ message: "killed" } as ErrorEvent);
    while (worker().calls().length < 2) await new Promise((resolve) => setTimeout(resolve));
    worker().onerror?.({ message: "killed again" } as ErrorEvent);
    expect((await restart).lost).toHaveLength(8);
    for (const session of sessions) await expect(session.step(0)).rejects.toMatchObject({ code: "not-open" });
    expect((await client.openDatabase({ kind: "demo" })).info.styles).toContain("proud");
  });
});

describe("models", () => {
  test("of walks and key styles are trained, opened and disposed of", async () => {
    const client = connect();
    const progress: Progress[] = [];
    const walk = await client.openWalk({ database: undefined }, { onProgress: (p) => progress.push(p) });
    expect(walk.walker().next().pose).toHaveLength(POSE_FLOATS);
    expect(progress.at(-1)!.fraction).toBe(1);
    const order = { clips: [], action: "walk", axes: ["foot_separation"], components: 0, em: false };
    const keys = await client.openKeyStyle({ motions: { database: undefined }, order });
    expect(keys.axes).toEqual(["foot_separation"]);
    client.dispose();
    expect(() => walk.walker()).toThrow(/disposed|dispose\(\)/);
    expect(() => keys.poser()).toThrow(/disposed|dispose\(\)/);
  });
});
