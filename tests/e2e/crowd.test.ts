/** The Crowd view: walkers whose styles vary over the ground. */
import { readFileSync } from "node:fs";
import type { Page } from "playwright-core";
import { beforeAll, describe, expect, it } from "vitest";
import type { StrutHook } from "../../web/app/shell/hook";
import type { FieldVertex } from "../../web/client/crowd/limits";
import { walksIn } from "../clips";
import { databaseOf } from "../database_of";
import { axeFaults } from "./axe";
import { drag, dragHolding, dropFile, eventually, middleOf, openSite, screenshot, visit } from "./browser";
import { lastContext } from "./graphics";
import { expectFitsNarrow } from "./narrow";
import { showTheme } from "./rest";

declare const window: { strut: StrutHook };

/** A small crowd, which software draws fast enough. */
const FEW = "view=crowd&crowd=24_1";
const FIELD = "field=proud_-3_3_3_1;old_4_1_3_1";

let page: Page;

beforeAll(async () => {
  const opened = await openSite({ whole: true, size: { width: 1440, height: 900 }, theme: "dark", notesStay: true });
  page = opened.page;
  return opened.close;
});

const state = () => page.evaluate(() => window.strut.state);
const title = () => page.locator(".crowd .stage-title").textContent();
const alerts = () => page.getByRole("alert").textContent();
const secs = async () => Number(await page.locator(".crowd .clock").textContent());
const handle = (style: string) => page.locator(`.crowd-handle[data-style="${style}"]`);
const field = async () => (await state()).field as readonly FieldVertex[];
const chart = () => page.locator(".crowd-chart canvas").getAttribute("aria-label");
const faults = () => axeFaults(page);
const crowdWorkers = () => page.workers().filter((worker) => worker.url().includes("crowd_worker"));
/** Waits until the crowd walks. */
async function walking(): Promise<void> {
  const before = await secs();
  await eventually(secs).toBeGreaterThan(before);
}
/** Returns the number of walkers in a style, from the chart. */
const walkIn = async (style: string) => Number(new RegExp(`${style} (\\d+)`).exec((await chart())!)?.[1] ?? 0);

describe("a first visit", () => {
  it("shows a hundred people in three ways of walking, where software draws", async () => {
    await page.getByRole("link", { name: "Crowd", exact: true }).click();
    await eventually(title).toBe("One hundred people, three ways of walking");
    await walking();
    await eventually(() => page.locator(".crowd-row").count()).toBe(3);
    await eventually(() => page.locator(".crowd-people-limit").textContent()).toBe("Without a GPU, at most 100 walk.");
    expect((await state()).crowd).toEqual({ count: 200, seed: 1 });
    await eventually(async () => (await walkIn("proud")) + (await walkIn("old"))).toBeGreaterThan(3);
    expect(await alerts()).toBe("");
  });

  it("draws them", async () => {
    const colours = await page.evaluate(async () => {
      const canvas = document.querySelector<HTMLCanvasElement>(".crowd canvas")!;
      const copy = document.createElement("canvas").getContext("2d")!;
      await new Promise(requestAnimationFrame);
      copy.drawImage(canvas, 0, 0);
      return canvas.getAttribute("aria-label");
    });
    expect(colours).toMatch(/^100 mannequins walk on open ground\. Their styles .*: proud, old, childlike\.$/);
    await eventually(() => page.locator(".crowd-figures").textContent()).toMatch(/\d fps.*ms per tick.*ms per frame/);
  });

  it("is accessible in both themes, and holds everything without scrolling", async () => {
    await visit(page, `${FEW}&play=0&who=3`);
    await page.locator(".crowd-card").waitFor();
    for (const theme of ["dark", "light"] as const) {
      await showTheme(page, theme);
      await eventually(faults, theme).toEqual([]);
      await screenshot(page, `crowd-${theme}`);
    }
    await showTheme(page, "dark");
    const overflow = (selector: string) =>
      page.locator(selector).evaluate((e) => Math.max(e.scrollHeight - e.clientHeight, e.scrollWidth - e.clientWidth));
    for (const selector of [".crowd", ".crowd-panel", ".crowd-foot"])
      await eventually(() => overflow(selector), selector).toBeLessThanOrEqual(0);
  });
});

