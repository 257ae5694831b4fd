/** The page on wide and narrow screens, in both themes, from any folder, and accessible. */
import type { Browser, Page } from "playwright-core";
import { beforeAll, describe, expect, it } from "vitest";
import type { StrutHook } from "../../web/app/shell/hook";
import { axeFaults } from "./axe";
import { eventually, openSite, screenshot, type serveSite, visit } from "./browser";
import { showTheme, transitionsEnded } from "./rest";

declare const window: { strut: StrutHook };

let browser: Browser;
let site: Awaited<ReturnType<typeof serveSite>>;
let page: Page;

beforeAll(async () => {
  // Not the root of the host: the site must work from any folder.
  const opened = await openSite({ folder: "/some/folder/" });
  browser = opened.browser;
  site = opened.site;
  page = opened.page;
  return opened.close;
});

const WIDE = { width: 1440, height: 900 };
const NARROW = { width: 390, height: 844 };

/** Shows the page with a size and the system's theme, in its initial state. */
async function showAt(viewport: { width: number; height: number }, theme: "dark" | "light"): Promise<void> {
  await page.setViewportSize(viewport);
  await visit(page, "");
  await showTheme(page, theme);
  await page.waitForFunction(() => window.strut.analysed);
  // Colours change gradually between the themes.
  await transitionsEnded(page);
}

/** Returns how far the page is larger than the window. */
const overflow = () =>
  page.evaluate(() => {
    const { scrollWidth, scrollHeight, clientWidth, clientHeight } = document.documentElement;
    return { x: scrollWidth - clientWidth, y: scrollHeight - clientHeight };
  });

const faults = () => axeFaults(page);

describe("hidden panels", () => {
  for (const size of [WIDE, NARROW])
    it(`leave the whole page below the bar to the picture (${size.width} px)`, async () => {
      await page.setViewportSize(size);
      await visit(page, "panels=0");
      const box = (selector: string): Promise<DOMRect> =>
        page.evaluate((selector) => document.querySelector(selector)!.getBoundingClientRect().toJSON(), selector);
      await eventually(() => box(".bar")).toMatchObject({ left: 0, width: size.width });
      const { bottom: top } = await box(".bar");
      await eventually(() => box(".stage")).toMatchObject({ left: 0, top, width: size.width, bottom: size.height });
    });
});

describe("a wide screen", () => {
  for (const theme of ["dark", "light"] as const)
    it(`holds everything without scrolling (${theme})`, async () => {
      await showAt(WIDE, theme);
      expect(page.url()).toContain("/some/folder/");
      await eventually(overflow).toEqual({ x: 0, y: 0 });
      const panels = () => page.locator(".panels").evaluate((e) => e.scrollHeight - e.clientHeight);
      await eventually(panels).toBeLessThanOrEqual(0);
      for (const heading of ["Style", "Input", "Model"])
        await eventually(() => page.getByRole("heading", { name: heading, exact: true }).isVisible()).toBe(true);
      await eventually(faults).toEqual([]);
      await screenshot(page, `wide-${theme}`);
    });

  it("keeps the read-out clear of the buttons in a small window", async () => {
    await showAt({ width: 960, height: 640 }, "dark");
    const box = async (selector: string) => (await page.locator(selector).boundingBox()) ?? expect.fail(selector);
    const [readOut, controls] = [await box(".read-out"), await box(".stage-controls")];
    expect(readOut.y + readOut.height < controls.y || readOut.x > controls.x + controls.width).toBe(true);
    await screenshot(page, "small-window");
  });

  it("follows the system's theme until one is chosen", async () => {
    await showAt(WIDE, "dark");
    const background = () => page.locator("#app").evaluate((e) => getComputedStyle(e).backgroundColor);
    // The colour `panel` of both themes (web/ui/tokens.css), after the transition of 200 ms.
    const [dark, light] = ["rgb(24, 25, 28)", "rgb(245, 245, 244)"];
    await eventually(background).toBe(dark);
    await page.emulateMedia({ colorScheme: "light" });
    await eventually(background).toBe(light);
    await page.getByRole("button", { name: "Dark theme" }).click();
    await eventually(background).toBe(dark);
    await eventually(() => page.evaluate(() => window.strut.state.theme)).toBe("dark");
  });

  it("opens the export menu", async () => {
    await showAt(WIDE, "dark");
    await page.getByRole("button", { name: "Export" }).click();
    await eventually(() => page.locator(".export-menu").isVisible()).toBe(true);
    await eventually(faults).toEqual([]);
    await screenshot(page, "export-menu");
    await page.keyboard.press("Escape");
    await eventually(() => page.locator(".export-menu").isVisible()).toBe(false);
  });

  it("opens and closes the help", async () => {
    await showAt(WIDE, "dark");
    await page.keyboard.press("?");
    await eventually(() => page.getByRole("dialog").isVisible()).toBe(true);
    await eventually(faults).toEqual([]);
    await page.keyboard.press("Escape");
    await eventually(() => page.getByRole("dialog").isVisible()).toBe(false);
  });
});

