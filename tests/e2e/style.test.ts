/** The main feature: a character walks, and dragging a point changes its style. */
import type { Browser, Page } from "playwright-core";
import { beforeAll, describe, expect, it } from "vitest";
import type { StrutHook } from "../../web/app/shell/hook";
import { walksIn } from "../clips";
import {
  closePage,
  dragHolding,
  drawn,
  dropFile,
  eventually,
  inputName,
  middleOf,
  openPage,
  openSite,
  screenshot,
  settledPose,
  turnBetween,
  visit,
} from "./browser";
import { atRest } from "./rest";

declare const window: { strut: StrutHook };

let browser: Browser;
let page: Page;

beforeAll(async () => {
  const opened = await openSite();
  browser = opened.browser;
  page = opened.page;
  return opened.close;
});

/** A paused state, so that only the style changes the pose. */
const PAUSED = "play=0&frame=60&styles=proud:1,old:0,depressed:0";

const handle = () => page.getByRole("slider", { name: "Style", exact: true });
const weights = () => page.evaluate(() => window.strut.state.styles.map((s) => s.weight));

describe("the page", () => {
  it("opens with a character that walks", async () => {
    const feet = () =>
      page.evaluate(() => {
        const place = (role: "left_foot" | "right_foot" | "head") => window.strut.jointScreenPosition(role);
        return { left: place("left_foot"), right: place("right_foot"), head: place("head") };
      });
    const places: Awaited<ReturnType<typeof feet>>[] = [];
    const travel = (side: "left" | "right") => {
      const xs = places.map((p) => p[side].x);
      return Math.max(...xs) - Math.min(...xs);
    };
    await eventually(async () => {
      places.push(await feet());
      return Math.min(travel("left"), travel("right"));
    }).toBeGreaterThan(20);
    const stage = (await page.locator(".stage-view").boundingBox())!;
    for (const { head } of places) {
      expect(head.x).toBeGreaterThan(stage.x);
      expect(head.x).toBeLessThan(stage.x + stage.width);
      expect(head.y).toBeGreaterThan(stage.y);
      expect(head.y).toBeLessThan(stage.y + stage.height / 2);
    }
    await eventually(() => page.locator(".stage-title").textContent()).toMatch(/^Walk, mostly /);
    await screenshot(page, "rest");
  });
});

describe("the point in the triangle", () => {
  it("changes the pose where it is dragged, and undo brings the pose back", async () => {
    await visit(page, PAUSED);
    const before = await settledPose(page);
    const depressed = page.locator('.vertex[data-style="depressed"] .vertex-dot');
    await dragHolding(page, await middleOf(handle()), await middleOf(depressed));
    await screenshot(page, "drag");
    await page.mouse.up();
    const after = await settledPose(page);
    await eventually(async () => (await weights())[2]).toBeGreaterThan(0.95);
    expect(turnBetween(before, after)).toBeGreaterThan(3);

    await page.keyboard.press("Control+z");
    expect(turnBetween(before, await settledPose(page))).toBeLessThan(0.2);
    await page.keyboard.press("Control+Shift+z");
    expect(turnBetween(after, await settledPose(page))).toBeLessThan(0.2);
  });

  it("acts while the character walks", async () => {
    // Distance of the styled character from the input at the same instant, which walking alone does not change.
    const distance = async () => {
      const { pose, inputPose } = await page.evaluate(() => {
        const { pose, inputPose } = window.strut.frame!;
        return { pose: [...pose], inputPose: [...inputPose] };
      });
      return turnBetween(pose, inputPose);
    };
    await visit(page, "intensity=0&styles=proud:0,old:0,depressed:1");
    await eventually(distance).toBeLessThan(2);
    const unstyled: number[] = [];
    for (let i = 0; i < 20; i++) unstyled.push(await distance());
    await page.getByRole("slider", { name: "Intensity" }).fill("1");
    await eventually(distance).toBeGreaterThan(2 * Math.max(...unstyled));
    expect(await page.evaluate(() => window.strut.state.playing)).toBe(true);
  });

  it("follows the arrow keys, with Shift in small steps, and says its weights", async () => {
    await visit(page, "play=0&frame=60&styles=proud:0.4,old:0.3,depressed:0.3");
    const before = await settledPose(page);
    await handle().focus();
    await atRest(page, () => middleOf(handle()));
    const start = await middleOf(handle());
    await page.keyboard.press("ArrowUp");
    await eventually(async () => start.y - (await middleOf(handle())).y).toBeCloseTo(0.05 * 92, 0);
    const up = await middleOf(handle());
    await page.keyboard.press("Shift+ArrowRight");
    await eventually(async () => (await middleOf(handle())).x - up.x).toBeCloseTo(0.01 * 92, 0);
    for (let i = 0; i < 10; i++) await page.keyboard.press("ArrowUp");
    const said = () => handle().getAttribute("aria-valuetext");
    await eventually(said).toMatch(/^proud 0\.\d\d, old 0\.\d\d, depressed 0\.\d\d$/);
    expect(turnBetween(before, await settledPose(page))).toBeGreaterThan(1);
    expect(await page.evaluate(() => window.strut.state.playing)).toBe(false);
  });

  it("selects a style with Enter, drops it with Delete, takes all of one with a number key", async () => {
    await visit(page, PAUSED);
    const names = () => page.evaluate(() => window.strut.state.styles.map((s) => s.name));
    const neutral = page.locator('.vertex[data-style="neutral"]');
    await neutral.focus();
    await page.keyboard.press("Enter");
    await eventually(names).toContain("neutral");
    await page.keyboard.press("Delete");
    await eventually(names).not.toContain("neutral");
    await page.keyboard.press("1");
    await eventually(async () => Math.max(...(await weights()))).toBe(1);
  });
});

