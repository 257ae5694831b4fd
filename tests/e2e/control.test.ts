/** Further controls of the style: styles for parts of the body, two setups, random styles. */

import type { Browser, Page } from "playwright-core";
import { beforeAll, describe, expect, it } from "vitest";
import type { StrutHook } from "../../web/app/shell/hook";
import { JOINT, type Role } from "../../web/humanoid";
import { closePage, eventually, openPage, openSite, screenshot, settledPose, turnBetween, visit } from "./browser";
import { atRest } from "./rest";

declare const window: { strut: StrutHook };

let browser: Browser;
let page: Page;

beforeAll(async () => {
  const opened = await openSite({ size: { width: 1440, height: 900 } });
  [browser, page] = [opened.browser, opened.page];
  return opened.close;
});

const PAUSED = "play=0&frame=60&footplant=0&styles=proud:1,old:0,depressed:0";
const state = () => page.evaluate(() => window.strut.state);
const part = () => page.getByLabel("Body part", { exact: true });

/** Returns the angle of one joint between two poses, degrees. */
function turnOf(role: Role, a: readonly number[], b: readonly number[]): number {
  const at = 3 + 4 * JOINT[role];
  const dot = [0, 1, 2, 3].reduce((sum, k) => sum + a[at + k]! * b[at + k]!, 0);
  return (2 * Math.acos(Math.min(1, Math.abs(dot))) * 180) / Math.PI;
}

describe("a part of the body", () => {
  it("takes a style of its own from the list, and only it changes", async () => {
    await visit(page, PAUSED);
    const proud = await settledPose(page);
    await part().selectOption("left_arm");
    await page.locator('.vertex[data-style="depressed"] .vertex-dot').dblclick();
    const mixed = await settledPose(page);
    expect(turnOf("left_upper_arm", proud, mixed)).toBeGreaterThan(3);
    expect(turnOf("right_upper_arm", proud, mixed)).toBeLessThan(0.1);
    expect(turnOf("left_lower_leg", proud, mixed)).toBeLessThan(0.1);
    await eventually(() => part().locator("option:checked").textContent()).toBe("left arm: depressed");
    await screenshot(page, "body-part");
    await page.keyboard.press("Control+z");
    expect(turnBetween(proud, await settledPose(page))).toBeLessThan(0.1);
    await page.keyboard.press("Control+Shift+z");
    await page.getByRole("button", { name: "Reset the body part" }).click();
    expect(turnBetween(proud, await settledPose(page))).toBeLessThan(0.1);
  });

  it("is chosen by a click on the body", async () => {
    await visit(page, `${PAUSED}&camera=front`);
    await settledPose(page);
    await atRest(page, () => page.evaluate(() => window.strut.jointScreenPosition("head")));
    for (const [role, expected] of [
      ["left_lower_arm", "left_arm"],
      ["head", "head"],
      ["right_lower_leg", "legs"],
    ] as const) {
      const at = await page.evaluate((role) => window.strut.jointScreenPosition(role), role);
      await page.mouse.click(at.x, at.y);
      await eventually(async () => (await state()).part).toBe(expected);
    }
    const box = (await page.locator(".stage").boundingBox())!;
    await page.mouse.click(box.x + 30, box.y + 300);
    expect((await state()).part, "beside the body nothing is chosen").toBe("legs");
  });

  it("is in the link", async () => {
    await visit(page, `${PAUSED}&part=legs&parts=legs~old:1`);
    const pose = await settledPose(page);
    const other = await openPage(browser, page.url());
    const parts = () => other.evaluate(() => window.strut.state.parts);
    await eventually(parts).toEqual({ legs: [{ name: "old", weight: 1 }] });
    expect(turnBetween(pose, await settledPose(other))).toBeLessThan(0.2);
    await closePage(other);
  });
});

