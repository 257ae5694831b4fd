/** The Walk view: a plan of styles for a walk. */
import { readFileSync } from "node:fs";
import { ALL_FORMATS, BufferSource, Input } from "mediabunny";
import type { Locator, Page } from "playwright-core";
import { beforeAll, describe, expect, it } from "vitest";
import type { StrutHook } from "../../web/app/shell/hook";
import { axeFaults } from "./axe";
import { drag, dragHolding, drawn, eventually, middleOf, openSite, visit } from "./browser";
import { expectFitsNarrow } from "./narrow";
import { atRest, showTheme } from "./rest";

declare const window: { strut: StrutHook };

/** Paused in the middle of the transition from neutral to proud. */
const THREE = "walk=1_3_2~neutral:1,old:0,sexy:0;1_4_2~proud:1,old:0,sexy:0;1_3_2~old:1,proud:0,sexy:0";

let page: Page;

beforeAll(async () => {
  const opened = await openSite({ size: { width: 1440, height: 900 }, theme: "dark" });
  page = opened.page;
  return opened.close;
});

const state = () => page.evaluate(() => window.strut.state);
const blocks = () => page.locator(".planner-block");
const block = (n: number) => page.locator(`[data-key="block-${n}"]`);
const title = () => page.locator(".walk .stage-title").textContent();
const figure = (name: string) =>
  page.locator(".walk-figures > div").filter({ hasText: name }).locator("dd").textContent();
const number = async (name: string) => Number.parseFloat((await figure(name))!);
const secs = async () => Number(await page.locator(".walk .clock").textContent());

/** Drags an edge of a block to the right. */
async function dragEdge(selector: string, dx: number): Promise<void> {
  const { x, y } = await middleOf(page.locator(selector));
  await drag(page, { x, y }, { x: x + dx, y });
}

const faults = () => axeFaults(page);

/** Waits until an animated element has stopped. */
const resting = (thing: Locator) => atRest(page, () => middleOf(thing));

describe("opening the view", () => {
  it("shows the model of the built-in walks without training it, and walks", async () => {
    const scripts: string[] = [];
    page.on("request", (request) => scripts.push(request.url()));
    await page.getByRole("link", { name: "Walk", exact: true }).click();
    await eventually(() => blocks().count()).toBe(3);
    await eventually(title).toBe("22 steps, three styles");
    const before = await secs();
    await eventually(secs, "it walks by itself").not.toBe(before);
    await eventually(() => figure("Step length")).toMatch(/^0\.\d\d m$/);
    expect(scripts.some((url) => url.includes("built_in"))).toBe(true);
    expect(scripts.filter((url) => url.includes("build_worker"))).toEqual([]);
    // Colours of newly enabled controls change gradually.
    await eventually(faults).toEqual([]);
  });

  it("follows the keyboard: play, pause, steps", async () => {
    await page.locator("body").press("Space");
    await eventually(async () => (await state()).playing).toBe(false);
    await drawn(page, 2);
    const still = await secs();
    await drawn(page, 20);
    expect(await secs()).toBe(still);
    await page.locator("body").press("Home");
    await eventually(secs).toBe(0);
    await page.locator("body").press("ArrowRight");
    await eventually(() => page.locator(".walk .editor-head").getAttribute("aria-valuetext")).toMatch(/step 2$/);
    await page.locator("body").press("ArrowLeft");
    await eventually(() => page.locator(".walk .editor-head").getAttribute("aria-valuetext")).toMatch(/step 1$/);
  });
});

