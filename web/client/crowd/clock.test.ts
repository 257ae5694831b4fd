import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { PAGE_CLOCK } from "./clock";

/** A page that can be hidden. */
class FakePage extends EventTarget {
  hidden = false;

  show(shown: boolean): void {
    this.hidden = !shown;
    this.dispatchEvent(new Event("visibilitychange"));
  }
}

let page: FakePage;
const call = vi.fn();

beforeEach(() => {
  vi.useFakeTimers();
  call.mockClear();
  page = new FakePage();
  vi.stubGlobal("document", page);
});
afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

it("calls back after a time, once", () => {
  PAGE_CLOCK.after(10, call);
  vi.advanceTimersByTime(10);
  page.show(false);
  page.show(true);
  expect(call).toHaveBeenCalledOnce();
});

it("waits while the page is hidden", () => {
  PAGE_CLOCK.after(10, call);
  page.show(false);
  vi.advanceTimersByTime(60_000);
  expect(call).not.toHaveBeenCalled();
  page.show(true);
  expect(call).toHaveBeenCalledOnce();
});

it("does not call back what was ended, before or after the page was hidden", () => {
  PAGE_CLOCK.after(10, call)();
  const end = PAGE_CLOCK.after(10, call);
  page.show(false);
  vi.advanceTimersByTime(20);
  end();
  page.show(true);
  expect(call).not.toHaveBeenCalled();
});
