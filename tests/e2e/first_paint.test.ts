/** The static content of index.html before its script runs, which must look like the page with the script. */
import type { Browser, Page, Route } from "playwright-core";
import { beforeAll, describe, expect, it } from "vitest";
import type { StrutHook } from "../../web/app/shell/hook";
import { launchSite, shown } from "./browser";

declare const window: { strut?: StrutHook; shift: number };

let browser: Browser;
let site: Awaited<ReturnType<typeof launchSite>>["site"];
beforeAll(async () => {
  const launched = await launchSite();
  ({ browser, site } = launched);
  return launched.close;
});

/** Opens a page whose scripts are withheld until `release` is called; `window.shift` is the layout shift so far. */
async function withoutScripts(hash: string, size = { width: 1440, height: 900 }) {
  const context = await browser.newContext({ viewport: size, deviceScaleFactor: 0.5, colorScheme: "dark" });
  const page = await context.newPage();
  await page.addInitScript(() => {
    window.shift = 0;
    new PerformanceObserver((list) => {
      for (const entry of list.getEntries()) window.shift += (entry as unknown as { value: number }).value;
    }).observe({ type: "layout-shift", buffered: true });
  });
  let held: Route[] | undefined = [];
  await page.route("**/*.js", (route) => (held ? void held.push(route) : route.continue()));
  await page.goto(`${site.url}#${hash}`, { waitUntil: "commit" });
  // Painting waits for the style sheets, but not for the font.
  await page.waitForFunction(() => performance.getEntriesByName("first-contentful-paint").length > 0);
  await page.evaluate(() => document.fonts.ready.then(() => {}));
  const release = async () => {
    const routes = held ?? [];
    held = undefined;
    await Promise.all(routes.map((route) => route.continue()));
  };
  return { page, release, close: () => context.close() };
}

/** Returns the boxes of parts of the page; of the title, whose text changes with the character, only its start. */
const boxes = (page: Page, selectors: readonly string[]) =>
  page.evaluate(
    (selectors) =>
      selectors.map((selector) => {
        const { x, y, width, height } = document.querySelector(selector)!.getBoundingClientRect();
        return { selector, x, y, width: selector === ".stage-title" ? 1 : width, height };
      }),
    selectors,
  );

describe("before the script", () => {
  for (const { size, parts } of [
    {
      size: { width: 1440, height: 900 },
      parts: [".bar", ".wordmark", ".stage", ".stage-title", ".panels", ".transport", ".transport-controls"],
    },
    {
      size: { width: 390, height: 844 },
      parts: [".bar", ".wordmark", ".stage", ".transport-controls", ".tabs", ".panels"],
    },
  ])
    it(`every part of Play has the place that it has later (${size.width} px)`, async () => {
      const { page, release, close } = await withoutScripts("play=0", size);
      const before = await boxes(page, parts);
      expect(before.every(({ width, height }) => width > 0 && height > 0)).toBe(true);
      await release();
      await page.locator(".bar nav").waitFor({ state: "attached" });
      expect(await boxes(page, parts)).toEqual(before);
      await shown(page);
      await page.waitForFunction(() => window.strut!.analysed);
      expect(await page.evaluate(() => window.shift)).toBeLessThan(0.05);
      await close();
    });

  it("a picture of more or fewer pixels is no shift of the page", async () => {
    const { page, release, close } = await withoutScripts("play=0", { width: 390, height: 844 });
    await release();
    await shown(page);
    await page.waitForFunction(() => window.strut!.analysed);
    const canvas = page.locator(".stage-view canvas").first();
    const before = await page.evaluate(() => window.shift);
    await page.keyboard.press("Space");
    await canvas.and(page.locator(":not([data-still])")).waitFor();
    await page.keyboard.press("Space");
    await canvas.and(page.locator("[data-still]")).waitFor();
    expect(await page.evaluate(() => window.shift)).toBeCloseTo(before, 3);
    await close();
  });

  it("a link to another view has the bar alone, as the view has other parts", async () => {
    const { page, close } = await withoutScripts("view=learn");
    expect(await page.locator(".wordmark").isVisible()).toBe(true);
    expect(await page.locator(".stage").isVisible()).toBe(false);
    await close();
  });

  it("the page has the theme of the link", async () => {
    const { page, close } = await withoutScripts("theme=light");
    const scheme = await page.evaluate(() => getComputedStyle(document.documentElement).colorScheme);
    expect(scheme).toBe("light");
    await close();
  });
});
