import { expect, test } from "vitest";
import { ExportTurn } from "./export_turn";

function made() {
  let isPossible = true;
  const turn = new ExportTurn((can) => {
    isPossible = can;
  });
  return { turn, isPossible: () => isPossible };
}

test("nothing can be exported before an input is open", () => {
  const { turn, isPossible } = made();
  expect(isPossible()).toBe(false);
  turn.inputOpened();
  expect(isPossible()).toBe(true);
});

test("no second export begins during one, also where another input is opened meanwhile", async () => {
  const { turn, isPossible } = made();
  turn.inputOpened();
  await turn.take(async () => {
    expect(isPossible()).toBe(false);
    turn.inputOpened();
    expect(isPossible()).toBe(false);
  });
  expect(isPossible()).toBe(true);
});

test("another export can begin after one that failed", async () => {
  const { turn, isPossible } = made();
  turn.inputOpened();
  await expect(turn.take(() => Promise.reject(new Error("no memory")))).rejects.toThrow("no memory");
  expect(isPossible()).toBe(true);
});
