/** Messages over a view: how long they stay, and where the focus goes afterwards. */
import type { Page } from "playwright-core";
import { beforeAll, beforeEach, expect, it } from "vitest";
import { dropFile, eventually, openSite } from "./browser";
import { dismissAll } from "./faults/inject";

let page: Page;
beforeAll(async () => {
  const opened = await openSite({ hash: "play=0" });
  page = opened.page;
  // Makes notes disappear after less than a second.
  await page.evaluate(() => {
    const later = globalThis.setTimeout;
    Object.assign(globalThis, { setTimeout: (act: () => void, ms = 0) => later(act, ms === 6000 ? 800 : ms) });
  });
  return opened.close;
});
beforeEach(async () => {
  await dismissAll(page);
  await page.mouse.move(2, 2);
});

const note = () => page.locator(".toast.note");
const share = () => page.getByRole("button", { name: "Share", exact: true });
const dismiss = () => page.locator(".toast").getByRole("button", { name: "Dismiss" });
/** Waits longer than a note stays. */
const wait = () => page.waitForTimeout(1600);
const focused = () => page.evaluate(() => document.activeElement?.localName);

it("a note stays while it is pointed at, and goes after that", async () => {
  await share().click();
  await note().hover();
  await wait();
  expect(await note().count()).toBe(1);
  await page.mouse.move(2, 2);
  await eventually(() => note().count()).toBe(0);
});

it("a note stays while it has the focus, and goes after that", async () => {
  await share().click();
  await dismiss().focus();
  await wait();
  expect(await note().count()).toBe(1);
  await share().focus();
  await eventually(() => note().count()).toBe(0);
});

it("what is dismissed gives the focus back to where it came from, or else to the view", async () => {
  await share().focus();
  await dropFile(page, "x.txt", "no motion");
  await dismiss().focus();
  await page.keyboard.press("Enter");
  await eventually(() => page.locator(".toast").count()).toBe(0);
  expect(await share().evaluate((e) => e === document.activeElement)).toBe(true);
  await share().evaluate((e) => e.blur());
  await dropFile(page, "x.txt", "no motion");
  await dismiss().focus();
  await page.keyboard.press("Enter");
  await eventually(() => page.locator(".toast").count()).toBe(0);
  expect(await focused()).toBe("h1");
});
