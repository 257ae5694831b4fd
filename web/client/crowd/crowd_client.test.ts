/** The protocol of a crowd without a thread, with a clock that the tests control. */
import { expect, test } from "vitest";
import { joinedWorker } from "../../../tests/joined_worker";
import { StrutError } from "../../engine/errors";
import type { Clock } from "./clock";
import { createCrowd } from "./crowd_client";
import type { CrowdCalls, CrowdTick } from "./protocol";

/** A clock that the test advances. */
class TestClock implements Clock {
  time = 0;
  private waits: { due: number; call: () => void }[] = [];

  now(): number {
    return this.time;
  }

  after(ms: number, call: () => void): () => void {
    const wait = { due: this.time + ms, call };
    this.waits.push(wait);
    return () => {
      this.waits = this.waits.filter((other) => other !== wait);
    };
  }

  async pass(ms: number): Promise<void> {
    const end = this.time + ms;
    for (;;) {
      await settled();
      const next = this.waits.sort((a, b) => a.due - b.due)[0];
      if (!next || next.due > end) break;
      this.waits.shift();
      this.time = next.due;
      next.call();
    }
    this.time = end;
  }
}

/** Resolves after all pending promises. */
const settled = () => new Promise<void>((resolve) => setImmediate(resolve));

/** A worker whose ticks contain their index. */
function worker() {
  const buffers = new Set<ArrayBuffer>();
  const heard: string[] = [];
  const state = { ticks: 0, reused: 0, halvesAt: 0, failsAt: 0, ended: 0, isHeld: false };
  let release = () => {};
  const table: CrowdCalls = {
    open: async (_, { count }) => {
      if (count > 1000) throw new StrutError({ code: "bad-input", message: "Too many.", hint: "" });
      return { styles: ["old"], proportions: new Float32Array(63), rateHz: 30 };
    },
    tick: async (buffer) => {
      if (state.isHeld)
        await new Promise<void>((resolve) => {
          release = resolve;
        });
      state.ticks += 1;
      if (state.ticks === state.failsAt) throw new WebAssembly.RuntimeError("unreachable");
      if (buffer) state.reused += 1;
      const into = buffer ?? new ArrayBuffer(8);
      buffers.add(into);
      const joints = new Float32Array(into, 0, 1).fill(state.ticks);
      const halves = state.ticks === state.halvesAt;
      return { count: 4, radius: 8, joints, weights: new Uint8Array(into, 4, 1), tickMs: 1, halves };
    },
    setCount: async (count) => void heard.push(`count ${count}`),
    setField: async (vertices) => void heard.push(`field ${vertices.length}`),
    setRoute: async (points) => void heard.push(`route ${points.length}`),
    setBones: async (offsets) => void heard.push(`bones ${offsets[0]} before tick ${state.ticks + 1}`),
    exportBvh: async (walker, secs) => `HIERARCHY ${walker} ${secs}`,
  };
  const spawn = () =>
    joinedWorker(table, () => {
      state.ended += 1;
    });
  return { spawn, state, heard, release: () => release() };
}

async function opened() {
  const clock = new TestClock();
  const { spawn, ...others } = worker();
  const crowd = await createCrowd({ kind: "walkers" }, { count: 4 }, { spawn, clock });
  const ticks: CrowdTick[] = [];
  const [numbers, times]: number[][] = [[], []];
  crowd.onTick = (tick) => {
    ticks.push(tick);
    numbers!.push(tick.joints[0]!);
    times!.push(clock.now());
  };
  return { crowd, clock, ticks, numbers: numbers!, times: times!, ...others };
}

test("ticks come thirty times a second, one ahead of the picture", async () => {
  const { clock, numbers, times, state } = await opened();
  await clock.pass(1001);
  expect(numbers).toEqual(Array.from({ length: 31 }, (_, i) => i + 1));
  expect(times.every((time, i) => Math.abs(time - (i * 1000) / 30) < 0.01)).toBe(true);
  expect(state.ticks).toBe(32);
});

test("three buffers travel to and fro, and the last two ticks stay readable", async () => {
  const { crowd, clock, ticks, state } = await opened();
  let readable = 0;
  const push = crowd.onTick;
  crowd.onTick = (tick) => {
    push?.(tick);
    if (ticks.at(-2)?.joints[0] === ticks.length - 1) readable += 1;
  };
  await clock.pass(500);
  expect(readable).toBe(ticks.length - 1);
  expect(state.ticks - state.reused).toBe(3);
});

