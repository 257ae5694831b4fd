import { describe, expect, it } from "vitest";
import { IdleTask } from "./idle_task";

const state = ({ isWaiting, isAllowed }: IdleTask) => ({ isWaiting, isAllowed });
const NOTHING = { isWaiting: false, isAllowed: false };
const idle = async () => {};

describe("synchronous calls", () => {
  it("are allowed once the graphics processor is idle, and only in that task", async () => {
    const task = new IdleTask();
    let during: object | undefined;
    const taken = task.run(idle, () => {
      during = state(task);
    });
    expect(state(task)).toEqual({ isWaiting: true, isAllowed: false });
    await taken;
    expect(during).toEqual({ isWaiting: false, isAllowed: true });
    expect(state(task)).toEqual(NOTHING);
  });

  it("are not allowed after a drawing that failed", async () => {
    const task = new IdleTask();
    const fail = () => {
      throw new Error("a shader is wrong");
    };
    await expect(task.run(idle, fail)).rejects.toThrow("a shader is wrong");
    expect(state(task)).toEqual(NOTHING);
  });

  it("are not awaited for ever where the wait failed", async () => {
    const task = new IdleTask();
    await expect(
      task.run(
        () => Promise.reject(new Error("lost")),
        () => {},
      ),
    ).rejects.toThrow("lost");
    expect(state(task)).toEqual(NOTHING);
  });
});