describe("intensity", () => {
  it("goes from neutral to beyond the style", async () => {
    await visit(page, PAUSED);
    const full = await settledPose(page);
    const slider = page.getByRole("slider", { name: "Intensity" });
    await slider.fill("0");
    const none = await settledPose(page);
    await slider.fill("1.5");
    const more = await settledPose(page);
    expect(turnBetween(full, none)).toBeGreaterThan(2);
    expect(turnBetween(more, none)).toBeGreaterThan(turnBetween(full, none));
    await eventually(() => page.locator(".polygon-caption").textContent()).toMatch(/Beyond the data/);
  });
});

describe("the URL", () => {
  it("holds the picture: a copy of it shows the same pose", async () => {
    await visit(page, "play=0&frame=75");
    await page.locator(".vertex-dot").first().dblclick();
    await page.getByRole("slider", { name: "Intensity" }).fill("0.7");
    await page.getByText("Advanced", { exact: true }).click();
    await page.getByRole("slider", { name: "Neighbours" }).press("ArrowUp");
    await page.getByRole("switch", { name: "Footplant" }).click();
    await page.getByRole("radio", { name: "Side" }).check({ force: true });
    const pose = await settledPose(page);
    await page.getByRole("button", { name: "Share" }).click();
    const copied = () => page.evaluate(() => navigator.clipboard.readText());
    // The address bar follows the state after a moment.
    await eventually(async () => (await copied()) === page.url()).toBe(true);
    const state = await page.evaluate(() => window.strut.state);
    const other = await openPage(browser, await copied());
    await eventually(() => other.evaluate(() => window.strut.state)).toEqual(state);
    expect(turnBetween(pose, await settledPose(other))).toBeLessThan(0.2);
    await closePage(other);
  });

  it("asks for a file that it does not hold, and is complete with it", async () => {
    const { old } = await walksIn(["old"], 200);
    const link = "play=0&frame=90&styles=proud:1,old:0,depressed:0&input=my%20walk";
    const whole = await openPage(browser, page.url().replace(/#.*/, ""), { hash: link, notesStay: true });
    await eventually(() => whole.locator(".toasts").textContent()).toContain("Drop the file here.");
    await dropFile(whole, "my walk.bvh", old);
    await eventually(() => inputName(whole)).toBe("my walk");
    await eventually(() => whole.evaluate(() => window.strut.frame!.inputFrame)).toBe(90);
    const first = () => whole.evaluate(() => window.strut.state.styles[0]);
    await eventually(first).toEqual({ name: "proud", weight: 1 });
    await closePage(whole);
  });
});

describe("playing", () => {
  it("stops, goes by frames, scrubs and ends where it is not to loop", async () => {
    await visit(page, "loop=0");
    const frame = () => page.evaluate(() => window.strut.frame!.inputFrame);
    await page.keyboard.press("Space");
    await eventually(() => page.evaluate(() => window.strut.state.playing)).toBe(false);
    await settledPose(page);
    const at = Math.round(await frame());
    await page.keyboard.press("ArrowRight");
    await eventually(frame).toBe(at + 1);
    const rows = (await page.locator(".timeline-rows").boundingBox())!;
    await page.mouse.click(rows.x + rows.width / 2, rows.y + 80);
    const last = Number(await page.locator(".scrub input").getAttribute("max"));
    await eventually(frame).toBeGreaterThan(last * 0.45);
    expect(await frame()).toBeLessThan(last * 0.55);
    await page.keyboard.press("End");
    await eventually(frame).toBe(last);
    await page.keyboard.press("Space");
    await eventually(frame).toBeLessThan(last * 0.5);
  });
});

it("a knob is scrolled past by the wheel, and turned by it while it has the focus", async () => {
  await visit(page, PAUSED);
  const k = page.locator(".knob-dial").first();
  const value = () => k.getAttribute("aria-valuenow");
  const before = await value();
  await k.hover();
  await page.mouse.wheel(0, -100);
  await drawn(page, 10);
  expect(await value()).toBe(before);
  await k.focus();
  // Its panel may have been scrolled.
  await k.hover();
  await page.mouse.wheel(0, -100);
  await eventually(value).not.toBe(before);
});