describe("the field", () => {
  it("changes whoever a dragged place reaches", async () => {
    await visit(page, `${FEW}&field=proud_60_60_2_1`);
    await eventually(title).toBe("24 people, one style");
    await walking();
    await eventually(() => walkIn("average")).toBe(24);
    await visit(page, `${FEW}&seen=above&field=proud_4_4_10_1`);
    const before = (await field())[0]!;
    const from = await middleOf(handle("proud"));
    await dragHolding(page, from, { x: from.x - 120, y: from.y - 100 });
    await eventually(async () => (await field())[0]!.x).toBeLessThan(before.x - 1);
    await eventually(() => walkIn("proud")).toBeGreaterThan(12);
    await page.mouse.up();
    const moved = (await field())[0]!;
    expect(moved.z).toBeLessThan(before.z - 1);
    // One drag is one undo step.
    await page.keyboard.press("Control+z");
    await eventually(field).toEqual([before]);
    await page.keyboard.press("Control+Shift+z");
    await eventually(field).toEqual([moved]);
  });

  it("is edited by keys and by the wheel", async () => {
    await visit(page, `${FEW}&${FIELD}`);
    await eventually(() => page.locator(".crowd-handle").count()).toBe(2);
    await handle("proud").focus();
    await page.keyboard.press("ArrowRight");
    await page.keyboard.press("ArrowUp");
    await page.keyboard.press("+");
    await eventually(field).toMatchObject([{ x: -2.75, z: 2.75, reach: 3.2 }, { style: "old" }]);
    const { x, y } = await middleOf(handle("old"));
    await page.mouse.move(x, y);
    await page.mouse.wheel(0, -100);
    await eventually(async () => (await field())[1]!.reach).toBeGreaterThan(3);
    await handle("proud").focus();
    await page.keyboard.press("Delete");
    await eventually(field).toMatchObject([{ style: "old" }]);
    await page.getByLabel("Style to add").selectOption("angry");
    await eventually(field).toMatchObject([{ style: "old" }, { style: "angry" }]);
    await eventually(() => page.locator(".crowd-row[aria-pressed=true]").textContent()).toMatch(/^angry/);
    await page.getByRole("slider", { name: "Reach" }).focus();
    await page.keyboard.press("Home");
    await eventually(async () => (await field())[1]!.reach).toBe(0.5);
    await page.getByRole("button", { name: "Reset" }).click();
    await eventually(async () => (await field()).length).toBe(3);
  });

  it("is not drawn where that is switched off", async () => {
    await page.getByRole("button", { name: "Field", exact: true }).click();
    await eventually(() => page.locator(".crowd-handle").count()).toBe(0);
    await page.getByRole("button", { name: "Field", exact: true }).click();
    await eventually(() => page.locator(".crowd-handle").count()).toBe(3);
  });
});

