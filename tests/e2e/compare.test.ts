/** The Compare view: one instant with several methods. */
import type { Page } from "playwright-core";
import { beforeAll, describe, expect, it } from "vitest";
import type { StrutHook } from "../../web/app/shell/hook";
import { axeFaults } from "./axe";
import { drawn, eventually, openSite, screenshot, visit } from "./browser";
import { transitionsEnded } from "./rest";

declare const window: { strut: StrutHook };

const COMPARED = "view=compare&play=0&frame=160&styles=old:1,proud:0,childlike:0";

let page: Page;

beforeAll(async () => {
  const opened = await openSite({ hash: COMPARED, size: { width: 1440, height: 900 }, theme: "light" });
  page = opened.page;
  return opened.close;
});

const state = () => page.evaluate(() => window.strut.state);
const columns = () => page.getByLabel(/^Column \d$/);
/** Returns the displayed value of a row in a column. */
const figure = (column: string, row: string) =>
  page.locator(`.compare-table[data-column="${column}"] > div`).filter({ hasText: row }).locator("dd").textContent();

const faults = () => axeFaults(page);

describe("the columns", () => {
  it("show the input and three methods with live figures, and what differs behind", async () => {
    await eventually(() => page.locator(".compare-clock").textContent(), "the link's instant").toBe("02.67");
    await eventually(() => figure("nn", "Cost per frame")).toMatch(/^\d\.\d\d ms$/);
    await eventually(() => figure("mar", "Foot skate")).toMatch(/^\d+\.\d cm\/s$/);
    await eventually(() => figure("input", "Pose error")).toMatch(/^\d+\.\d cm$/);
    // The old style is far from the input; Strut's output is nearest to the real performance.
    const number = async (column: string) => Number((await figure(column, "Pose error"))!.split(" ")[0]);
    expect(await number("input")).toBeGreaterThan(5);
    expect(await number("nn")).toBeLessThan(await number("input"));
    expect(await number("mar")).toBeLessThan(await number("nn"));
    const late = async (column: string) =>
      Math.abs(Number((await figure(column, "Timing error"))!.replace("−", "-").split(" ")[0]));
    expect(await late("mar")).toBeLessThan(await late("input"));
    await eventually(() => page.locator(".compare-summary").textContent()).toMatch(/the counterpart.*synthetic/);
    await eventually(() => page.getByRole("heading", { level: 1, name: /four ways/ }).isVisible()).toBe(true);
    await eventually(faults).toEqual([]);
    await drawn(page, 5);
    await screenshot(page, "compare-light");
  });

  it("are added, changed and removed, and are in the link", async () => {
    await page.getByRole("button", { name: "Add a method", exact: true }).click();
    await eventually(async () => (await state()).columns).toEqual(["input", "nn", "lar", "mar", "knn"]);
    await eventually(() => page.getByRole("button", { name: "Add a method", exact: true }).isDisabled()).toBe(true);
    await columns().nth(4).selectOption("b");
    await page.getByRole("button", { name: "Remove Nearest neighbour" }).click();
    await eventually(() => page.url()).toContain("columns=input,lar,mar,b");
    await page.keyboard.press("Control+z");
    await eventually(async () => (await state()).columns).toHaveLength(5);
    await page.keyboard.press("Control+Shift+z");
  });

  it("may be methods that are trained beforehand, and the counterpart itself", async () => {
    for (const [column, title] of [
      ["gar", "Global regression"],
      ["lti", "Linear system"],
      ["gp", "Gaussian process"],
      ["real", "Counterpart"],
    ] as const) {
      await columns().last().selectOption(column);
      await eventually(() => figure(column, "Foot skate"), title).toMatch(/^\d+\.\d cm\/s$/);
    }
    expect(await figure("real", "Pose error"), "nothing to compare with itself").toBe("–");
    await eventually(() => figure("mar", "Cost per frame")).toMatch(/ms$/);
    await screenshot(page, "compare-real");
  });

  it("say so where there is no counterpart, and compare with another then", async () => {
    await visit(page, `${COMPARED}&columns=input,lar,mar&parts=legs~proud:1`);
    await eventually(() => page.locator(".compare-summary").textContent()).toContain(
      "available only for built-in inputs",
    );
    await page.getByLabel("Reference").selectOption("mar");
    await eventually(() => figure("lar", "Pose difference")).toMatch(/cm$/);
    await visit(page, `${COMPARED}&columns=input,lar,mar`);
    await eventually(() => figure("lar", "Pose error")).toMatch(/cm$/);
  });

  it("change with the style", async () => {
    const before = await figure("input", "Pose error");
    await page.getByRole("combobox", { name: "Style", exact: true }).selectOption("depressed");
    await eventually(() => figure("input", "Pose error")).not.toBe(before);
    await eventually(() => page.locator(".compare-summary").textContent()).toMatch(/depressed out/);
  });
});

