import { afterEach, expect, test, vi } from "vitest";
import type { CallOptions } from "../client/protocol";
import type { Strut } from "../package/types";
import { SharedEngine } from "./shared_engine";

test("every player that waits for a file is told how far it is", async () => {
  let tell: CallOptions["onProgress"];
  let open: (database: { dispose(): void }) => void = () => {};
  const openDatabase = (_: unknown, { onProgress }: CallOptions) => {
    tell = onProgress;
    return new Promise((resolve) => {
      open = resolve;
    });
  };
  const engine = new SharedEngine(async () => ({ openDatabase }) as unknown as Strut);
  const heard: number[][] = [[], []];
  const leases = heard.map((own) =>
    engine.database("strut:walk", { onProgress: ({ fraction }) => own.push(fraction) }),
  );
  await new Promise((resolve) => setTimeout(resolve));
  tell!({ label: "", fraction: 0.5 });
  open({ dispose: () => {} });
  await Promise.all(leases);
  tell!({ label: "", fraction: 1 });
  expect(heard).toEqual([[0.5], [0.5]]);
});

afterEach(() => vi.useRealTimers());

test("an engine that nobody has used for minutes is ended, and another one is loaded for the next player", async () => {
  vi.useFakeTimers();
  const disposed: number[] = [];
  let loaded = 0;
  const engine = new SharedEngine(async () => {
    const number = ++loaded;
    return {
      openDatabase: async () => ({ dispose: () => {} }),
      dispose: () => disposed.push(number),
    } as unknown as Strut;
  });
  const [first, second] = [await engine.database("strut:walk", {}), await engine.database("strut:walk", {})];
  first.release();
  await vi.advanceTimersByTimeAsync(600_000);
  expect(disposed).toEqual([]);
  second.release();
  second.release();
  await vi.advanceTimersByTimeAsync(60_000);
  expect(disposed).toEqual([]);
  await vi.advanceTimersByTimeAsync(600_000);
  expect(disposed).toEqual([1]);
  await engine.database("strut:walk", {});
  expect(loaded).toBe(2);
});
