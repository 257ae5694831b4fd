import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import type { ViewName } from "../../link/page";
import type { View, ViewHost } from "../view";
import { Views } from "./views";

/** A fake view that logs its calls. */
function fakeView(said: string[], name: string, holdsWork = false) {
  return {
    element: { remove: () => said.push(`${name} removed`) } as unknown as HTMLElement,
    history: { canUndo: false, canRedo: false, undo: () => {}, redo: () => {} },
    holdsWork,
    show: () => said.push(`${name} shown`),
    hide: () => said.push(`${name} hidden`),
    dispose: () => said.push(`${name} disposed`),
  } as unknown as View & { holdsWork: boolean };
}

function made(holdsWork = false) {
  const said: string[] = [];
  const walk = fakeView(said, "walk", holdsWork);
  const signals: AbortSignal[] = [];
  const views = new Views(
    () => {},
    {
      host: (signal) => {
        signals.push(signal);
        return {} as ViewHost;
      },
      onShow: (name) => said.push(`at ${name}`),
      onRefused: (name, error) => said.push(`${name} refused: ${(error as Error).message}`),
    },
    [
      { name: "play", load: async () => ({ createView: () => fakeView(said, "play") }) },
      { name: "walk", load: async () => ({ createView: () => walk }) },
      { name: "data", load: () => Promise.reject(new Error("offline")) },
      {
        name: "crowd",
        load: async () => ({
          createView: () => {
            throw new Error("no memory");
          },
        }),
      },
    ],
  );
  const take = () => said.splice(0);
  const show = async (name: ViewName) => {
    await views.show(name);
    return take();
  };
  return { views, walk, signals, show, take };
}

// Yielding to other tasks uses a timer, too, which must continue.
beforeEach(() => void vi.useFakeTimers({ shouldAdvanceTime: true }));
afterEach(() => void vi.useRealTimers());

describe("the views", () => {
  it("are shown one at a time", async () => {
    const { show } = made();
    expect(await show("play")).toEqual(["play shown", "at play"]);
    expect(await show("walk")).toEqual(["play hidden", "play removed", "walk shown", "at walk"]);
    expect(await show("walk")).toEqual([]);
  });

  it("that cannot be made leave nothing behind", async () => {
    const { show, signals } = made();
    expect(await show("crowd")).toEqual(["crowd refused: no memory"]);
    expect(signals.map((signal) => signal.aborted)).toEqual([true]);
  });

  it("are disposed of after a minute out of sight, and made again", async () => {
    const { show, take, signals } = made();
    await show("walk");
    await show("play");
    await vi.advanceTimersByTimeAsync(59_000);
    expect(take()).toEqual([]);
    await vi.advanceTimersByTimeAsync(2_000);
    expect(take()).toEqual(["walk disposed", "walk removed"]);
    expect(signals[0]!.aborted).toBe(true);
    expect(await show("walk")).toEqual(["play hidden", "play removed", "walk shown", "at walk"]);
    expect(signals.length).toBe(3);
  });

  it("stay where they are shown again in time", async () => {
    const { show, take } = made();
    await show("walk");
    await show("play");
    await vi.advanceTimersByTimeAsync(50_000);
    await show("walk");
    await vi.advanceTimersByTimeAsync(50_000);
    expect(take()).toEqual([]);
  });

  it("stay while they hold what a person made", async () => {
    const { show, take, walk } = made(true);
    await show("walk");
    await show("play");
    await vi.advanceTimersByTimeAsync(200_000);
    expect(take()).toEqual([]);
    walk.holdsWork = false;
    await vi.advanceTimersByTimeAsync(61_000);
    expect(take()).toContain("walk disposed");
  });

  it("say whether any of them holds what the browser does not keep", async () => {
    const { show, views, walk } = made();
    await show("walk");
    expect(views.holdUnkept).toBe(false);
    Object.assign(walk, { holdsUnkept: true });
    await show("play");
    expect(views.holdUnkept).toBe(true);
    await vi.advanceTimersByTimeAsync(61_000);
    expect(views.holdUnkept).toBe(false);
  });

  it("leave the one before where another cannot be loaded", async () => {
    const { show, views } = made();
    await show("play");
    const before = views.shown;
    expect(await show("data")).toEqual(["data refused: offline"]);
    expect(views.shown).toBe(before);
  });
});
