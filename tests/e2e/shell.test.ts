/** The page around the views: links, history, focus, keys, and browsers that lack or refuse features. */
import type { Browser, BrowserContext, Page } from "playwright-core";
import { beforeAll, describe, expect, it } from "vitest";
import type { StrutHook } from "../../web/app/shell/hook";
import { pack } from "../../web/link/linked_file";
import { everyNth, walksIn } from "../clips";
import {
  closePage,
  eventually,
  inputName,
  launchSite,
  openPage,
  settledPose,
  shown,
  turnBetween,
  visit,
} from "./browser";
import { expectNoViolation, recordViolations } from "./policy";

declare const window: { strut?: StrutHook; announced: string[] };

let browser: Browser;
let site: Awaited<ReturnType<typeof launchSite>>["site"];
beforeAll(async () => {
  const launched = await launchSite();
  ({ browser, site } = launched);
  return launched.close;
});

const toasts = (page: Page) => page.locator(".toasts").textContent();
const view = (page: Page) => page.evaluate(() => window.strut!.state.view);
const tab = (page: Page, name: string) => page.getByRole("navigation", { name: "Views" }).getByRole("link", { name });

/** Opens a page that is changed before its scripts run; it may fail to show a character. */
async function altered(change: () => void, options: Parameters<Browser["newContext"]>[0] = {}) {
  const context = await browser.newContext({ viewport: { width: 960, height: 640 }, ...options });
  await context.addInitScript(change);
  return { context, page: await context.newPage() };
}

async function during(context: BrowserContext, work: () => Promise<void>): Promise<void> {
  try {
    await work();
  } finally {
    await context.close();
  }
}

describe("the content security policy", () => {
  it("is kept by every view", async () => {
    const context = await browser.newContext({ viewport: { width: 960, height: 640 } });
    await recordViolations(context);
    await during(context, async () => {
      const page = await context.newPage();
      await page.goto(site.url);
      await shown(page);
      for (const name of ["Compare", "Walk", "Key-style", "Crowd", "Data", "Learn", "Play"]) {
        await tab(page, name).click();
        await eventually(() => page.title()).toContain(name);
      }
      await page.getByRole("button", { name: "Help" }).click();
      await expectNoViolation(page);
    });
  });
});

describe("a link", () => {
  it("that carries its motion opens in a page that is open", async () => {
    const { old } = await walksIn(["old"], 200);
    const clip = everyNth(old, 20);
    const packed = await pack(new TextEncoder().encode(clip).buffer);
    const page = await openPage(browser, site.url, { hash: "play=0" });
    await visit(page, `play=0&frame=4&styles=old:1,proud:0,childlike:0&input=carried&file=carried~${packed}`);
    await eventually(() => inputName(page)).toBe("carried");
    await eventually(() => page.evaluate(() => window.strut!.frame!.inputFrame)).toBe(4);
    await eventually(() => page.evaluate(() => window.strut!.state.input)).toBe("carried");
    expect(await page.getByRole("alert").textContent()).toBe("");
    await closePage(page);
  });

  it("with a curve or a style called like a member of every object changes nothing else", async () => {
    const page = await openPage(browser, site.url, { hash: "play=0&curve=toString&styles=constructor:1" });
    await eventually(() => page.getByRole("button", { name: "Export" }).isEnabled()).toBe(true);
    await eventually(() => page.getByLabel("Joint of the curve").inputValue()).toBe("knee L");
    await page.waitForFunction(() => window.strut!.analysed);
    await closePage(page);
  });

  it("to a kept database that cannot be opened opens the built-in one, and says so", async () => {
    const page = await openPage(browser, site.url, { hash: "play=0" });
    await page.evaluate(
      () =>
        new Promise<void>((resolve, reject) => {
          const opening = indexedDB.open("strut", 1);
          opening.onupgradeneeded = () => opening.result.createObjectStore("databases", { keyPath: "name" });
          opening.onerror = () => reject(opening.error);
          opening.onsuccess = () => {
            const transaction = opening.result.transaction("databases", "readwrite");
            const file = new Blob(["not a database"]);
            transaction
              .objectStore("databases")
              .put({ name: "damaged", file, clips: 1, frames: 1, actions: [], styles: [] });
            transaction.oncomplete = () => {
              opening.result.close();
              resolve();
            };
          };
        }),
    );
    await page.goto("about:blank");
    await page.goto(`${site.url}#play=0&db=damaged`);
    await eventually(() => toasts(page)).toContain("“damaged” could not be opened");
    await eventually(() => page.evaluate(() => window.strut!.state.database)).toBe("");
    await closePage(page);
  });
});

