/** The timeline: ranges, curves of every joint, values at the pointer, and styles over time. */
import type { Page } from "playwright-core";
import { beforeAll, describe, expect, it } from "vitest";
import type { StrutHook } from "../../web/app/shell/hook";
import { drag, eventually, middleOf, openSite, screenshot, settledPose, turnBetween, visit } from "./browser";

declare const window: { strut: StrutHook };

let page: Page;

beforeAll(async () => {
  const opened = await openSite({ size: { width: 1440, height: 900 } });
  page = opened.page;
  return opened.close;
});

const state = () => page.evaluate(() => window.strut.state);
const frame = () => page.evaluate(() => window.strut.frame!.inputFrame);
const rows = async () => (await page.locator(".timeline-rows").boundingBox())!;
const PAUSED = "play=0&frame=100&styles=proud:1,old:0,depressed:0";

/** Presses, moves and releases on the timeline, at shares of its width. */
async function dragAcross(from: number, to: number, y: number): Promise<void> {
  const box = await rows();
  const at = (share: number) => ({ x: box.x + share * box.width, y: box.y + y });
  await drag(page, at(from), at(to));
}

/**
 * Pauses the walk just after the page has requested a frame 100 ms ahead. Returns the frame that was displayed then.
 */
async function stopWithFrameOnItsWay(): Promise<number> {
  await visit(page, "play=1");
  await eventually(frame).toBeGreaterThan(5);
  return page.evaluate(
    () =>
      new Promise((resolve) => {
        requestAnimationFrame(() => {
          const busyUntil = performance.now() + 100;
          while (performance.now() < busyUntil);
          // The page's own callback runs before this one.
          requestAnimationFrame(() => {
            dispatchEvent(new KeyboardEvent("keydown", { key: " " }));
            resolve(window.strut.frame!.inputFrame);
          });
        });
      }),
  );
}

describe("the playhead", () => {
  it("rests at the frame on screen, also where one was on its way when the walk was stopped", async () => {
    const walkedOn = async () => {
      const stopped = await stopWithFrameOnItsWay();
      await settledPose(page);
      return (await frame()) - stopped;
    };
    await eventually(walkedOn, "a frame came after").toBeGreaterThan(1);
    await eventually(async () => (await state()).frame - (await frame())).toBeCloseTo(0, 6);
    const inLink = `frame=${Number((await frame()).toFixed(2))}`;
    await eventually(() => page.url()).toContain(inLink);
  });
});

describe("arrow keys", () => {
  it("step through the frames also after a click on the picture", async () => {
    await visit(page, PAUSED);
    await settledPose(page);
    const stage = (await page.locator(".stage").boundingBox())!;
    const where = () => page.evaluate(() => window.strut.jointScreenPosition("hips"));
    const before = await where();
    await page.mouse.click(stage.x + 30, stage.y + stage.height / 3);
    await page.keyboard.press("ArrowRight");
    await eventually(async () => (await state()).frame).toBe(101);
    await settledPose(page);
    // The camera has not moved: the hips move only by their motion in one frame.
    const after = await where();
    expect(Math.hypot(after.x - before.x, after.y - before.y)).toBeLessThan(10);
  });
});

describe("a range", () => {
  it("is selected in the ruler and looped", async () => {
    await visit(page, PAUSED);
    await settledPose(page);
    await dragAcross(0.5, 0.6, 6);
    await eventually(async () => (await state()).range).toBeDefined();
    const { range } = await state();
    const last = Number(await page.locator(".scrub input").getAttribute("max"));
    expect(range!.first / last).toBeCloseTo(0.5, 1);
    expect(range!.last / last).toBeCloseTo(0.6, 1);
    await screenshot(page, "range");
    await page.getByLabel("Speed").first().selectOption("4");
    await page.keyboard.press("Space");
    const seen: number[] = [];
    const begunAnew = () => seen.some((f, i) => i > 0 && f < seen[i - 1]!);
    await eventually(async () => {
      seen.push(await frame());
      return begunAnew() && seen.length >= 12;
    }, "it begins anew").toBe(true);
    await page.keyboard.press("Space");
    expect(Math.min(...seen)).toBeGreaterThanOrEqual(range!.first - 1);
    expect(Math.max(...seen)).toBeLessThanOrEqual(range!.last + 1);
  });

  it("begins and ends at the playhead by key, and goes away", async () => {
    await visit(page, PAUSED);
    await settledPose(page);
    await page.keyboard.press("i");
    await page.keyboard.press("End");
    await page.keyboard.press("o");
    await eventually(async () => (await state()).range?.first).toBe(100);
    await eventually(() => page.url()).toContain("range=100-");
    await page.keyboard.press("u");
    await eventually(async () => (await state()).range).toBeUndefined();
  });
});