describe("the search", () => {
  const search = () => page.getByRole("combobox", { name: "Search", exact: true });
  /** Returns the displayed values of a row: recall, milliseconds. */
  const found = async (name: string): Promise<[recall: number, ms: number]> => {
    const row = page.locator(".compare-search-figures > div").filter({ hasText: name });
    const [recall, ms] = await row.locator("dd").allTextContents();
    return [Number(/^recall@40 ([01]\.\d{3})$/.exec(recall!)![1]), Number(/^(\d+\.\d\d) ms a frame$/.exec(ms!)![1])];
  };
  const figures = () => page.getByLabel("Recall and time of the searches");

  it("is exact, and then there is nothing to compare", async () => {
    await visit(page, COMPARED);
    await eventually(() => search().inputValue()).toBe("exact");
    expect(await figures().isVisible()).toBe(false);
  });

  it("by kd-trees is shown beside the exact one, over the whole clip: more candidates find more and take longer", async () => {
    const recalls: number[] = [];
    const times: number[] = [];
    for (const candidates of [40, 160, 640]) {
      await search().selectOption(`kd-tree, ${candidates} candidates`);
      await eventually(() => page.url()).toContain(`search=kdtree:${candidates}`);
      await eventually(() => figures().isVisible(), "figures of these candidates").toBe(true);
      expect((await found("Exact"))[0]).toBe(1);
      const [recall, ms] = await found("kd-tree");
      recalls.push(recall);
      times.push(ms);
      if (candidates === 160) await screenshot(page, "compare-search");
    }
    expect(recalls[0]).toBeLessThan(0.95);
    expect(recalls).toEqual(recalls.toSorted());
    expect(times[2]).toBeGreaterThan(times[0]!);
    await eventually(faults).toEqual([]);
  });

  it("is a choice that is taken back, and that keys make", async () => {
    await page.mouse.click(700, 400);
    await page.keyboard.press("Control+z");
    await eventually(() => search().inputValue()).toBe("kdtree:160");
    await search().focus();
    await page.keyboard.press("Home");
    await eventually(async () => (await state()).search).toBe("exact");
    await eventually(() => figures().isVisible()).toBe(false);
  });
});

describe("the clock", () => {
  it("plays, steps and scrubs all columns at once", async () => {
    const time = () => page.locator(".compare-clock").textContent();
    const at = await time();
    await page.mouse.click(700, 400);
    await page.evaluate(() => (document.activeElement as HTMLElement).blur());
    await page.keyboard.press("ArrowRight");
    await eventually(time).not.toBe(at);
    await page.keyboard.press("Space");
    const started = await time();
    await eventually(time).not.toBe(started);
    await page.keyboard.press("Space");
    await eventually(async () => (await state()).playing).toBe(false);
    await page.locator(".compare-transport input[type=range]").fill("300");
    await eventually(time).toBe("05.00");
  });

  it("goes where a link says", async () => {
    await visit(page, COMPARED.replace("160", "60"));
    await eventually(() => page.locator(".compare-clock").textContent()).toBe("01.00");
    await page.keyboard.press("Space");
    await eventually(async () => (await state()).playing).toBe(true);
    await visit(page, "play=0&frame=90");
    await page.waitForFunction(() => window.strut.upToDate && window.strut.state.view === "play");
    await eventually(() => page.evaluate(() => window.strut.frame!.inputFrame)).toBe(90);
    await visit(page, COMPARED.replace("160", "300"));
    await eventually(() => page.locator(".compare-clock").textContent()).toBe("05.00");
  });

  it("gives the picture back to Play", async () => {
    await page.getByRole("link", { name: "Play" }).click();
    await eventually(() => page.locator(".stage canvas").isVisible()).toBe(true);
    await page.waitForFunction(() => window.strut.upToDate);
    await eventually(() => page.evaluate(() => window.strut.frame!.inputFrame), "at the same instant").toBe(300);
  });
});

describe("a narrow screen", () => {
  it("scrolls the columns sideways and nothing else", async () => {
    await page.setViewportSize({ width: 390, height: 844 });
    await page.evaluate(() => {
      location.hash = "view=compare&play=0&frame=160&search=kdtree:160";
    });
    await eventually(() => page.locator(".compare-body").isVisible()).toBe(true);
    await eventually(() => page.evaluate(() => document.documentElement.scrollWidth)).toBe(390);
    await eventually(() => page.locator(".compare-search-figures").isVisible()).toBe(true);
    await transitionsEnded(page);
    const first = page.locator(".compare-column-head").first().locator("select");
    await eventually(() => first.inputValue(), "Strut is the first").toBe("mar");
    expect(await page.evaluate(() => window.strut.state.columns[0]), "in the link nothing changes").not.toBe("mar");
    await screenshot(page, "compare-narrow");
    await eventually(faults).toEqual([]);
  });
});