describe("one of them", () => {
  it("has a card, is followed, and leaves as a BVH file", async () => {
    await visit(page, `${FEW}&${FIELD}`);
    await walking();
    await page.locator(".crowd canvas").first().focus();
    await page.keyboard.press("n");
    const card = page.locator(".crowd-card");
    await eventually(() => card.textContent()).toMatch(/^Walker 1\d\.\d\d m\/sproud0\.\d\dold0\.\d\daverage0\.\d\d/);
    await card.getByRole("button", { name: "Follow" }).click();
    await eventually(async () => (await state()).crowdFollow).toBe(true);
    const [download] = await Promise.all([
      page.waitForEvent("download"),
      card.getByRole("button", { name: "Export BVH" }).click(),
    ]);
    expect(download.suggestedFilename()).toBe("walker-1.bvh");
    expect(readFileSync(await download.path(), "utf8")).toMatch(/^HIERARCHY[\s\S]*Frames: 300\n/);
    await page.keyboard.press("Escape");
    await eventually(() => card.isVisible()).toBe(false);
  });

  it("is chosen by a click on them", async () => {
    await visit(page, `${FEW}&${FIELD}&seen=above&play=0`);
    await eventually(async () => (await state()).crowdCamera).toBe("above");
    const picture = (await page.locator(".crowd .editor-stage").boundingBox())!;
    const card = page.locator(".crowd-card");
    // One of these points has a walker.
    for (let i = 0; i < 400 && !(await card.isVisible()); i++) {
      const [row, column] = [Math.floor(i / 20), i % 20];
      await page.mouse.click(picture.x + 230 + 30 * column, picture.y + 60 + 28 * row);
    }
    expect(await card.isVisible()).toBe(true);
    expect((await state()).crowdWalker).toBeGreaterThanOrEqual(0);
  });

  it("goes on in the Walk view", async () => {
    await visit(page, `${FEW}&field=proud_0_0_10_1&who=2`);
    const card = page.locator(".crowd-card");
    await eventually(() => card.textContent()).toMatch(/proud0\.[5-9]/);
    await card.getByRole("button", { name: "Open in Walk" }).click();
    await eventually(async () => (await state()).view).toBe("walk");
    await eventually(async () => (await state()).walk[0]!.styles.map(({ name }) => name)).toContain("proud");
  });
});

describe("the people", () => {
  it("are as many as asked for, and others by another seed", async () => {
    await visit(page, FEW);
    await eventually(title).toMatch(/^24 people/);
    await page.getByRole("slider", { name: "Count" }).focus();
    await page.keyboard.press("ArrowRight");
    await eventually(title).toMatch(/^25 people/);
    await page.getByRole("button", { name: "Shuffle" }).click();
    await eventually(async () => ((await state()).crowd as { seed: number }).seed).not.toBe(1);
    await walking();
    await page.getByRole("spinbutton", { name: "Seed" }).fill("7");
    await page.keyboard.press("Enter");
    await eventually(() => page.url()).toContain("crowd=25_7");
  });

  it("are half as many after three slow ticks in a row, which the view says, until others are asked for", async () => {
    // The worker of the crowd before has ended by then: a new crowd gets a new worker.
    await visit(page, "view=play");
    await eventually(() => crowdWorkers().length).toBe(0);
    await visit(page, FEW);
    await walking();
    const [worker] = crowdWorkers();
    // A tick reads the clock at its start and at its end: three ticks appear to take 30 ms longer.
    await worker!.evaluate(() => {
      const now = performance.now.bind(performance);
      let readings = 0;
      performance.now = () => {
        readings = Math.min(6, readings + 1);
        return now() + 30 * readings;
      };
    });
    await eventually(title).toMatch(/^Twelve people/);
    await eventually(() => page.locator(".crowd-people-limit").textContent()).toBe(
      "This device was too slow: now only 12 walk.",
    );
    await eventually(() => page.getByRole("status").filter({ hasText: "now only 12 walk." }).count()).toBe(2);
    await walking();
    await page.getByRole("slider", { name: "Count" }).focus();
    await page.keyboard.press("ArrowRight");
    await eventually(title).toMatch(/^25 people/);
  });

  it("follow a route that is drawn, and stop and step", async () => {
    await visit(page, `${FEW}&seen=above&map=0`);
    await walking();
    await page.getByRole("button", { name: "Draw", exact: true }).click();
    const sheet = (await page.locator(".crowd-sheet").boundingBox())!;
    const at = (x: number, y: number) => ({ x: sheet.x + x * sheet.width, y: sheet.y + y * sheet.height });
    await drag(page, at(0.3, 0.4), at(0.7, 0.6));
    await eventually(async () => ((await state()).route as unknown[]).length).toBeGreaterThan(2);
    await eventually(() => page.getByText("Everyone follows the route.").isVisible()).toBe(true);
    await page.getByRole("button", { name: "Clear" }).click();
    await eventually(async () => (await state()).route).toEqual([]);
    await page.getByRole("button", { name: "Pause" }).click();
    await eventually(async () => (await state()).playing).toBe(false);
    const before = await secs();
    await page.getByRole("button", { name: "Next tick" }).click();
    await eventually(secs).toBeCloseTo(before + 1 / 30, 1);
  });
});