describe("a window of 900 px", () => {
  /** Controls that are partly outside of the window, or of the footer that they are in. */
  const outside = () =>
    page.evaluate(() =>
      [...document.querySelectorAll<HTMLElement>(".bar button, .view button, .play-view button, .view select")]
        .filter((e) => e.checkVisibility({ visibilityProperty: true }))
        .filter((e) => {
          const { right, width } = e.getBoundingClientRect();
          const foot = e.closest(".editor-foot")?.getBoundingClientRect().right ?? innerWidth;
          return width > 0 && right > Math.min(foot, innerWidth) + 1;
        })
        .map((e) => e.getAttribute("aria-label") ?? e.textContent),
    );

  it.for(["play", "walk", "key-style", "crowd", "data"])("has every control of %s", async (view) => {
    await page.setViewportSize({ width: 900, height: 700 });
    await visit(page, `play=0&view=${view}`);
    await page.waitForFunction((view) => document.getElementById("app")?.dataset.view === view, view);
    await eventually(outside).toEqual([]);
    await eventually(async () => (await overflow()).x).toBe(0);
  });
});

describe("panels that scroll", () => {
  it("say that there is more below, until their end is reached", async () => {
    await page.setViewportSize({ width: 1366, height: 768 });
    await visit(page, "play=0&frame=60");
    const panels = page.locator(".panels");
    const more = () => panels.locator(".scroll-cue > div").isVisible();
    await eventually(more).toBe(true);
    await panels.evaluate((e) => e.scrollTo(0, e.scrollHeight));
    await eventually(more).toBe(false);
    await page.setViewportSize(WIDE);
    await panels.evaluate((e) => e.scrollTo(0, 0));
    await eventually(more).toBe(false);
  });
});

describe("a narrow screen", () => {
  for (const theme of ["dark", "light"] as const)
    it(`stacks with tabs and never scrolls sideways (${theme})`, async () => {
      await showAt(NARROW, theme);
      await screenshot(page, `narrow-${theme}-style`);
      for (const tab of ["Input", "Model", "Curves", "Style"]) {
        await page.getByRole("button", { name: tab, exact: true }).click();
        await eventually(() => page.locator(".play-view").getAttribute("data-tab")).toBe(tab.toLowerCase());
        await eventually(overflow).toEqual({ x: 0, y: 0 });
        await eventually(faults, tab).toEqual([]);
        if (tab !== "Style") await screenshot(page, `narrow-${theme}-${tab.toLowerCase()}`);
      }
    });

  it("has targets large enough for a finger", async () => {
    await showAt(NARROW, "dark");
    const small = await page.locator("button:visible, select:visible").evaluateAll((elements) =>
      elements
        .map((e) => ({ name: e.getAttribute("aria-label") ?? e.textContent, box: e.getBoundingClientRect() }))
        .filter(({ box }) => Math.min(box.width, box.height) < 40)
        .map(({ name, box }) => `${name} ${Math.round(box.width)}×${Math.round(box.height)}`),
    );
    expect(small).toEqual([]);
  });
});

describe("a browser that cannot", () => {
  it("gets a sentence without WebGL 2", async () => {
    const context = await browser.newContext();
    const poor = await context.newPage();
    await poor.addInitScript(() => {
      HTMLCanvasElement.prototype.getContext = () => null;
    });
    await poor.goto(site.url);
    const alert = () => poor.getByRole("alert").textContent();
    await eventually(alert).toMatch(/WebGL 2/);
    // It is not removed by what opens afterwards.
    await poor.waitForFunction(() => performance.getEntriesByName("strut: first styled frame").length > 0);
    expect(await alert()).toMatch(/WebGL 2/);
    await context.close();
  });

  it("gets a sentence without JavaScript", async () => {
    const context = await browser.newContext({ javaScriptEnabled: false });
    const poor = await context.newPage();
    await poor.goto(site.url);
    expect(await poor.locator("noscript .fallback").textContent()).toMatch(/needs JavaScript/);
    expect(await poor.getByText("Strut is loading").isVisible()).toBe(false);
    await context.close();
  });
});