describe("trim handles", () => {
  const handle = (name: string) => page.getByRole("slider", { name });
  const range = async () => (await state()).range;
  const last = async () => Number(await page.locator(".scrub input").getAttribute("max"));

  it("are dragged, show the frame at them, and are one step of undo each", async () => {
    await visit(page, PAUSED);
    await settledPose(page);
    const box = await rows();
    const start = (await handle("Start of the trim").boundingBox())!;
    const from = { x: start.x + start.width / 2, y: start.y + start.height / 2 };
    await drag(page, from, { x: from.x + 0.25 * box.width, y: from.y });
    await eventually(range).toBeDefined();
    const first = (await range())!.first;
    expect(first / (await last())).toBeCloseTo(0.25, 1);
    expect((await range())!.last).toBe(await last());
    await eventually(async () => (await state()).frame).toBe(first);
    await eventually(() => page.url()).toContain(`range=${first}-`);
    await eventually(() => page.locator(".time").textContent()).toMatch(/ s kept$/);
    const end = await middleOf(handle("End of the trim"));
    await drag(page, end, { x: end.x - 0.5 * box.width, y: end.y });
    await eventually(async () => (await range())!.last).toBeLessThan(0.6 * (await last()));
    await screenshot(page, "trim");
    await page.keyboard.press("Control+z");
    await eventually(range).toEqual({ first, last: await last() });
    await page.keyboard.press("Control+z");
    await eventually(range).toBeUndefined();
    await page.keyboard.press("Control+Shift+z");
    await eventually(range).toEqual({ first, last: await last() });
    await handle("Start of the trim").dblclick();
    await eventually(range).toBeUndefined();
  });

  it("are moved with keys, and never past each other", async () => {
    await visit(page, `${PAUSED}&range=100-200`);
    const end = handle("End of the trim");
    await end.press("Shift+ArrowLeft");
    await end.press("ArrowRight");
    await eventually(range).toEqual({ first: 100, last: 191 });
    await eventually(() => end.getAttribute("aria-valuetext")).toBe("3.18 seconds");
    await eventually(async () => (await state()).frame).toBe(191);
    await handle("Start of the trim").press("End");
    await eventually(range).toEqual({ first: 190, last: 191 });
    await handle("Start of the trim").press("Home");
    await end.press("Delete");
    await eventually(range).toBeUndefined();
  });

  it("give back what they were with Escape", async () => {
    await visit(page, `${PAUSED}&range=100-200`);
    await settledPose(page);
    const { x, y } = await middleOf(handle("End of the trim"));
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 80, y);
    await eventually(async () => (await range())!.last).toBeGreaterThan(210);
    await page.keyboard.press("Escape");
    await page.mouse.up();
    await eventually(range).toEqual({ first: 100, last: 200 });
  });

  it("are on the scrubber of a narrow screen, with an area for fingers", async () => {
    await page.setViewportSize({ width: 390, height: 844 });
    await visit(page, `${PAUSED}&range=100-300`);
    const end = page.locator(".scrub").getByRole("slider", { name: "End of the trim" });
    const scrub = (await page.locator(".scrub").boundingBox())!;
    const { x, y } = await middleOf(end);
    await drag(page, { x, y }, { x: x + 0.3 * scrub.width, y });
    await eventually(async () => (await range())!.last).toBeGreaterThan(400);
    await screenshot(page, "trim-narrow");
    await page.setViewportSize({ width: 1440, height: 900 });
    await visit(page, PAUSED);
    await eventually(range).toBeUndefined();
  });
});

describe("a curve", () => {
  it("is of any degree of freedom, and the pointer over it moves the character there and back", async () => {
    await visit(page, PAUSED);
    const before = await settledPose(page);
    await page.getByLabel("Joint of the curve").selectOption("left upper arm x");
    await eventually(async () => (await state()).curve).toBe("left upper arm x");
    const box = await rows();
    await page.mouse.move(box.x + 0.7 * box.width, box.y + 80);
    const last = Number(await page.locator(".scrub input").getAttribute("max"));
    await eventually(frame).toBeGreaterThan(0.65 * last);
    await screenshot(page, "hover");
    expect((await state()).frame, "the playhead stays").toBe(100);
    const title = () => page.locator(".timeline-rows").getAttribute("title");
    await eventually(title).toMatch(/^Read as walk, /);
    await eventually(title, "the examples and their spread").toMatch(/Examples −?[\d.]+ ± [\d.]+°\.$/);
    await page.mouse.move(box.x + 0.7 * box.width, box.y - 200);
    await eventually(frame).toBe(100);
    expect(turnBetween(before, await settledPose(page))).toBeLessThan(0.2);
  });
});