describe("A and B", () => {
  it("keep a setting each, by pointer and by key", async () => {
    await visit(page, PAUSED);
    const a = await settledPose(page);
    await page.getByRole("radio", { name: "B", exact: true }).check({ force: true });
    await page.locator('.vertex[data-style="depressed"] .vertex-dot').dblclick();
    const b = await settledPose(page);
    expect(turnBetween(a, b)).toBeGreaterThan(3);
    await page.keyboard.press("x");
    expect(turnBetween(a, await settledPose(page))).toBeLessThan(0.1);
    await page.keyboard.press("x");
    expect(turnBetween(b, await settledPose(page))).toBeLessThan(0.1);
    await eventually(() => page.getByRole("radio", { name: "B", exact: true }).isChecked()).toBe(true);
  });
});

describe("chance", () => {
  it("takes three styles, and undo takes them back", async () => {
    await visit(page, PAUSED);
    const before = (await state()).styles;
    await page.getByRole("button", { name: "Random styles" }).click();
    const styles = async () => (await state()).styles;
    await eventually(styles).not.toEqual(before);
    expect(await styles()).toHaveLength(3);
    await page.keyboard.press("Control+z");
    await eventually(styles).toEqual(before);
  });
});

describe("the intensity", () => {
  it("marks what the data holds", async () => {
    await visit(page, "play=0&frame=60&styles=proud:0.5,old:0.5");
    const max = () =>
      page.locator(".slider-track").evaluate((e) => Number(getComputedStyle(e).getPropertyValue("--max")));
    // −1 to 2: the largest weight is 1 at an intensity of 2, and also 1 once there is only one style.
    await eventually(max).toBeCloseTo(1, 5);
    await visit(page, PAUSED);
    await eventually(max).toBeCloseTo(2 / 3, 5);
  });
});

describe("the model", () => {
  const advanced = () => page.locator(".section.model summary");

  it("has its knobs folded away, says how many settings were changed, and remembers the fold", async () => {
    await visit(page, PAUSED);
    const knob = () => page.getByRole("slider", { name: "Neighbours" }).isVisible();
    await eventually(() => advanced().textContent()).toBe("Advanced6 knobs, none changed");
    expect(await knob()).toBe(false);
    await visit(page, `${PAUSED}&k=80&method=lar`);
    await eventually(() => advanced().textContent()).toBe("Advanced2 settings changed");
    await advanced().press("Enter");
    await eventually(knob).toBe(true);
    await page.reload();
    await eventually(knob).toBe(true);
    await page.waitForFunction(() => window.strut?.frame !== undefined);
  });

  it("takes another method at once", async () => {
    await visit(page, `${PAUSED}&rho=0`);
    const mar = await settledPose(page);
    await page.getByLabel("Method").selectOption("nn");
    expect(turnBetween(mar, await settledPose(page))).toBeGreaterThan(0.2);
    await page.getByRole("button", { name: "Reset the model" }).click();
    await eventually(async () => (await state()).method).toBe("mar");
  });

  it("takes what the input is said to be, and leaves it to the engine again", async () => {
    await visit(page, PAUSED);
    const reading = () => page.locator(".reading").textContent();
    await eventually(reading).toBe("walk, neutral");
    await page.getByLabel("Action of the input").selectOption("run");
    await eventually(reading).toMatch(/^run, /);
    await eventually(async () => (await state()).action).toBe("run");
    await page.getByLabel("Style of the input").selectOption("old");
    await eventually(reading).toBe("run, old");
    await page.getByRole("button", { name: "Reset the model" }).click();
    await eventually(reading).toBe("walk, neutral");
  });

  it("tells what the input does while it walks, punches, kicks and jumps", async () => {
    const input = "input=neutral%20walk%2C%20punch%2C%20kick%2C%20jump%20and%20walk";
    const reading = () => page.locator(".reading").textContent();
    for (const [frame, action] of [
      [200, "walk"],
      [425, "punch"],
      [590, "kick"],
      [830, "jump"],
      [1100, "walk"],
    ] as const) {
      await visit(page, `play=0&frame=${frame}&styles=angry:1,old:0,sexy:0&${input}`);
      await eventually(reading).toBe(`${action}, neutral`);
      await settledPose(page);
      await screenshot(page, `input-${action}-${frame}`);
    }
  });
});