describe("a change of view", () => {
  it("is an entry of the browser's history, and moves title, focus and announcement", async () => {
    const page = await openPage(browser, site.url, { hash: "play=0&frame=60&k=50" });
    // An announcement may be replaced by the next one before the test can read it.
    await page.locator(".visually-hidden[role=status]").evaluate((region) => {
      window.announced = [];
      new MutationObserver(() => window.announced.push(region.textContent)).observe(region, { childList: true });
    });
    await tab(page, "Walk").click();
    await eventually(() => page.title()).toBe("Walk · Strut");
    await eventually(() => page.evaluate(() => document.activeElement?.tagName)).toBe("H1");
    await eventually(() => page.evaluate(() => window.announced)).toContain("Walk view");
    await page.goBack();
    await eventually(() => view(page)).toBe("play");
    await eventually(() => page.title()).toBe("Play · Strut");
    await eventually(() => page.url()).toContain("k=50");
    await page.goForward();
    await eventually(() => view(page)).toBe("walk");
    await page.goBack();
    await eventually(() => view(page)).toBe("play");
    const pose = await settledPose(page);
    expect(pose.every(Number.isFinite)).toBe(true);
    // A link in the address bar still sets everything.
    await visit(page, "play=0&frame=60&k=9");
    await eventually(() => page.evaluate(() => window.strut!.state.k)).toBe(9);
    await closePage(page);
  });
});

describe("keys of a single character", () => {
  it("are switched off in Help, for good", async () => {
    const page = await openPage(browser, site.url, { hash: "play=0" });
    const loop = () => page.evaluate(() => window.strut!.state.loop);
    await page.keyboard.press("l");
    await eventually(loop).toBe(false);
    await page.keyboard.press("?");
    await page.getByRole("switch", { name: /as shortcuts/ }).click();
    await page.keyboard.press("Escape");
    await eventually(() => page.getByRole("dialog").isVisible()).toBe(false);
    await page.keyboard.press("l");
    expect(await loop()).toBe(false);
    // The address bar follows the state after a moment.
    await eventually(() => page.url()).toContain("loop=0");
    await page.reload();
    await shown(page);
    await page.keyboard.press("l");
    await page.keyboard.press("Space");
    await eventually(() => page.evaluate(() => window.strut!.state.playing)).toBe(true);
    expect(await loop()).toBe(false);
    await closePage(page);
  });
});

describe("less motion", () => {
  it("does not begin to play by itself, and plays when asked", async () => {
    const { context, page } = await altered(() => {}, { reducedMotion: "reduce" });
    await during(context, async () => {
      await page.goto(site.url);
      await shown(page);
      const pose = await settledPose(page);
      await new Promise((resolve) => setTimeout(resolve, 300));
      expect(turnBetween(pose, await settledPose(page))).toBeLessThan(0.01);
      await page.keyboard.press("Space");
      await eventually(() => page.evaluate(() => window.strut!.frame!.inputFrame)).toBeGreaterThan(10);
    });
  });
});

describe("a browser", () => {
  it("that is too old gets a sentence", async () => {
    const { context, page } = await altered(() => Reflect.deleteProperty(Array.prototype, "toSorted"));
    await during(context, async () => {
      await page.goto(site.url);
      await eventually(() => page.getByRole("alert").textContent()).toContain("too old for Strut");
    });
  });

  it("that cannot read the script gets a sentence after a while", async () => {
    const { context, page } = await altered(() => {});
    await during(context, async () => {
      await page.route("**/*.js", (route) => route.fulfill({ body: "syntax error(", contentType: "text/javascript" }));
      await page.goto(site.url);
      await eventually(() => page.getByText("Strut is loading").isVisible()).toBe(true);
    });
  });

  it("in which the page cannot be built gets a sentence", async () => {
    const { context, page } = await altered(() => {
      globalThis.ResizeObserver = class {
        constructor() {
          throw new Error("no observers");
        }
      } as unknown as typeof ResizeObserver;
    });
    await during(context, async () => {
      await page.goto(site.url);
      await eventually(() => page.getByRole("alert").textContent()).toContain("Strut could not start");
    });
  });

  it("that does not let the page copy shows the link, selected", async () => {
    const { context, page } = await altered(() => {
      navigator.clipboard.write = () => Promise.reject(new DOMException("no", "NotAllowedError"));
    });
    await during(context, async () => {
      await page.goto(`${site.url}#play=0&k=50`);
      await shown(page);
      await page.getByRole("button", { name: "Share" }).click();
      const field = page.getByRole("textbox", { name: "Link" });
      await field.waitFor();
      await eventually(() => field.inputValue()).toContain("k=50");
      await eventually(() => page.evaluate(() => getSelection()!.toString())).toContain("k=50");
    });
  });
});