describe("a style track", () => {
  const keys = () => page.getByRole("slider", { name: /^Style key/ });

  it("gets keys by button, each with its styles, and the styles change between them", async () => {
    await visit(page, PAUSED);
    const proud = await settledPose(page);
    await page.getByRole("button", { name: "Style key here" }).click();
    await page.keyboard.press("End");
    await page.keyboard.press("k");
    await page.locator('.vertex[data-style="depressed"] .vertex-dot').dblclick();
    await eventually(() => keys().count()).toBe(2);
    const track = async () => (await state()).track.map((key) => key.styles.find((s) => s.weight === 1)?.name);
    await eventually(track).toEqual(["proud", "depressed"]);
    // The address bar follows the state after a moment.
    await eventually(() => decodeURIComponent(page.url())).toMatch(/track=.*depressed:1/);
    await screenshot(page, "track");
    await page.keyboard.press("Home");
    for (let i = 0; i < 2; i++) await settledPose(page);
    await visit(
      page,
      `${page
        .url()
        .split("#")[1]!
        .replace(/&frame=[\d.]+/, "")}&frame=100`,
    );
    expect(turnBetween(proud, await settledPose(page)), "still proud at the first key").toBeLessThan(0.3);
    const depressed = await (async () => {
      await page.keyboard.press("End");
      return settledPose(page);
    })();
    await visit(page, "play=0&frame=9999&styles=proud:0,old:0,depressed:1");
    await page.keyboard.press("End");
    expect(turnBetween(depressed, await settledPose(page)), "depressed at the last").toBeLessThan(1.5);
  });

  it("keeps every key as it was set: away from it, another style makes a key", async () => {
    await visit(page, "play=0&frame=60&styles=proud:1,old:0,depressed:0");
    await page.keyboard.press("k");
    await eventually(() => keys().count()).toBe(1);
    const box = await rows();
    await page.mouse.click(box.x + 0.6 * box.width, box.y + 6);
    await eventually(async () => (await state()).frame).toBeGreaterThan(300);
    await page.locator('.vertex[data-style="old"] .vertex-dot').dblclick();
    await eventually(() => keys().count()).toBe(2);
    await page.keyboard.press("k");
    const set = async () => (await state()).track.map(({ styles }) => styles.find((s) => s.weight === 1)?.name);
    await eventually(set).toEqual(["proud", "old"]);
    // The polygon shows the track's present style, and at a key the key's.
    await keys().first().click();
    const heaviest = () => page.locator(".vertex.heaviest").getAttribute("data-style");
    await eventually(heaviest).toBe("proud");
    await eventually(async () => (await state()).frame).toBe(60);
    await page.locator('.vertex[data-style="depressed"] .vertex-dot').dblclick();
    await eventually(set).toEqual(["depressed", "old"]);
    await page.keyboard.press("Home");
    await page.keyboard.press("End");
    await eventually(heaviest).toBe("old");
    await screenshot(page, "track-of-two");
  });

  it("moves a key with the pointer and with arrow keys, and removes it", async () => {
    await visit(page, `${PAUSED}&track=60~proud:1,old:0,depressed:0;300~proud:0,old:0,depressed:1`);
    const first = keys().first();
    const { x, y } = await middleOf(first);
    await drag(page, { x, y }, { x: x + 60, y });
    const frameOfFirst = async () => (await state()).track[0]!.frame;
    await eventually(frameOfFirst).toBeGreaterThan(80);
    const moved = await frameOfFirst();
    await page.keyboard.press("ArrowRight");
    await page.keyboard.press("Shift+ArrowLeft");
    await eventually(frameOfFirst).toBe(moved + 1 - 10);
    await eventually(() => first.getAttribute("aria-valuetext")).toMatch(/^\d+\.\d\d seconds, proud$/);
    await page.keyboard.press("Delete");
    await eventually(() => keys().count()).toBe(1);
    await page.keyboard.press("Control+z");
    await eventually(() => keys().count()).toBe(2);
  });
});
