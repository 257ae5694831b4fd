import { expect, test } from "vitest";
import { LeaveGuard } from "./leave_guard";

test("leaving is asked about only while something would be lost", () => {
  const page = new EventTarget();
  const listen = globalThis.addEventListener;
  globalThis.addEventListener = page.addEventListener.bind(page) as typeof addEventListener;
  const isAsked = () => !page.dispatchEvent(new Event("beforeunload", { cancelable: true }));
  const guard = new LeaveGuard();
  expect(isAsked()).toBe(false);
  for (const needed of [true, true, false, true, false]) {
    guard.needed = needed;
    expect(isAsked()).toBe(needed);
  }
  globalThis.addEventListener = listen;
});
