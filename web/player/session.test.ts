/** A page's session on real engines, from its first moment on. */
import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { InlineWorker } from "../../tests/inline_worker";
import { startStrutClient } from "../client/client";
import { DEFAULT_OPTIONS } from "../engine/types";
import { Session } from "./session";

const FIRST = { kind: "demo", set: "first" } as const;
const ALL = { kind: "demo" } as const;

let session: Session;

beforeEach(() => {
  vi.stubGlobal("requestAnimationFrame", (act: FrameRequestCallback) => setTimeout(() => act(performance.now()), 5));
  vi.stubGlobal("cancelAnimationFrame", clearTimeout);
  const client = startStrutClient("first", { spawnStart: () => new InlineWorker(), spawn: () => new InlineWorker() });
  session = new Session(client, { run: (_task, _subject, work) => work({}), cancel: () => {} });
  session.playback.options = { ...DEFAULT_OPTIONS, styles: { proud: 1 } };
});
afterEach(() => {
  session.dispose();
  vi.unstubAllGlobals();
});

test("a file that is saved before the first frame is styled with the whole database", async () => {
  await session.openDatabase(FIRST, "");
  const exchanging = session.exchangeDatabase(ALL, new AbortController().signal);
  const saving = session.exportBvh();
  session.listen({ onFrame: () => session.drawn() });
  session.playback.start();
  const saved = await saving;
  expect(await exchanging).toBe("done");
  expect(saved).toMatch(/^HIERARCHY/);
  // The database has changed, and the file is the same.
  expect(await session.exportBvh()).toBe(saved);
});
