/** Events in the life of a page: it is suspended, clocks jump, the screen changes, the WebGL context is lost. */
import type { CDPSession, Page } from "playwright-core";
import { afterEach, beforeAll, describe, expect, it } from "vitest";
import type { StrutHook } from "../../../web/app/shell/hook";
import { drawn, eventually, openSite, saved, settledPose, shown, styledPose, turnBetween, visit } from "../browser";
import { lastContext } from "../graphics";
import { consoleErrors, dismissAll, hurryTimers } from "./inject";

declare const window: { strut: StrutHook; shiftClock: (ms: number) => void };

const WIDE = { width: 960, height: 640 };
const STILL = "play=0&frame=60&styles=proud:1,old:0,depressed:0";
const HOUR_MS = 3_600_000;

let page: Page;
let session: CDPSession;
let errors: string[];

beforeAll(async () => {
  const opened = await openSite({ size: WIDE, hash: STILL });
  page = opened.page;
  errors = consoleErrors(page);
  session = await page.context().newCDPSession(page);
  // A clock that a test can change, as when the machine was asleep or its clock is set.
  await page.addInitScript(() => {
    let shift = 0;
    const { now } = Date;
    Date.now = () => now() + shift;
    const sinceStart = performance.now.bind(performance);
    performance.now = () => sinceStart() + Math.max(0, shift);
    const request = requestAnimationFrame;
    Object.assign(globalThis, {
      requestAnimationFrame: (draw: FrameRequestCallback) => request((at) => draw(at + Math.max(0, shift))),
      shiftClock: (ms: number) => {
        shift += ms;
      },
    });
  });
  await page.reload();
  await shown(page);
  return opened.close;
});
afterEach(() => expect(errors.splice(0)).toEqual([]));

const alert = () => page.getByRole("alert").textContent();
const inputFrame = () => page.evaluate(() => window.strut.frame!.inputFrame);

/** Stops the page as browsers do in the background, for a while by its clocks, and shows it again. */
async function sleep(ms: number): Promise<void> {
  await session.send("Page.setWebLifecycleState", { state: "frozen" });
  await page.evaluate((ms) => window.shiftClock(ms), ms);
  await session.send("Page.setWebLifecycleState", { state: "active" });
}

/** Returns the largest advance of the input between two successive frames. */
function largestAdvance(): Promise<number> {
  return page.evaluate(async () => {
    const advances: number[] = [];
    let before = window.strut.frame!.inputFrame;
    for (let pictures = 0; advances.length < 5 && pictures < 500; pictures++) {
      await new Promise(requestAnimationFrame);
      const { inputFrame } = window.strut.frame!;
      if (inputFrame > before) advances.push(inputFrame - before);
      before = inputFrame;
    }
    return Math.max(...advances);
  });
}

describe("an hour out of sight", () => {
  it("the walk goes on where it was, with its style, and no worker is taken for dead", async () => {
    await visit(page, "play=1&styles=proud:1,old:0,depressed:0");
    await eventually(inputFrame).toBeGreaterThan(5);
    await sleep(HOUR_MS);
    // At most a tenth of a second, which the style may stretch.
    expect(await largestAdvance()).toBeLessThan(12);
    expect(await alert()).toBe("");
    expect(await page.locator(".toasts [role=status]").textContent()).toBe("");
  });

  it("a planned walk does not run ahead either", async () => {
    await visit(page, "view=walk&play=1");
    const head = page.locator(".walk .editor-head");
    const secs = async () => Number(await head.getAttribute("aria-valuenow"));
    await head.waitFor();
    await page.getByRole("button", { name: "Pause" }).waitFor();
    await eventually(secs).toBeGreaterThan(0.2);
    const before = await secs();
    await sleep(HOUR_MS);
    await drawn(page, 3);
    expect(Math.abs((await secs()) - before)).toBeLessThan(3);
    expect(await alert()).toBe("");
  });
});

describe("a clock that is set back ten years", () => {
  it("plays on, goes back and forth in the history, and keeps the model that it has", async () => {
    await visit(page, STILL);
    const before = await settledPose(page);
    await page.evaluate((ms) => window.shiftClock(ms), -90_000 * 3_600_000);
    await page.keyboard.press("Space");
    await eventually(async () => turnBetween(before, await styledPose(page))).toBeGreaterThan(1);
    await page.keyboard.press("Space");
    await page.getByRole("link", { name: "Walk", exact: true }).click();
    await page
      .locator(".walk-figures")
      .getByText(/^0\.\d\d m$/)
      .first()
      .waitFor();
    await page.goBack();
    await eventually(() => page.evaluate(() => window.strut.state.view)).toBe("play");
    expect(await page.evaluate(() => window.strut.state.styles[0])).toEqual({ name: "proud", weight: 1 });
    expect(await alert()).toBe("");
  });
});