test("a tick that is late is shown at once, and the time it took is not made up for", async () => {
  const { clock, ticks, times, state, release } = await opened();
  await clock.pass(100);
  state.isHeld = true;
  await clock.pass(200);
  const late = ticks.length;
  state.isHeld = false;
  release();
  await clock.pass(100);
  expect(times[late]).toBeCloseTo(300, 0);
  expect(ticks.length - late).toBeLessThanOrEqual(4);
});

test("a crowd that is paused asks for nothing, and goes on where it was", async () => {
  const { crowd, clock, ticks, numbers, state } = await opened();
  await clock.pass(100);
  crowd.playing = false;
  const { length } = ticks;
  const { ticks: asked } = state;
  await clock.pass(5000);
  expect([ticks.length, state.ticks]).toEqual([length, asked]);
  crowd.playing = true;
  await clock.pass(100);
  expect(numbers[length]).toBe(length + 1);
  expect(ticks.length - length).toBeLessThanOrEqual(4);
});

test("a crowd that is paused goes on step by step", async () => {
  const { crowd, clock, numbers } = await opened();
  crowd.playing = false;
  await crowd.step();
  expect(numbers).toEqual([1]);
  await crowd.step();
  await crowd.step();
  await clock.pass(1000);
  expect(numbers).toEqual([1, 2, 3]);
  crowd.playing = true;
  await crowd.step();
  expect(numbers, "time goes on by itself").toEqual([1, 2, 3]);
});

test("time goes on as fast as is asked for", async () => {
  const { crowd, clock, numbers } = await opened();
  crowd.speed = 0.5;
  await clock.pass(1001);
  expect(numbers.length).toBe(16);
});

test("the crowd says when its count is halved", async () => {
  const { crowd, clock, state } = await opened();
  const counts: number[] = [];
  crowd.onHalved = (count) => counts.push(count);
  state.halvesAt = 5;
  await clock.pass(1000);
  expect(counts).toEqual([2]);
});

test("controls reach the worker while it ticks", async () => {
  const { crowd, clock, heard } = await opened();
  await crowd.setCount(9);
  await crowd.setField([{ style: "old", x: 0, z: 0, reach: 1, intensity: 1 }]);
  await crowd.setRoute([]);
  expect(await crowd.exportBvh(2, 5)).toBe("HIERARCHY 2 5");
  await clock.pass(100);
  expect(heard).toEqual(["count 9", "field 1", "route 0"]);
});

test("joints lie on the bones that are asked for from the first tick on", async () => {
  const { spawn, heard } = worker();
  const bonesOf = ({ length }: Float32Array) => new Float32Array(length).fill(length);
  const crowd = await createCrowd({ kind: "walkers" }, { count: 4, bonesOf }, { spawn, clock: new TestClock() });
  expect(heard).toEqual(["bones 63 before tick 1"]);
  crowd.dispose();
});

test("the field may be chosen among the styles of the model, before others come", async () => {
  const { spawn, heard } = worker();
  const fieldOf = ([style]: readonly string[]) => [{ style: style!, x: 0, z: 0, reach: 1, intensity: 1 }];
  const crowd = await createCrowd({ kind: "walkers" }, { count: 4, fieldOf }, { spawn, clock: new TestClock() });
  expect(heard).toEqual(["field 1", "count 4"]);
  crowd.dispose();
});

test("a fault ends the crowd with one error, and so does dispose with none", async () => {
  const { crowd, clock, state, ticks } = await opened();
  const errors: string[] = [];
  crowd.onError = ({ code }) => errors.push(code);
  state.failsAt = 4;
  await clock.pass(1000);
  expect([errors, ticks.length]).toEqual([["fault"], 3]);
  expect(state.ended).toBeGreaterThan(0);

  const other = await opened();
  other.crowd.onError = ({ code }) => errors.push(code);
  other.crowd.dispose();
  await other.clock.pass(1000);
  expect([errors.length, other.ticks.length, other.state.ended]).toEqual([1, 0, 1]);
  await expect(other.crowd.setCount(3)).rejects.toMatchObject({ code: "disposed" });
});

test("what cannot be opened is refused, and its worker ends", async () => {
  const { spawn, state } = worker();
  await expect(createCrowd({ kind: "walkers" }, { count: 2000 }, { spawn })).rejects.toMatchObject({
    code: "bad-input",
  });
  const signal = AbortSignal.abort();
  await expect(createCrowd({ kind: "walkers" }, { count: 4, signal }, { spawn })).rejects.toMatchObject({
    code: "cancelled",
  });
  expect(state.ended).toBe(1);
});
