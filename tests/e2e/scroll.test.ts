/**
 * A page of twelve players is scrolled for ten seconds. Durations of frames and tasks are printed, as they depend on
 * the machine, and a film is saved (`tests/output/scroll-*.png`). There must be one engine and one WebGL context.
 */
import { cpSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Browser } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import type { StrutPlayer } from "../../web/element";
import { serveFolder } from "../package/server";
import { root } from "../recordings";
import { launchBrowser, screenshot } from "./browser";

/** Values that the page counts. */
declare const window: { contexts: number; tasks: number[]; frames: number[] };

/** Duration of the scroll, seconds. */
const SECS = 10;
/** Number of pictures of the film. */
const PICTURES = 5;

let browser: Browser;
let folder: string;
let server: Awaited<ReturnType<typeof serveFolder>>;
beforeAll(async () => {
  folder = mkdtempSync(join(tmpdir(), "strut-scroll-"));
  for (const file of ["strut-player.js", "walk.bin"]) cpSync(join(root, "dist", "package", file), join(folder, file));
  const players = Array.from(
    { length: 12 },
    (_, i) => `<p>Figure ${i + 1}.</p><strut-player autoplay controls loading="eager"></strut-player>`,
  );
  writeFileSync(
    join(folder, "index.html"),
    `<!doctype html><meta charset="utf-8"><title>Twelve</title><script src="strut-player.js"></script>
     <main style="width:688px;margin:auto">${players.join("")}</main>`,
  );
  [browser, server] = await Promise.all([launchBrowser(), serveFolder(folder)]);
});
afterAll(async () => {
  await browser.close();
  await server.close();
  rmSync(folder, { recursive: true });
});

test("twelve players are scrolled past", async () => {
  const page = await browser.newPage({ viewport: { width: 800, height: 900 } });
  await page.addInitScript(() => {
    Object.assign(window, { contexts: 0, tasks: [], frames: [] });
    const { getContext } = HTMLCanvasElement.prototype;
    const seen = new WeakSet<object>();
    HTMLCanvasElement.prototype.getContext = function (this: HTMLCanvasElement, ...given: unknown[]) {
      const made = Reflect.apply(getContext, this, given);
      // The first context tests the renderer, and is released immediately.
      if (made && given[0] === "webgl2" && this.width * this.height > 1 && !seen.has(made)) {
        seen.add(made);
        window.contexts += 1;
      }
      return made;
    } as typeof getContext;
  });
  await page.goto(server.url);
  await page.evaluate(() =>
    Promise.all([...document.querySelectorAll<StrutPlayer>("strut-player")].map((player) => player.ready)),
  );
  await page.waitForTimeout(2000);
  const scrolled = page.evaluate(async (secs) => {
    new PerformanceObserver((list) => {
      for (const { duration } of list.getEntries()) window.tasks.push(duration);
    }).observe({ type: "longtask" });
    const height = document.documentElement.scrollHeight - innerHeight;
    const start = performance.now();
    let last = start;
    while (last - start < 1000 * secs) {
      const now = await new Promise<number>(requestAnimationFrame);
      window.frames.push(performance.now() - last);
      last = performance.now();
      scrollTo(0, height * Math.min(1, (now - start) / (1000 * secs)));
    }
    return { frames: window.frames, tasks: window.tasks, contexts: window.contexts };
  }, SECS);
  for (let i = 0; i < PICTURES; i++) {
    await page.waitForTimeout((1000 * SECS) / PICTURES - 400);
    await screenshot(page, `scroll-${i}`);
  }
  const { frames, tasks, contexts } = await scrolled;
  const sorted = frames.toSorted((a, b) => a - b);
  const at = (share: number) => sorted[Math.floor(share * (sorted.length - 1))]!.toFixed(0);
  const longest = Math.max(0, ...tasks).toFixed(0);
  console.log(
    `frames: median ${at(0.5)} ms, 95th ${at(0.95)} ms; tasks over 50 ms: ${tasks.length}, longest ${longest} ms`,
  );
  expect(contexts).toBe(1);
  expect(page.workers()).toHaveLength(1);
  await page.close();
});
