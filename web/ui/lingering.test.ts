import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { Lingering } from "./lingering";

beforeEach(() => vi.useFakeTimers());
afterEach(() => vi.useRealTimers());

function counted() {
  let made = 0;
  const closed: number[] = [];
  const shared = new Lingering(
    1000,
    () => ++made,
    (value) => closed.push(value),
  );
  return { shared, closed };
}

it("shares one value until a while after the last user", () => {
  const { shared, closed } = counted();
  const [first, second] = [shared.lease(), shared.lease()];
  expect([first.value, second.value]).toEqual([1, 1]);
  first.release();
  vi.advanceTimersByTime(5000);
  expect(closed).toEqual([]);
  second.release();
  vi.advanceTimersByTime(999);
  expect(closed).toEqual([]);
  vi.advanceTimersByTime(1);
  expect(closed).toEqual([1]);
  expect(shared.lease().value).toBe(2);
});

it("stays open for a user who comes back in time", () => {
  const { shared, closed } = counted();
  shared.lease().release();
  vi.advanceTimersByTime(900);
  const lease = shared.lease();
  vi.advanceTimersByTime(5000);
  expect([lease.value, closed]).toEqual([1, []]);
});

it("counts a release once", () => {
  const { shared, closed } = counted();
  const [first] = [shared.lease(), shared.lease()];
  first.release();
  first.release();
  vi.advanceTimersByTime(5000);
  expect(closed).toEqual([]);
});

it("has no user if it could not be made", () => {
  const make = vi
    .fn(() => 7)
    .mockImplementationOnce(() => {
      throw new Error("no context");
    });
  const closed: number[] = [];
  const shared = new Lingering(1000, make, (value) => closed.push(value));
  expect(() => shared.lease()).toThrow("no context");
  shared.lease().release();
  vi.advanceTimersByTime(1000);
  expect(closed).toEqual([7]);
});
