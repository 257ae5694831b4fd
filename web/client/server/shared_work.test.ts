import { describe, expect, it } from "vitest";
import type { Caller } from "../rpc_server";
import { SharedWork } from "./shared_work";
import { runToEnd } from "./time_slices";

/** A job of three slices, and the number of finished slices. */
function job() {
  const slices = {
    done: 0,
    frames: 3,
    run() {
      slices.done += 1;
      return slices.done >= slices.frames;
    },
  };
  return slices;
}

function caller(): Caller & { cancelled: boolean; fractions: number[] } {
  const one = {
    cancelled: false,
    fractions: [] as number[],
    isCancelled: () => one.cancelled,
    report: ({ fraction }: { fraction: number }) => one.fractions.push(fraction),
  };
  return one;
}

describe("shared work", () => {
  it("is done once for all callers, and reports its progress to each", async () => {
    const [first, second, slices] = [caller(), caller(), job()];
    const work = new SharedWork((all) => runToEnd(slices, all).then(() => "styled"), first);
    expect(await Promise.all([work.for(first), work.for(second)])).toEqual(["styled", "styled"]);
    expect(slices.done).toBe(3);
    expect(first.fractions).toEqual([1 / 3, 2 / 3]);
    expect(second.fractions).toEqual([2 / 3]);
  });

  it("goes on while one caller waits, and fails for the cancelled one", async () => {
    const [first, second, slices] = [caller(), caller(), job()];
    const work = new SharedWork((all) => runToEnd(slices, all), first);
    const both = [work.for(first), work.for(second)];
    first.cancelled = true;
    const [cancelled, done] = await Promise.allSettled(both);
    expect(cancelled).toMatchObject({ status: "rejected", reason: { code: "cancelled" } });
    expect(done?.status).toBe("fulfilled");
  });

  it("stops when no caller waits", async () => {
    const [first, slices] = [caller(), job()];
    const work = new SharedWork((all) => runToEnd(slices, all), first);
    const result = work.for(first);
    first.cancelled = true;
    await expect(result).rejects.toMatchObject({ code: "cancelled" });
    expect(slices.done).toBe(1);
  });
});