describe("performers", () => {
  const caption = () => page.locator(".crowd .stage-heading .caption").textContent();

  it("perform the input of Play in the styles of their places, and walk again", async () => {
    await visit(page, `${FEW}&${FIELD}`);
    await walking();
    await page.getByRole("radio", { name: "Performers" }).check();
    await eventually(title).toBe("24 people, two styles");
    expect(await caption()).toMatch(/^\d+\.\d s of “neutral walk” from Play, looped$/);
    await walking();
    await eventually(chart).toMatch(/^Performers by style: .*neutral [1-9]/);
    await eventually(() => walkIn("proud")).toBeGreaterThan(0);
    await eventually(() => page.url()).toContain("people=performers");
    expect(await page.locator(".crowd-figures").textContent()).toContain("Performing");
    await page.keyboard.press("Control+z");
    await eventually(title).toBe("24 people, two ways of walking");
    await page.keyboard.press("Control+Shift+z");
    await eventually(title).toBe("24 people, two styles");
    // The title is that of the request; the crowd appears once it is ready.
    await eventually(() => page.locator(".crowd-figures").textContent()).toContain("Performing");
    await eventually(chart).toMatch(/^Performers by style/);
    await walking();
    expect(await alerts()).toBe("");
  });

  it("have a card, leave as a BVH file, and go on in Play", async () => {
    await page.locator(".crowd canvas").first().focus();
    await page.keyboard.press("n");
    const card = page.locator(".crowd-card");
    await eventually(() => card.textContent()).toMatch(/^Performer 1.*m\/sproud0\.\d\dold0\.\d\dneutral0\.\d\d/);
    const [download] = await Promise.all([
      page.waitForEvent("download"),
      card.getByRole("button", { name: "Export BVH" }).click(),
    ]);
    expect(download.suggestedFilename()).toBe("performer-1.bvh");
    await page.keyboard.press(" ");
    await eventually(async () => (await state()).playing).toBe(false);
    const [, proud, elderly] = /proud(\d\.\d\d)old(\d\.\d\d)/.exec((await card.textContent())!)!.map(Number);
    await card.getByRole("button", { name: "Open in Play" }).click();
    await eventually(async () => (await state()).view).toBe("play");
    const { styles, intensity } = await state();
    const weightOf = (style: string) => intensity * (styles.find(({ name }) => name === style)?.weight ?? 0);
    expect(weightOf("proud")).toBeCloseTo(proud!, 1);
    expect(weightOf("old")).toBeCloseTo(elderly!, 1);
  });

  it("need a motion that is long enough, and are as many as can be drawn", async () => {
    await visit(page, `view=crowd&people=performers&crowd=1000_1&${FIELD}&range=0-10`);
    await page.getByText("A crowd cannot perform the motion from Play.").waitFor();
    await page.getByRole("button", { name: "Use walkers" }).click();
    await eventually(title).toBe("One hundred people, two ways of walking");
    await walking();
    await visit(page, `view=crowd&people=performers&crowd=1000_1&${FIELD}`);
    await eventually(title).toBe("One hundred people, two styles");
    await eventually(() => page.locator(".crowd-people-limit").textContent()).toBe(
      "Without a GPU, at most 100 perform.",
    );
    await walking();
  });
});

