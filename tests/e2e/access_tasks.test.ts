/**
 * The tasks of the views as somebody does them by touch at 400 % zoom, and with text of twice the size in the system's own
 * colours; and what a screen reader reads of each view, kept in `transcripts/`.
 */
import type { Browser, Locator, Page } from "playwright-core";
import { beforeAll, describe, expect, it } from "vitest";
import type { StrutHook } from "../../web/app/shell/hook";
import { VIEW_NAMES, type ViewName } from "../../web/link/page";
import { walksIn } from "../clips";
import { axeFaults } from "./axe";
import { eventually, launchSite, openPage, screenshot, shown, visit } from "./browser";
import { transitionsEnded } from "./rest";
import { transcriptOf } from "./transcript";

declare const window: { strut: StrutHook };

let browser: Browser;
let url: string;
let walks: Record<"neutral" | "old", string>;

beforeAll(async () => {
  const [launched, made] = await Promise.all([launchSite(), walksIn(["neutral", "old"])]);
  [browser, url, walks] = [launched.browser, launched.site.url, made];
  return launched.close;
});

/** A way of using the page. */
interface Way {
  name: string;
  open(): Promise<Page>;
  /** Chooses something once. */
  press(thing: Locator): Promise<void>;
}

const WAYS: readonly Way[] = [
  {
    name: "by touch, at 400 % zoom, with less motion",
    // A window of 1280 × 1024 pixels that is enlarged four times.
    open: async () => {
      const context = await browser.newContext({
        viewport: { width: 320, height: 256 },
        deviceScaleFactor: 1,
        hasTouch: true,
        isMobile: true,
        reducedMotion: "reduce",
        colorScheme: "dark",
      });
      return context.newPage();
    },
    press: (thing) => thing.tap(),
  },
  {
    name: "with text of twice the size, in forced colours",
    open: async () => {
      const context = await browser.newContext({
        viewport: { width: 1280, height: 800 },
        deviceScaleFactor: 0.5,
        forcedColors: "active",
        colorScheme: "dark",
      });
      const page = await context.newPage();
      const session = await context.newCDPSession(page);
      await session.send("Page.enable");
      await session.send("Page.setFontSizes", { fontSizes: { standard: 32, fixed: 26 } });
      return page;
    },
    press: (thing) => thing.click(),
  },
];

