/** In a low window, such as 1280 × 1024 pixels at 400 %, messages cover nothing permanently. */
import type { Page } from "playwright-core";
import { beforeAll, beforeEach, describe, expect, it } from "vitest";
import { dropFile, eventually, openSite, screenshot, visit } from "../browser";
import { dismissAll } from "../faults/inject";
import { Mouse } from "./hands";
import { keyStyle, play, walk } from "./tasks";

let page: Page;
beforeAll(async () => {
  const opened = await openSite({ size: { width: 320, height: 256 }, screenPixels: 1 });
  page = opened.page;
  return opened.close;
});
beforeEach(() => dismissAll(page));

const person = () => ({ page, hands: new Mouse(page) });

/** Shows an error that stays until it is dismissed. */
async function fail(): Promise<void> {
  await dropFile(page, "notes about the motions.txt", "no motion");
  await eventually(() => page.locator(".toast.error").count()).toBe(1);
}

describe("under an error that stays, the task can be done", () => {
  it("in Play", async () => {
    await visit(page, "play=0");
    await fail();
    await screenshot(page, "access-toast-play");
    await play(person());
    expect(await page.locator(".toast.error").count()).toBe(1);
  });

  it("in Walk", async () => {
    await visit(page, "view=walk&play=0");
    await page.locator(".walk").waitFor();
    await fail();
    await screenshot(page, "access-toast-walk");
    await walk(person());
    expect(await page.locator(".toast.error").count()).toBe(1);
  });

  it("in Key-style", async () => {
    await visit(page, "view=key-style&play=0&secs=0.2");
    await page.locator(".key-style").waitFor();
    await fail();
    await screenshot(page, "access-toast-key-style");
    await keyStyle(person());
    expect(await page.locator(".toast.error").count()).toBe(1);
  });
});

it.for(["compare", "walk", "key-style", "crowd", "data", "learn"])("%s: the whole view can be seen", async (view) => {
  await visit(page, `view=${view}&play=0`);
  await page.waitForFunction((view) => document.getElementById("app")?.dataset.view === view, view);
  await fail();
  const ends = await page.evaluate(() => {
    const [shown, toasts] = [".view", ".toasts"].map((it) => document.querySelector(it)!.getBoundingClientRect());
    return { view: shown!.bottom, from: toasts!.top, to: toasts!.bottom, window: innerHeight };
  });
  expect(ends.from).toBeGreaterThanOrEqual(ends.view);
  expect(ends.to).toBeLessThanOrEqual(ends.window);
  expect(ends.view, "room for the view").toBeGreaterThan(120);
});
