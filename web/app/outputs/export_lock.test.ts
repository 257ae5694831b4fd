import { expect, test } from "vitest";
import { ExportLock } from "./export_lock";

function made() {
  let isPossible = true;
  const lock = new ExportLock((can) => {
    isPossible = can;
  });
  return { lock, isPossible: () => isPossible };
}

test("nothing can be exported before an input is open", () => {
  const { lock, isPossible } = made();
  expect(isPossible()).toBe(false);
  lock.inputOpened();
  expect(isPossible()).toBe(true);
});

test("no second export can begin during one, even if another input is opened", async () => {
  const { lock, isPossible } = made();
  lock.inputOpened();
  await lock.run(async () => {
    expect(isPossible()).toBe(false);
    lock.inputOpened();
    expect(isPossible()).toBe(false);
  });
  expect(isPossible()).toBe(true);
});

test("an export can begin after one that failed", async () => {
  const { lock, isPossible } = made();
  lock.inputOpened();
  await expect(lock.run(() => Promise.reject(new Error("no memory")))).rejects.toThrow("no memory");
  expect(isPossible()).toBe(true);
});