describe("the plan", () => {
  it("takes steps by the end of a block, and gives them back by undo", async () => {
    await visit(page, `view=walk&play=0&${THREE}`);
    await eventually(title).toBe("16 steps, three styles");
    await dragEdge('[data-key="end-1"]', 200);
    await eventually(async () => (await state()).walk[1]!.steps).toBeGreaterThan(5);
    const { steps } = (await state()).walk[1]!;
    await eventually(() => page.url()).toContain(`1_${steps}_2~proud:1`);
    await page.keyboard.press("Control+z");
    await eventually(async () => (await state()).walk[1]!.steps, "one drag, one step of undo").toBe(4);
    await eventually(title).toBe("16 steps, three styles");
  });

  it("moves a transition between its neighbours, by pointer and by keys", async () => {
    await dragEdge('[data-key="middle-1"]', 70);
    await eventually(async () => (await state()).walk[0]!.steps).toBeGreaterThan(3);
    const { walk } = await state();
    expect(walk[0]!.steps + walk[1]!.steps).toBe(7);
    await page.locator('[data-key="middle-1"]').focus();
    await page.keyboard.press("ArrowUp");
    await eventually(async () => (await state()).walk[1]!.transition).toBe(3);
    await page.keyboard.press("ArrowLeft");
    await eventually(async () => (await state()).walk[0]!.steps).toBe(walk[0]!.steps - 1);
  });

  it("has sliders that say what every key changes, and know Home and End", async () => {
    await visit(page, `view=walk&play=0&${THREE}`);
    const slider = (key: string) => page.locator(`[data-key="${key}"]`);
    const spoken = (key: string) => slider(key).getAttribute("aria-valuetext");
    await eventually(() => spoken("middle-1")).toBe("over 2 steps, from step 4");
    await slider("middle-1").press("ArrowRight");
    await eventually(() => spoken("middle-1"), "its length is the same").toBe("over 2 steps, from step 5");
    await slider("middle-1").press("Home");
    await eventually(() => spoken("middle-1")).toBe("at once, from step 5");
    await eventually(() => slider("middle-1").getAttribute("aria-valuenow")).toBe("0");
    await slider("end-2").press("End");
    await eventually(() => spoken("end-2")).toBe("16 steps");
    await eventually(() => slider("end-2").getAttribute("aria-valuenow")).toBe("16");
  });

  it("changes the order of blocks, adds and removes them", async () => {
    await visit(page, `view=walk&play=0&${THREE}`);
    const to = await middleOf(block(0));
    await dragHolding(page, await middleOf(block(2)), { x: to.x - 4, y: to.y });
    const order = async () => (await state()).walk.map((b) => b.styles[0]!.name);
    await eventually(async () => {
      await page.mouse.move(to.x - 4 - Math.random(), to.y);
      return order();
    }).toEqual(["old", "neutral", "proud"]);
    await page.mouse.up();
    await block(0).focus();
    await page.keyboard.press("ArrowRight");
    await eventually(order).toEqual(["neutral", "old", "proud"]);
    await eventually(() => page.evaluate(() => document.activeElement?.getAttribute("data-key"))).toBe("block-1");
    await page.getByRole("button", { name: "Add block" }).click();
    await eventually(() => blocks().count()).toBe(4);
    await eventually(async () => (await state()).walkBlock).toBe(2);
    await block(2).press("Delete");
    await eventually(() => blocks().count()).toBe(3);
  });

  it("is put back by Escape during a drag", async () => {
    await visit(page, `view=walk&play=0&${THREE}`);
    await eventually(title).toBe("16 steps, three styles");
    const { x, y } = await middleOf(page.locator('[data-key="end-1"]'));
    await dragHolding(page, { x, y }, { x: x + 200, y });
    const steps = async () => (await state()).walk[1]!.steps;
    await eventually(steps).toBeGreaterThan(5);
    await page.keyboard.press("Escape");
    await eventually(steps).toBe(4);
    await page.mouse.move(x + 100, y);
    await page.mouse.up();
    expect(await steps(), "the pointer drags no longer").toBe(4);
  });

  it("is sought by its playhead", async () => {
    const ruler = (await page.locator(".timeline-seek").boundingBox())!;
    await page.mouse.click(ruler.x + ruler.width / 2, ruler.y + 10);
    const half = Number.parseFloat((await page.locator(".walk .editor-time .caption").textContent())!.slice(3)) / 2;
    await eventually(secs).toBeCloseTo(half, 0);
    await page.locator(".walk .editor-head").focus();
    await page.keyboard.press("Home");
    await eventually(secs).toBe(0);
    // However slow the key presses, each is a tenth of a second: the playhead does not drift.
    for (let i = 1; i <= 25; i++) {
      await page.keyboard.press("ArrowRight");
      await eventually(secs).toBeCloseTo(i / 10, 2);
    }
  });
});

