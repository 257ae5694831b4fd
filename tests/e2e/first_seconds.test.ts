/**
 * Playback before everything is loaded: an unstyled clip, then a few strides in every style with a reduced engine, then
 * all built-in motions with the whole engine.
 */
import type { Browser, Page, Route } from "playwright-core";
import { afterEach, beforeAll, beforeEach, describe, expect, it } from "vitest";
import { MARKS } from "../../web/player/playback";
import { walksIn } from "../clips";
import { dropFile, eventually, inputName, launchSite } from "./browser";

let browser: Browser;
let site: Awaited<ReturnType<typeof launchSite>>["site"];
beforeAll(async () => {
  const launched = await launchSite();
  ({ browser, site } = launched);
  return launched.close;
});

let page: Page;
beforeEach(async () => {
  const context = await browser.newContext({
    viewport: { width: 900, height: 700 },
    deviceScaleFactor: 0.5,
    serviceWorkers: "block",
  });
  page = await context.newPage();
});
afterEach(() => page.context().close());

/** Withholds requests until the result is called. */
async function held(url: string): Promise<() => Promise<void>> {
  const routes: Route[] = [];
  let holds = true;
  await page.context().route(url, (route) => (holds ? void routes.push(route) : route.continue()));
  return async () => {
    holds = false;
    await Promise.all(routes.map((route) => route.continue()));
  };
}

const isMarked = (mark: string) => page.evaluate((name) => performance.getEntriesByName(name).length > 0, mark);
const marked = (mark: string) =>
  page.waitForFunction((name) => performance.getEntriesByName(name).length > 0, mark, { timeout: 60_000 });
const inputs = () => page.locator(".input optgroup option").allTextContents();

describe("the first seconds", () => {
  it("show a walk without the engine, styles with a few strides, and all motions in the end", async () => {
    const releaseEngine = await held("**/strut_start_bg-*.wasm");
    const releaseOthers = await held("**/built_in-*.bin");
    await page.goto(site.url);
    await marked(MARKS.shown);
    expect(await isMarked(MARKS.styled)).toBe(false);

    await releaseEngine();
    await marked(MARKS.styled);
    await page.waitForFunction(() => window.strut!.frame!.timeOut > 1);
    expect(await inputs()).toHaveLength(1);
    expect(await page.evaluate(() => window.strut!.upToDate)).toBe(false);

    const frames = page.evaluate(async () => {
      const seen: [at: number, timeOut: number, x: number, z: number, inputs: number][] = [];
      const count = () => document.querySelectorAll(".input optgroup option").length;
      for (let after = 0; after < 30; after += count() > 1 ? 1 : 0) {
        await new Promise(requestAnimationFrame);
        const { timeOut, pose } = window.strut!.frame!;
        if (seen.at(-1)?.[1] !== timeOut) seen.push([performance.now(), timeOut, pose[0]!, pose[2]!, count()]);
      }
      return seen;
    });
    await releaseOthers();
    const seen = await frames;
    expect(new Set(seen.map(([, , , , count]) => count)).size).toBe(2);
    for (let i = 1; i < seen.length; i++) {
      const [before, now] = [seen[i - 1]!, seen[i]!];
      const secs = now[1] - before[1];
      expect(secs).toBeGreaterThan(0);
      expect(secs).toBeLessThan(0.11);
      // The walker is never faster than 3 m/s, and never jumps.
      expect(Math.hypot(now[2] - before[2], now[3] - before[3])).toBeLessThan(3 * secs + 0.01);
    }
    await page.waitForFunction(() => window.strut!.upToDate || window.strut!.analysed);
  });

  it("stay as they are, with a sentence, where the others cannot be had", async () => {
    await page.route("**/built_in-*.bin", (route) => route.abort());
    await page.goto(site.url);
    await marked(MARKS.styled);
    await page.locator(".toast", { hasText: "built-in motions" }).waitFor();
    const { timeOut } = (await page.evaluate(() => window.strut!.frame))!;
    await page.waitForFunction((before) => window.strut!.frame!.timeOut > before, timeOut);
    expect(await inputs()).toHaveLength(1);
  });

  it("open a file that is dropped meanwhile when the whole engine is there", async () => {
    const { neutral } = await walksIn(["neutral"]);
    const release = await held("**/strut_wasm_bg-*.wasm");
    await page.goto(site.url);
    await marked(MARKS.styled);
    await dropFile(page, "mine.bvh", neutral);
    await page.locator(".progress", { hasText: "mine" }).first().waitFor();
    const { timeOut } = (await page.evaluate(() => window.strut!.frame))!;
    await page.waitForFunction((before) => window.strut!.frame!.timeOut !== before, timeOut);
    await release();
    await eventually(() => inputName(page)).toBe("mine");
    await page.waitForFunction(() => window.strut!.analysed);
  });

  it("go on without the whole engine, and open a file when it can be had again", async () => {
    const { neutral } = await walksIn(["neutral"]);
    await page.route("**/strut_wasm_bg-*.wasm", (route) => route.abort());
    await page.goto(site.url);
    await marked(MARKS.styled);
    const sentence = page.locator(".toast", { hasText: "engine could not be loaded" }).first();
    await sentence.waitFor();
    const { timeOut } = (await page.evaluate(() => window.strut!.frame))!;
    await page.waitForFunction((before) => window.strut!.frame!.timeOut > before, timeOut);
    await page.unroute("**/strut_wasm_bg-*.wasm");
    await dropFile(page, "mine.bvh", neutral);
    await eventually(() => inputName(page)).toBe("mine");
    await page.waitForFunction(() => window.strut!.analysed);
  });
});