describe("a page that another one took the place of", () => {
  it("is shown again from the browser's cache, or loaded, as it was left", async () => {
    await visit(page, STILL);
    const before = await settledPose(page);
    await eventually(() => page.url()).toContain("frame=60");
    await page.goto("about:blank");
    await page.goBack();
    await shown(page);
    expect(turnBetween(before, await settledPose(page))).toBeLessThan(0.2);
    expect(await alert()).toBe("");
  });

  it("hears that it was kept, and is not taken apart", async () => {
    await visit(page, STILL);
    const before = await settledPose(page);
    await page.evaluate(() => {
      dispatchEvent(new PageTransitionEvent("pagehide", { persisted: true }));
      dispatchEvent(new PageTransitionEvent("pageshow", { persisted: true }));
    });
    await sleep(HOUR_MS);
    await page.keyboard.press("Space");
    await eventually(async () => turnBetween(before, await styledPose(page))).toBeGreaterThan(1);
    await page.keyboard.press("Space");
  });
});

/** Returns the stage's canvas pixels per CSS pixel. */
const density = () =>
  page.locator(".stage canvas").evaluate((element) => {
    const canvas = element as HTMLCanvasElement;
    return canvas.width / canvas.clientWidth;
  });

/**
 * Returns the number of different values in a small copy of the picture, read in a frame in which it is drawn; a single
 * colour has four.
 */
const picture = () =>
  page.locator(".stage canvas").evaluate(async (element) => {
    const copy = document.createElement("canvas");
    [copy.width, copy.height] = [64, 64];
    const context = copy.getContext("2d")!;
    let values = 0;
    // A paused picture is redrawn when the pointer moves over it; a canvas can only be read during a frame.
    for (let pictures = 0; pictures < 30 && values <= 4; pictures++) {
      element.dispatchEvent(new PointerEvent("pointermove", { bubbles: true }));
      await new Promise(requestAnimationFrame);
      context.drawImage(element as HTMLCanvasElement, 0, 0, 64, 64);
      values = new Set(context.getImageData(0, 0, 64, 64).data).size;
    }
    return values;
  });

describe("another screen", () => {
  it("of more pixels: the picture becomes finer, and nothing else changes", async () => {
    await visit(page, STILL);
    const before = await settledPose(page);
    const coarse = await density();
    await session.send("Emulation.setDeviceMetricsOverride", { ...WIDE, deviceScaleFactor: 2, mobile: false });
    await eventually(() => page.evaluate(() => devicePixelRatio)).toBe(2);
    await eventually(density).toBeGreaterThan(coarse * 1.2);
    await eventually(picture).toBeGreaterThan(40);
    expect(turnBetween(before, await settledPose(page))).toBeLessThan(0.2);
    await session.send("Emulation.setDeviceMetricsOverride", { ...WIDE, deviceScaleFactor: 0.5, mobile: false });
    await eventually(picture).toBeGreaterThan(40);
    expect(await alert()).toBe("");
    await session.send("Emulation.clearDeviceMetricsOverride");
  });

  it("that is turned: the figure stays in the picture, and all fits", async () => {
    await visit(page, STILL);
    const before = await settledPose(page);
    for (const size of [
      { width: 390, height: 844 },
      { width: 844, height: 390 },
      { width: 390, height: 844 },
    ]) {
      await page.setViewportSize(size);
      const isInside = () =>
        page.evaluate(() => {
          const { left, right, top, bottom } = document.querySelector(".stage")!.getBoundingClientRect();
          const { x, y } = window.strut.jointScreenPosition("hips");
          return x > left && x < right && y > top && y < bottom && right <= innerWidth + 1;
        });
      await eventually(isInside, JSON.stringify(size)).toBe(true);
      const wide = () => page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
      await eventually(wide, JSON.stringify(size)).toBeLessThanOrEqual(0);
    }
    await page.setViewportSize(WIDE);
    expect(turnBetween(before, await settledPose(page))).toBeLessThan(0.2);
  });
});

describe("a graphics context that is lost for good", () => {
  it("leaves motion and settings: the motion is saved, and Reload brings the picture back", async () => {
    await visit(page, STILL);
    await page.waitForFunction(() => window.strut.analysed);
    await hurryTimers(page);
    await (await lastContext(page)).evaluate((context) => context.getExtension("WEBGL_lose_context")!.loseContext());
    await eventually(alert).toMatch(/The browser stopped the 3D graphics/);
    const { name, bytes } = await saved(page, "BVH");
    expect(name).toMatch(/proud\.bvh$/);
    expect(bytes.toString()).toMatch(/^HIERARCHY/);
    await page.getByRole("button", { name: "Export" }).click();
    await page.locator(".export-menu").getByRole("button", { name: /^PNG/ }).click();
    await eventually(alert, "no empty picture is saved").toMatch(/Try again later, or reload the page/);
    expect(await page.locator(".toast.note").allTextContents()).not.toContainEqual(expect.stringContaining("png"));
    await page.getByRole("alert").getByRole("button", { name: "Reload" }).click();
    await page.waitForFunction(() => document.querySelector("[role=alert]")?.textContent === "");
    await shown(page);
    await eventually(picture).toBeGreaterThan(40);
    expect(await page.evaluate(() => window.strut.state.styles[0])).toEqual({ name: "proud", weight: 1 });
    await dismissAll(page);
  });
});