describe("links", () => {
  it("restore people, field, route and camera", async () => {
    const link = `${FEW}&${FIELD}&route=-5_0;5_0&who=4&seen=along&play=0&map=0`;
    await visit(page, link);
    await eventually(title).toBe("24 people, two ways of walking");
    await eventually(() => page.locator(".crowd-card h2").textContent()).toBe("Walker 5");
    const hash = () => page.evaluate(() => decodeURIComponent(location.hash));
    for (const part of link.split("&")) await eventually(hash).toContain(part);
  });

  it("that cannot be are told, and what was on screen stays", async () => {
    await visit(page, `${FEW}&${FIELD}`);
    await eventually(title).toBe("24 people, two ways of walking");
    const before = await field();
    for (const [bad, sentence] of [
      [`people=dancers&${FEW}&`, /“dancers” is invalid. Expected walkers or performers/],
      ["crowd=0_1&", /“0_1” is invalid. Expected 1 to 1,000 people/],
      ["crowd=1001_1&", /“1001_1” is invalid. Expected 1 to 1,000 people/],
      [`${FEW}&field=${Array(13).fill("proud_1_1_2_1").join(";")}&`, /more than 12 vertices/],
      [`${FEW}&field=proud_NaN_1_2_1&`, /field “proud_NaN_1_2_1” is invalid/],
      [`${FEW}&field=mother_1_1_2_1&`, /no style “mother”; it has .*proud/],
      [`${FEW}&${FIELD}&route=1_1&`, /route “1_1” is invalid/],
    ] as const) {
      await visit(page, `view=crowd&${bad}${bad.includes("field") ? "" : FIELD}`);
      await eventually(alerts, bad).toMatch(sentence);
      await eventually(field, bad).toEqual(before);
      await eventually(title, bad).toBe("24 people, two ways of walking");
      await page.getByRole("alert").getByRole("button").click();
    }
  });
});

describe("what leaves the view", () => {
  it("is a poster, and a video of ten seconds that can be cancelled", async () => {
    await visit(page, `${FEW}&${FIELD}`);
    await walking();
    const [poster] = await Promise.all([
      page.waitForEvent("download"),
      page.getByRole("button", { name: "Poster, PNG" }).click(),
    ]);
    expect(poster.suggestedFilename()).toBe("crowd.png");
    expect([...readFileSync(await poster.path()).subarray(1, 4)]).toEqual([..."PNG"].map((c) => c.charCodeAt(0)));
    await page.getByRole("button", { name: "Video, 10 s" }).click();
    await page.locator(".crowd .progress").getByRole("button", { name: "Cancel" }).click();
    await walking();
    expect(await alerts()).toBe("");
  });
});

describe("a view that is left", () => {
  it("gives back its worker and its graphics context, and gathers the people again", async () => {
    await visit(page, FEW);
    await walking();
    expect(crowdWorkers()).toHaveLength(1);
    const context = await lastContext(page);
    await page.getByRole("link", { name: "Walk", exact: true }).click();
    await eventually(() => crowdWorkers().length).toBe(0);
    await eventually(() => context.evaluate((context) => context.isContextLost())).toBe(true);
    await page.getByRole("link", { name: "Crowd", exact: true }).click();
    await eventually(title).toMatch(/^24 people/);
    await walking();
  });
});

describe("a model of one style", () => {
  it("has everybody walk alike, which the view says", async () => {
    const { neutral } = await walksIn(["neutral"]);
    const file = await databaseOf({ "walk_neutral_1.bvh": neutral });
    await visit(page, "view=play");
    await dropFile(page, "one.strutdb", file);
    const styles = page.locator(".panels .vertex");
    await eventually(() => styles.evaluateAll((all) => all.map((one) => one.getAttribute("data-style")))).toEqual([
      "neutral",
    ]);
    await visit(page, FEW);
    await page.getByText("This model has only one style, so all walkers move alike.").waitFor();
    await walking();
    expect(await page.getByLabel("Style to add").locator("option").allTextContents()).toEqual(["Add style", "neutral"]);
    const [, styled, average] = /neutral (\d+), average (\d+)/.exec((await chart())!)!;
    expect(Number(styled) + Number(average)).toBe(24);
    expect(await alerts()).toBe("");
  });
});

describe("a narrow screen", () => {
  it("has everything as well, by its name", async () => {
    await expectFitsNarrow(page, ".crowd .crowd-foot button");
    for (const name of ["Poster, PNG", "Video, 10 s"])
      expect(await page.getByRole("button", { name }).isVisible(), name).toBe(true);
  });
});
