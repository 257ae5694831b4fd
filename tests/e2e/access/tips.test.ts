/** Tooltips are shown without a mouse: on keyboard focus, and on a long press. */
import type { Page } from "playwright-core";
import { beforeAll, expect, it } from "vitest";
import { eventually, middleOf, openSite, screenshot, visit } from "../browser";
import { atRest } from "../rest";
import { Keys } from "./hands";

let page: Page;
beforeAll(async () => {
  const opened = await openSite({ size: { width: 1440, height: 900 }, screenPixels: 1, hash: "play=0" });
  page = opened.page;
  return opened.close;
});

const tip = () => page.locator(".tip");
const knob = () => page.getByRole("slider", { name: "Kept content" });
const WHY = "ρ: share of the input’s own motion, unlike the neighbours, that is kept";

it("by keys, until Escape, and as the control's description", async () => {
  const keys = new Keys(page);
  await keys.press(page.locator(".section.model summary"));
  const found = keys.move(knob(), { x: 0, y: 0 });
  await found;
  await eventually(() => tip().textContent()).toBe(WHY);
  expect(await tip().isVisible()).toBe(true);
  expect(await knob().getAttribute("aria-description")).toBe(WHY);
  const [said, about] = [(await tip().boundingBox())!, (await page.locator(".knob").nth(2).boundingBox())!];
  expect(said.x).toBeGreaterThanOrEqual(0);
  expect(said.x + said.width).toBeLessThanOrEqual(1440);
  expect(said.y + said.height <= about.y || said.y >= about.y + about.height, "beside the control").toBe(true);
  await screenshot(page, "access-tip-keys");
  await page.keyboard.press("Escape");
  await eventually(() => tip().isVisible()).toBe(false);
  await page.keyboard.press("Tab");
  await page.keyboard.press("Tab");
  await eventually(() => tip().textContent()).toContain("κ");
  await page.mouse.click(400, 400);
  await eventually(() => tip().isVisible()).toBe(false);
});

it("by a finger that rests, which does nothing else; a tap acts", async () => {
  await page.setViewportSize({ width: 390, height: 844 });
  await visit(page, "play=0&tab=model");
  const session = await page.context().newCDPSession(page);
  await session.send("Emulation.setTouchEmulationEnabled", { enabled: true, maxTouchPoints: 1 });
  const timing = page.getByRole("switch", { name: "Timing" });
  await atRest(page, () => middleOf(timing));
  const press = async (ms: number) => {
    await session.send("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: [await middleOf(timing)] });
    await page.waitForTimeout(ms);
    await session.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
  };
  const before = await timing.getAttribute("aria-checked");
  await press(800);
  await eventually(() => tip().textContent()).toContain("Lets the style change the timing");
  expect(await tip().isVisible()).toBe(true);
  const [said, about] = [(await tip().boundingBox())!, (await timing.boundingBox())!];
  expect(about.y - (said.y + said.height), "next to the control").toBeLessThan(30);
  await screenshot(page, "access-tip-finger");
  await page.waitForTimeout(300);
  expect(await timing.getAttribute("aria-checked")).toBe(before);
  await press(30);
  await eventually(() => timing.getAttribute("aria-checked")).not.toBe(before);
  expect(await tip().isVisible()).toBe(false);
});
