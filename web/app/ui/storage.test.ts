import { expect, test, vi } from "vitest";

test("the browser is asked once, and not where it has agreed before", async () => {
  const { askToPersist } = await import("./storage");
  const storage = { persisted: vi.fn(async () => false), persist: vi.fn(async () => true) };
  await askToPersist({});
  await askToPersist(storage);
  await askToPersist(storage);
  expect(storage.persist).toHaveBeenCalledTimes(1);
  vi.resetModules();
  const again = await import("./storage");
  const agreed = { persisted: async () => true, persist: vi.fn(async () => true) };
  await again.askToPersist(agreed);
  expect(agreed.persist).not.toHaveBeenCalled();
});
