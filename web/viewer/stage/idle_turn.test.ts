import { describe, expect, it } from "vitest";
import { IdleTurn } from "./idle_turn";

const state = ({ isWaiting, isAllowed }: IdleTurn) => ({ isWaiting, isAllowed });
const NOTHING = { isWaiting: false, isAllowed: false };
const idle = async () => {};

describe("synchronous calls", () => {
  it("are allowed once the graphics processor is idle, and only in that task", async () => {
    const turn = new IdleTurn();
    let during: object | undefined;
    const taken = turn.take(idle, () => {
      during = state(turn);
    });
    expect(state(turn)).toEqual({ isWaiting: true, isAllowed: false });
    await taken;
    expect(during).toEqual({ isWaiting: false, isAllowed: true });
    expect(state(turn)).toEqual(NOTHING);
  });

  it("are not allowed after a drawing that failed", async () => {
    const turn = new IdleTurn();
    const fail = () => {
      throw new Error("a shader is wrong");
    };
    await expect(turn.take(idle, fail)).rejects.toThrow("a shader is wrong");
    expect(state(turn)).toEqual(NOTHING);
  });

  it("are not awaited for ever where the wait failed", async () => {
    const turn = new IdleTurn();
    await expect(
      turn.take(
        () => Promise.reject(new Error("lost")),
        () => {},
      ),
    ).rejects.toThrow("lost");
    expect(state(turn)).toEqual(NOTHING);
  });
});