describe.for(WAYS)("$name", ({ name, open, press }) => {
  let page: Page;
  beforeAll(async () => {
    page = await open();
    await page.goto(`${url}#play=0&frame=60`);
    await shown(page);
    return () => page.context().close();
  });

  const state = () => page.evaluate(() => window.strut.state);
  const alert = () => page.getByRole("alert").textContent();
  const sideways = () => page.evaluate(() => document.documentElement.scrollWidth - innerWidth);

  /** Goes to a view by the bar, or by its menu where the bar has no room. */
  async function goTo(view: string, named: ViewName): Promise<void> {
    const link = page.locator(".bar").getByRole("link", { name: view, exact: true });
    if (!(await link.isVisible())) await press(page.getByRole("button", { name: "Menu" }));
    await press(link);
    await eventually(async () => (await state()).view).toBe(named);
    await eventually(() => page.evaluate(() => document.getElementById("app")!.dataset.view)).toBe(named);
  }

  /** What holds in every view: nothing is wider than the screen, nothing is inaccessible, nothing has failed. */
  async function expectAccessible(view: string): Promise<void> {
    await transitionsEnded(page);
    await eventually(sideways, view).toBeLessThanOrEqual(0);
    await eventually(() => axeFaults(page), view).toEqual([]);
    expect(await alert()).toBe("");
    await screenshot(page, `access-${name.replace(/\W+/g, "-")}-${view}`);
  }

  it("Play: a style is chosen, and the motion is analysed", async () => {
    const corner = page.locator('.vertex[data-style="old"] .vertex-dot');
    await corner.scrollIntoViewIfNeeded();
    await press(corner);
    await press(corner);
    await eventually(async () => (await state()).styles.find((s) => s.name === "old")?.weight).toBe(1);
    await page.waitForFunction(() => window.strut.analysed);
    await expectAccessible("play");
  });

  it("Walk: a block is added", async () => {
    await goTo("Walk", "walk");
    await page
      .locator(".walk-figures")
      .getByText(/^0\.\d\d m$/)
      .first()
      .waitFor();
    const { walk } = await state();
    await press(page.locator(".walk .editor-foot").getByRole("button", { name: /^Add/ }));
    await eventually(async () => (await state()).walk.length).toBe(walk.length + 1);
    await expectAccessible("walk");
  });

  it("Key-style: a pose is chosen on the pad", async () => {
    await goTo("Key-style", "key-style");
    await page.locator('.key-style[aria-busy="false"]').waitFor();
    const spoken = () => page.getByRole("slider", { name: "Style", exact: true }).getAttribute("aria-valuetext");
    const before = await spoken();
    await press(page.locator(".pad-frame"));
    await eventually(spoken).not.toBe(before);
    await expectAccessible("key-style");
  });

  it("Learn: a bet is placed", async () => {
    await goTo("Learn", "learn");
    await press(page.getByRole("button", { name: "2: Your bet" }));
    await press(page.getByLabel("The same second"));
    await press(page.getByRole("button", { name: "Place the bet" }));
    await eventually(() => page.locator(".reveal").textContent()).toMatch(/You bet right/);
    await expectAccessible("learn");
  });

  it("Data: a database is built and opened", async () => {
    await goTo("Data", "data");
    const [chooser] = await Promise.all([
      page.waitForEvent("filechooser"),
      press(page.getByRole("button", { name: "Choose files" })),
    ]);
    await chooser.setFiles(
      Object.entries(walks).map(([style, text]) => ({
        name: `walk_${style}_1.bvh`,
        mimeType: "text/plain",
        buffer: Buffer.from(text),
      })),
    );
    await page.locator('.data[aria-busy="false"]').waitFor();
    await expectAccessible("data");
    const build = page.getByRole("button", { name: "Build the database" });
    await eventually(() => build.isEnabled()).toBe(true);
    await press(build);
    await press(page.getByRole("button", { name: "Open My clips", exact: true }));
    await eventually(async () => (await state()).database).toBe("My clips");
  });
});

describe("a screen reader", () => {
  /** State of each view that is the same on every machine, and what is there once all of it is. */
  const STATES: Record<ViewName, { hash: string; there: string }> = {
    play: { hash: "play=0&frame=60&styles=proud:0.6,old:0.1,childlike:0.3", there: ".stage-title" },
    learn: { hash: "view=learn&beat=0&play=0", there: ".learn h1" },
    compare: { hash: "view=compare&play=0&frame=60", there: '.compare-table[data-column="mar"] td' },
    walk: { hash: "view=walk&play=0", there: ".planner-block" },
    "key-style": { hash: "view=key-style&play=0", there: '.key-style[aria-busy="false"] .pad-key' },
    crowd: { hash: "view=crowd&crowd=10_1&play=0", there: ".crowd-foot .button:enabled" },
    data: { hash: "view=data&play=0", there: ".catalogue li" },
  };
  let page: Page;
  beforeAll(async () => {
    page = await openPage(browser, url, { hash: STATES.play.hash, size: { width: 1440, height: 900 } });
    await page.waitForFunction(() => window.strut.analysed);
  });

  it.for(VIEW_NAMES)("reads %s from top to bottom", async (view) => {
    const { hash, there } = STATES[view];
    await visit(page, hash);
    await eventually(() => page.evaluate(() => document.getElementById("app")!.dataset.view)).toBe(view);
    await page.locator(there).first().waitFor();
    // What is said of progress is gone when all is there.
    let before = "";
    await eventually(async () => {
      const last = before;
      before = await transcriptOf(page);
      return before === last;
    }).toBe(true);
    await expect(before).toMatchFileSnapshot(`transcripts/${view}.txt`);
  });
});
