/**
 * The client without the playground, on a separate page: a worker with three sessions ends, and all three are restored.
 */
import { mkdtempSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { build, preview } from "vite";
import { expect, it } from "vitest";
import { eventually, launchBrowser } from "./browser";
import type { SessionsHook } from "./sessions/main";

declare const window: { sessions: SessionsHook };
/** The worker's scope, inside `evaluate`. */
declare const self: { close(): void };

it("a worker that is ended with three sessions open comes back with all three", async () => {
  const outDir = mkdtempSync(join(tmpdir(), "strut-sessions-"));
  const site = {
    root: join(import.meta.dirname, "sessions"),
    configFile: false,
    logLevel: "error",
    build: { outDir, emptyOutDir: true, target: "es2022" },
    worker: { format: "es" },
    preview: { port: 0, open: false },
  } as const;
  await build(site);
  const [browser, server] = await Promise.all([launchBrowser(), preview(site)]);
  try {
    const page = await browser.newPage();
    await page.goto(server.resolvedUrls!.local[0]!);
    await page.waitForFunction(() => window.sessions !== undefined);
    const before = await page.evaluate(() => window.sessions.begin());
    expect(before.map(({ inputFrame }) => inputFrame)).toEqual([20, 30, 40]);
    expect(page.workers()).toHaveLength(1);
    // It ends silently, as when the browser ends it for lack of memory.
    await page.workers()[0]!.evaluate(() => {
      setTimeout(() => self.close());
    });
    const after = await page.evaluate(() => window.sessions.comeBack());
    expect(after).toEqual({ code: "fault", lost: 0, places: before });
    await eventually(() => page.workers().length).toBe(1);
  } finally {
    await browser.close();
    await server.close();
  }
});