describe("the block", () => {
  it("is mixed by the polygon and exaggerated by the intensity", async () => {
    await visit(page, `view=walk&play=0&block=1&${THREE}`);
    await eventually(() => page.locator("#walk-block-heading").textContent()).toBe("Block 2, proud");
    const speed = await number("Speed");
    const panel = page.locator(".walk-panel");
    await resting(panel.locator(".handle-body"));
    const old = panel.locator('.vertex[data-style="old"] .vertex-dot');
    await drag(page, await middleOf(panel.locator(".handle-body")), await middleOf(old));
    const share = async () => (await state()).walk[1]!.styles.find((s) => s.name === "old")!.weight;
    await eventually(share).toBeGreaterThan(0.9);
    const { walk } = await state();
    expect(walk[0]!.styles[0]!.weight, "the others stay").toBe(1);
    await eventually(() => number("Speed"), "the old walk slower").toBeLessThan(speed);
    await drawn(page, 2);
    const slow = await number("Speed");
    await page.getByLabel("Intensity").last().focus();
    for (let i = 0; i < 50; i++) await page.keyboard.press("ArrowRight");
    await eventually(async () => (await state()).walk[1]!.intensity).toBe(1.5);
    await eventually(() => number("Speed"), "and very old ones slower still").toBeLessThan(slow);
    const caption = () => page.locator(".walk .polygon-caption").textContent();
    await eventually(caption).toMatch(/^Beyond the recorded walks/);
  });

  it("walks to a beat, and as irregularly as people do", async () => {
    await page.locator('.walk-panel [aria-label="Durations"] label').filter({ hasText: "Fixed" }).click();
    await page.getByRole("slider", { name: "Cadence" }).click();
    await page.keyboard.press("End");
    await eventually(() => number("Cadence")).toBeGreaterThan(150);
    await page.locator('.walk-panel [aria-label="Durations"] label').filter({ hasText: "Sampled" }).click();
    await eventually(() => page.url()).toContain("tempo=sampled");
    await eventually(() => number("Cadence")).toBeLessThan(150);
  });

  it("falls in with a beat that is tapped", async () => {
    await page.locator('.walk-panel [aria-label="Durations"] label').filter({ hasText: "Fixed" }).click();
    await eventually(async () => (await state()).walkTempo).toBe("fixed");
    // With simulated times, since real taps are delayed on a busy machine.
    await page.getByRole("button", { name: "Tap the beat" }).evaluate((tap: HTMLButtonElement) => {
      const now = performance.now();
      for (let i = 0; i < 5; i++) {
        performance.now = () => now + 600 * i;
        tap.click();
      }
      Reflect.deleteProperty(performance, "now");
    });
    await eventually(async () => (await state()).walkCadence).toBe(100);
    await eventually(() => number("Cadence")).toBe(100);
  });

  it("gives each foot steps of its own", async () => {
    await visit(page, `view=walk&play=0&walk=1_4_2~proud:1,old:0,sexy:0`);
    await eventually(title).toBe("Four steps, one style");
    const feet = (name: string) =>
      page.locator('.walk-panel [aria-label="Applies to"] label').filter({ hasText: name });
    await feet("Right").click();
    await page.locator('.walk-panel .vertex[data-style="old"] .vertex-dot').dblclick();
    await eventually(() => page.locator("#walk-block-heading").textContent()).toBe("Block 1, proud left, old right");
    await eventually(() => page.url()).toMatch(/r~[^;]*old:1/);
    await eventually(title).toBe("Four steps, two styles");
    await feet("Both feet").click();
    await eventually(() => page.locator("#walk-block-heading").textContent()).toBe("Block 1, proud");
    await page.keyboard.press("Control+z");
    await eventually(async () => (await state()).walk[0]!.right?.length).toBeGreaterThan(0);
  });

  it("takes shorter steps, and stops where it is not walked on", async () => {
    await visit(page, `view=walk&play=0&${THREE}`);
    await eventually(() => number("Step length")).toBeGreaterThan(0.3);
    const before = await number("Step length");
    await page.getByRole("slider", { name: "Stride" }).click();
    await page.keyboard.press("Home");
    await eventually(() => number("Step length")).toBeLessThan(0.8 * before);
    await eventually(() => page.url()).toContain("stride=60");
    // Without repetition the character stands at the end.
    await page.getByRole("button", { name: "Repeat the plan" }).click();
    await page.getByRole("button", { name: "Play" }).first().click();
    await eventually(async () => (await page.evaluate(() => window.strut.state)).playing).toBe(false);
  });

  it("shows the ends of states and the curves of joints", async () => {
    await eventually(() => page.locator(".walk-plot").getAttribute("aria-label")).toMatch(
      /^When each state ends: push-off \d\.\d\d s/,
    );
    await page.getByLabel("Plot").selectOption("left_lower_leg");
    await eventually(() => page.locator(".walk-plot").getAttribute("aria-label")).toMatch(/^Left knee, degrees/);
    await eventually(() => page.locator(".walk-band").count()).toBe(1);
  });
});

describe("a paused walk", () => {
  it("keeps the time to which it was moved when the window changes its size", async () => {
    await visit(page, "view=walk&play=0&loop=0&walk=1_1_1~old:1");
    await eventually(title).toBe("One step, one style");
    await page.locator(".walk .editor-head").focus();
    await page.keyboard.press("Home");
    await eventually(secs).toBe(0);
    const width = () => page.locator(".planner").evaluate((plan) => plan.clientWidth);
    for (let i = 1; i <= 6; i++) {
      await page.keyboard.press("ArrowRight");
      await eventually(secs).toBeCloseTo(i / 10, 2);
      const before = await width();
      await page.setViewportSize({ width: i % 2 ? 1300 : 1440, height: 900 });
      await eventually(width).not.toBe(before);
      await drawn(page, 2);
      expect(await secs()).toBeCloseTo(i / 10, 2);
    }
  });
});

