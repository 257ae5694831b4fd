/** Several sessions in one worker, with real threads: they are independent, and all survive its end. */
import { afterEach, beforeAll, expect, test } from "vitest";
import type { Patience } from "../../web/client/connection";
import { EngineClient, type EngineRestart } from "../../web/client/engine_client";
import type { ClientSession } from "../../web/client/handles";
import type { LiveFrame, StylizeOptions } from "../../web/client/protocol";
import { buildWorker, ThreadWorker } from "./thread_worker";

const STEPS = 60;
/** Two sessions that differ in all properties of a session: options, loop, position and speed. */
const SCENES: readonly Scene[] = [
  { options: { styles: { old: 1 }, rho: 0.5 }, range: { first: 5, last: 60 }, frame: 20, stepSecs: 1 / 60 },
  { options: { styles: { proud: 0.7 }, timing: false }, range: { first: 0, last: 90 }, frame: 50, stepSecs: 1 / 45 },
];

interface Scene {
  options: Partial<StylizeOptions>;
  range: { first: number; last: number };
  frame: number;
  stepSecs: number;
}

let path: string;
beforeAll(async () => {
  path = await buildWorker();
});

let clients: EngineClient[] = [];
afterEach(() => {
  for (const client of clients) client.dispose();
  clients = [];
});

/** Opens a client with the built-in database and a motion; `worker` is its newest worker. */
async function openDemo(patience: Partial<Patience> = {}) {
  const workers: ThreadWorker[] = [];
  const spawn = () => {
    workers.push(new ThreadWorker(path));
    return workers.at(-1)!;
  };
  const client = new EngineClient({ spawn, patience });
  clients.push(client);
  const database = await client.openDatabase({ kind: "demo" });
  const motion = await client.openMotion({ kind: "built-in", name: "neutral walk" });
  const begin = async ({ options, range, frame }: Scene) => {
    const session = await client.createSession(database, motion, options);
    await session.setLoop(true, range);
    await session.seek(frame);
    return session;
  };
  return { client, begin, worker: () => workers.at(-1)! };
}

/** Steps sessions in turn, without waiting for one before the next request, and returns the frames of each. */
async function interleaved(sessions: readonly ClientSession[]): Promise<LiveFrame[][]> {
  const frames: LiveFrame[][] = sessions.map(() => []);
  for (let i = 0; i < STEPS; i++) {
    const round = await Promise.all(sessions.map((session, k) => session.step(SCENES[k]!.stepSecs)));
    for (const [k, frame] of round.entries()) frames[k]!.push({ ...frame, frameMs: 0 });
  }
  return frames;
}

test("two sessions in one worker, interleaved, play bit for bit as in two workers", async () => {
  const one = await openDemo();
  const together = await interleaved([await one.begin(SCENES[0]!), await one.begin(SCENES[1]!)]);
  const [first, second] = [await openDemo(), await openDemo()];
  const apart = await interleaved([await first.begin(SCENES[0]!), await second.begin(SCENES[1]!)]);
  expect(together).toEqual(apart);
  expect(together[0]!.some(({ looped }) => looped)).toBe(true);
});

test("the comparison notices a session that is shared", async () => {
  const one = await openDemo();
  const shared = await one.begin(SCENES[0]!);
  const together = await interleaved([shared, shared]);
  const two = await openDemo();
  const apart = await interleaved([await two.begin(SCENES[0]!), await two.begin(SCENES[0]!)]);
  expect(together).not.toEqual(apart);
});

test("a worker that is killed with three sessions open comes back with all three", async () => {
  // As long as opening a database may take on a slow machine.
  const { client, begin, worker } = await openDemo({ silenceMs: 5000, pingMs: 5000 });
  const restart = new Promise<EngineRestart>((resolve) => {
    client.onRestart = resolve;
  });
  const third: Scene = { options: { k: 10 }, range: { first: 0, last: 149 }, frame: 33, stepSecs: 1 / 60 };
  const sessions = await Promise.all([...SCENES, third].map(begin));
  const before = await Promise.all(sessions.map((session) => session.step(0)));
  await worker().kill();
  await expect(sessions[0]!.step(0.1)).rejects.toMatchObject({ code: "fault" });
  expect(await restart).toEqual({ message: "The engine failed: its worker does not answer.", lost: [] });
  const after = await Promise.all(sessions.map((session) => session.step(0)));
  expect(after.map(({ pose }) => pose)).toEqual(before.map(({ pose }) => pose));
  expect(after.map(({ inputFrame }) => inputFrame)).toEqual([20, 50, 33]);
});
