import { expect, test } from "vitest";
import { joinedWorker } from "../../tests/joined_worker";
import { StrutError } from "../engine/errors";
import { RpcClient, remote } from "./rpc_client";

interface Calls {
  add(a: number, b: number, options?: { signal?: AbortSignal }): Promise<number>;
  samples(): Promise<{ at: Float32Array }>;
  refuse(): Promise<void>;
  hang(options?: { signal?: AbortSignal }): Promise<void>;
}

const TABLE = {
  // Refuses what it was not declared with.
  add: async (...args: number[]) => (args.length === 2 ? args[0]! + args[1]! : Number.NaN),
  count: async (...args: unknown[]) => args.length,
  samples: async () => ({ at: Float32Array.of(1, 2) }),
  refuse: async () => {
    throw new StrutError({ code: "bad-input", message: "No.", hint: "" });
  },
  hang: () => new Promise<void>(() => {}),
};

/** Both ends of a worker, connected without a thread. */
function joined({ limitMs }: { limitMs?: number } = {}) {
  let spawned = 0;
  const spawn = () => {
    spawned += 1;
    return joinedWorker(TABLE);
  };
  const rpc = new RpcClient<Calls>(spawn, "engine of the lessons", limitMs);
  const calls = remote(rpc);
  return { rpc, calls, spawned: () => spawned };
}

test("a worker starts with the first call, and answers it", async () => {
  const { calls, spawned } = joined();
  expect(spawned()).toBe(0);
  expect(await calls.add(1, 2)).toBe(3);
  expect([...(await calls.samples()).at]).toEqual([1, 2]);
  expect(spawned()).toBe(1);
});

test("options with a signal are not sent, and everything else is", async () => {
  const { calls } = joined();
  expect(await calls.add(1, 2, { signal: new AbortController().signal })).toBe(3);
  expect(await (calls as unknown as { count(...args: unknown[]): Promise<number> }).count({}, undefined)).toBe(2);
});

test("a promise may resolve with it", async () => {
  const { calls } = joined();
  expect(await (await Promise.resolve(calls)).add(1, 2)).toBe(3);
});

test("errors arrive as they were thrown", async () => {
  await expect(joined().calls.refuse()).rejects.toMatchObject({ code: "bad-input", message: "No." });
});

test("an aborted call is rejected at once, before or while it runs", async () => {
  const { calls } = joined();
  await expect(calls.hang({ signal: AbortSignal.abort() })).rejects.toMatchObject({ code: "cancelled" });
  const abort = new AbortController();
  const waiting = calls.hang({ signal: abort.signal });
  abort.abort();
  await expect(waiting).rejects.toMatchObject({ code: "cancelled" });
});

test("a call that the table lacks is a fault, and the next call has another worker", async () => {
  const { rpc, calls, spawned } = joined();
  await expect((rpc as RpcClient<{ toString(): string }>).call("toString", [])).rejects.toMatchObject({
    code: "fault",
  });
  expect(await calls.add(2, 2)).toBe(4);
  expect(spawned()).toBe(2);
});

test("nothing waits for an engine that is disposed of", async () => {
  const { rpc, calls } = joined();
  const waiting = calls.hang();
  rpc.dispose();
  await expect(waiting).rejects.toMatchObject({ code: "disposed" });
  await expect(calls.add(1, 1)).rejects.toMatchObject({ code: "disposed" });
});

test("what cannot be sent is refused, and nothing is waited for", async () => {
  const sent: unknown[] = [];
  const worker = () => ({
    postMessage: (message: unknown) => sent.push(structuredClone(message)),
    terminate: () => {},
    onmessage: null,
    onerror: null,
  });
  const rpc = new RpcClient<{ add(...args: unknown[]): number }>(worker, "engine of the lessons");
  await expect(rpc.call("add", [() => 1])).rejects.toMatchObject({ code: "bad-input" });
  void rpc.call("add", [new Proxy({ a: [1] }, {})]).catch(() => {});
  expect(sent).toMatchObject([{ method: "add", args: [{ a: [1] }] }]);
  rpc.dispose();
});

test("a worker that stays silent is replaced, and its calls are rejected", async () => {
  const { calls, spawned } = joined({ limitMs: 20 });
  await expect(calls.hang()).rejects.toMatchObject({
    code: "fault",
    message: expect.stringContaining("its worker does not answer"),
  });
  expect(await calls.add(1, 2)).toBe(3);
  expect(spawned()).toBe(2);
});

test("a silent worker without calls is kept", async () => {
  const { calls, spawned } = joined({ limitMs: 20 });
  await calls.add(1, 2);
  await new Promise((resolve) => setTimeout(resolve, 100));
  await calls.add(1, 2);
  expect(spawned()).toBe(1);
});