describe("what leaves the view", () => {
  it("is a BVH file or a GLB file", async () => {
    await visit(page, `view=walk&play=0&${THREE}`);
    await eventually(title).toBe("16 steps, three styles");
    for (const [name, file] of [
      ["BVH", "walk.bvh"],
      ["GLB", "walk.glb"],
    ] as const) {
      const download = page.waitForEvent("download");
      await page.locator(".walk .editor-actions").getByRole("button", { name, exact: true }).click();
      expect((await download).suggestedFilename()).toBe(file);
    }
  });

  it("has the plan of the moment in which its button is pressed", async () => {
    await visit(page, `view=walk&play=0&${THREE}`);
    await eventually(title).toBe("16 steps, three styles");
    const frames = async (press: () => Promise<void>) => {
      const [download] = await Promise.all([page.waitForEvent("download"), press()]);
      return Number(/^Frames: (\d+)$/m.exec(readFileSync(await download.path(), "utf8"))![1]);
    };
    const save = page.locator(".walk .editor-actions").getByRole("button", { name: "BVH", exact: true });
    const before = await frames(() => save.click());
    // Before the next display frame, in which the plan is drawn.
    const atOnce = await frames(() =>
      save.evaluate((button: HTMLButtonElement) => {
        const press = new KeyboardEvent("keydown", { key: "ArrowRight", bubbles: true, cancelable: true });
        document.querySelector('[data-key="end-2"]')!.dispatchEvent(press);
        button.click();
      }),
    );
    await eventually(title).toBe("17 steps, three styles");
    expect(atOnce).toBeGreaterThan(before);
    expect(atOnce).toBe(await frames(() => save.click()));
  });

  it("is a video of the whole plan, after which the walk is where it was", async () => {
    await visit(page, "view=walk&play=0&loop=0&speed=2&walk=1_1_1~old:1");
    await eventually(title).toBe("One step, one style");
    const length = Number(/[\d.]+/.exec((await page.locator(".walk .editor-time .caption").textContent())!)![0]);
    const video = page.locator(".walk .editor-actions").getByRole("button", { name: "Video", exact: true });
    await eventually(() => video.isEnabled()).toBe(true);
    await page.locator(".walk .editor-head").focus();
    // The walk of the test before may have left it anywhere.
    await page.keyboard.press("Home");
    await eventually(secs).toBe(0);
    await page.keyboard.press("ArrowRight");
    const before = 0.1;
    await eventually(secs).toBe(before);
    const cancel = page.locator(".walk .progress").getByRole("button", { name: "Cancel" });
    await video.click();
    await cancel.click();
    await eventually(secs, "after it was cancelled").toBe(before);
    await video.click();
    const button = (await video.elementHandle())!;
    await cancel.waitFor();
    const [download] = await Promise.all([
      page.waitForEvent("download"),
      // The next one is asked for while the cancelled one is still ending.
      cancel.evaluate((...buttons) => {
        for (const each of buttons) (each as HTMLElement).click();
      }, button),
    ]);
    expect(download.suggestedFilename()).toMatch(/^walk\.(webm|mp4)$/);
    const file = new Input({ source: new BufferSource(readFileSync(await download.path())), formats: ALL_FORMATS });
    const track = (await file.getPrimaryVideoTrack())!;
    expect([track.displayWidth, track.displayHeight]).toEqual([1920, 1080]);
    expect(await file.computeDuration()).toBeCloseTo(length / 2, 1);
    await eventually(secs).toBe(before);
  });

  it("becomes the input of Play", async () => {
    await visit(page, `view=walk&play=0&${THREE}`);
    await eventually(title).toBe("16 steps, three styles");
    await page.getByRole("button", { name: "Style in Play" }).click();
    await eventually(async () => (await state()).view).toBe("play");
    await eventually(async () => (await state()).input).toBe("walk");
    await eventually(() => page.locator(".stage .stage-title").textContent()).toMatch(/^Walk/);
  });
});

describe("the picture", () => {
  it("is a strip of steps where that is chosen", async () => {
    await visit(page, `view=walk&play=0&block=1&${THREE}`);
    await eventually(title).toBe("16 steps, three styles");
    await page.locator(".walk .editor-head").focus();
    await page.keyboard.press("Home");
    for (let i = 0; i < 25; i++) await page.keyboard.press("ArrowRight");
    await eventually(secs).toBe(2.5);
    await page.locator(".walk-form label").filter({ hasText: "Strip" }).click();
    await eventually(() => page.locator(".walk-strip-captions .present").textContent()).toBe("step 5to proud");
    await eventually(faults).toEqual([]);
    await showTheme(page, "light");
    await eventually(faults).toEqual([]);
    await page.locator(".walk-form label").filter({ hasText: "3D" }).click();
    await eventually(() => page.locator(".walk-strip").isVisible()).toBe(false);
    await eventually(faults).toEqual([]);
  });

  it("has everything on a narrow screen as well", () => expectFitsNarrow(page, ".walk .editor-foot button"));
});
