/** A page's client: an engine that only plays, and a full one that replaces it. */

import { afterEach, expect, test, vi } from "vitest";
import { walksIn } from "../../tests/clips";
import { InlineWorker } from "../../tests/inline_worker";
import { DEFAULT_OPTIONS } from "../engine/types";
import type { StrutClient } from "./client";
import { startStrutClient } from "./client";

const FIRST = { kind: "demo", set: "first" } as const;
const WALK = { kind: "built-in", name: "neutral walk", set: "first" } as const;

/** Calls that an engine that only plays answers; any other call fails the test. */
const PLAYS = new Set<string>([
  ...(["openDatabase", "builtInInputs", "openMotion", "motionOn", "createSession", "configure", "setLoop"] as const),
  ...(["step", "seek", "continueFrom", "close"] as const),
]);

let client: StrutClient;
let start: InlineWorker;
let others: InlineWorker[];
afterEach(() => client.dispose());

/** A page that plays the first motions; `spawn` starts the full engines. */
async function playing(spawn = () => new InlineWorker()): Promise<void> {
  others = [];
  start = new InlineWorker(({ method }) =>
    PLAYS.has(method) ? undefined : { code: "bad-input", message: `the start engine has no ${method}`, hint: "" },
  );
  client = startStrutClient("first", {
    spawnStart: () => start,
    spawn: () => {
      const worker = spawn();
      others.push(worker);
      return worker;
    },
  });
  await client.openDatabase(FIRST);
  await client.openInput(WALK);
  await client.configure({ ...DEFAULT_OPTIONS, styles: { proud: 1 } });
  await client.setLoop(true);
}

/** The worker of a package that has only the first built-in motions. */
const withoutOthers = () =>
  new InlineWorker(({ method, args }) =>
    method === "openDatabase" && JSON.stringify(args[1]) === JSON.stringify({ kind: "demo" })
      ? { code: "load", message: "The built-in motions could not be loaded.", hint: "" }
      : undefined,
  );

test("plays without an engine that can do more", async () => {
  await playing();
  const frame = await client.step(0.1);
  expect(frame.pose.every(Number.isFinite)).toBe(true);
  expect((await client.seek(12)).inputFrame).toBeCloseTo(12, 5);
  expect(await client.builtInInputs()).toEqual(["neutral walk"]);
  expect(others).toEqual([]);
});

test("what it cannot do waits for the exchange that is under way", async () => {
  await playing();
  const exchanging = client.exchangeDatabase({ kind: "demo" });
  const analysis = await client.analyse();
  const { poses } = await client.openInput({ kind: "built-in", name: "neutral run" });
  expect(analysis.poses.length).toBeGreaterThan(0);
  expect(poses.length).toBeGreaterThan(0);
  expect((await exchanging).actions).toContain("run");
  expect(others).toHaveLength(1);
  await vi.waitFor(() => expect(start.terminated).toBe(true));
});

test("what it cannot do is done by another engine where the exchange fails", async () => {
  await playing(withoutOthers);
  await client.step(0.3);
  await expect(client.exchangeDatabase({ kind: "demo" })).rejects.toMatchObject({ code: "load" });
  const before = await client.step(1 / 60);
  expect(start.terminated).toBe(false);
  const [bvh, whole] = await Promise.all([client.exportBvh(), client.analyse()]);
  expect(bvh).toContain("HIERARCHY");
  expect(whole.timeOut.length).toBeGreaterThan(10);
  // One engine for both.
  expect(others.map(({ terminated }) => terminated)).toEqual([true, false]);
  const after = await client.step(1 / 60);
  expect(after.inputFrame - before.inputFrame).toBeGreaterThan(0);
});

test("a file is opened again where the other engine could not be had", async () => {
  let offline = true;
  await playing(() => {
    const worker = new InlineWorker();
    if (offline) {
      worker.deaf = true;
      setTimeout(() => worker.onerror?.({ message: "404" } as ErrorEvent));
    }
    return worker;
  });
  const { neutral } = await walksIn(["neutral"]);
  const source = { kind: "bvh", name: "a clip", bytes: new TextEncoder().encode(neutral).buffer } as const;
  await expect(client.openInput(source)).rejects.toMatchObject({ code: "load" });
  expect((await client.step(0.1)).pose.every(Number.isFinite)).toBe(true);
  offline = false;
  expect((await client.openInput(source)).source).toBe("bvh");
});

test("another database is opened by another engine", async () => {
  await playing();
  await client.step(0.1);
  const info = await client.openDatabase({ kind: "demo" });
  expect(info.actions).toContain("run");
  expect(start.calls().filter((method) => method === "openDatabase")).toHaveLength(1);
  expect((await client.openInput({ kind: "built-in", name: "neutral run" })).name).toBe("neutral run");
});

test("a caller who cancels waits no longer", async () => {
  await playing();
  const abort = new AbortController();
  const exchanging = client.exchangeDatabase({ kind: "demo" });
  const analysing = client.analyse({ signal: abort.signal });
  abort.abort();
  await expect(analysing).rejects.toMatchObject({ code: "cancelled" });
  expect((await exchanging).actions).toContain("run");
  expect((await client.analyse()).poses.length).toBeGreaterThan(0);
});
