/** The Compare view: one instant, several ways. */
import axe from "axe-core";
import type { Page } from "playwright-core";
import { beforeAll, describe, expect, it } from "vitest";
import type { StrutHook } from "../../web/playground/hook";
import { eventually, openSite, screenshot } from "./browser";

declare const window: { strut: StrutHook; axe: typeof axe };

let page: Page;

beforeAll(async () => {
  const hash = "view=compare&play=0&frame=160&styles=old:1,proud:0,childlike:0";
  const opened = await openSite({ hash, size: { width: 1440, height: 900 }, theme: "light" });
  page = opened.page;
  return opened.close;
});

const state = () => page.evaluate(() => window.strut.state);
const columns = () => page.getByLabel("Column", { exact: true });
/** The figure of a row in a column, as the page writes it. */
const figure = (column: string, row: string) =>
  page.locator(`.compare-table[data-column="${column}"] > div`).filter({ hasText: row }).locator("dd").textContent();

async function faults(): Promise<string[]> {
  await page.addScriptTag({ content: axe.source });
  const { violations } = await page.evaluate(() => window.axe.run());
  return violations.map((v) => `${v.id}: ${v.nodes.map((node) => node.target.join(" ")).join(", ")}`);
}

describe("the columns", () => {
  it("show the input and three methods with live figures, and what differs behind", async () => {
    expect(await page.locator(".compare-clock").textContent(), "the link's instant").toBe("02.67");
    await eventually(() => figure("nn", "Cost per frame")).toMatch(/^\d\.\d\d ms$/);
    await eventually(() => figure("mar", "Foot skate")).toMatch(/^\d+\.\d cm\/s$/);
    await eventually(() => figure("input", "Pose difference")).toMatch(/^\d+\.\d cm$/);
    // The old style is far from the input, the nearest neighbour is nearer to what Strut gives.
    const number = async (column: string) => Number((await figure(column, "Pose difference"))!.split(" ")[0]);
    expect(await number("input")).toBeGreaterThan(5);
    expect(await number("nn")).toBeLessThan(await number("input"));
    expect(await figure("mar", "Pose difference")).toBe("–");
    expect(await page.getByRole("heading", { level: 1, name: /four ways/ }).isVisible()).toBe(true);
    expect(await faults()).toEqual([]);
    await page.waitForTimeout(1500);
    await screenshot(page, "compare-light");
  });

  it("are added, changed and removed, and are in the link", async () => {
    await page.getByRole("button", { name: "Method", exact: true }).click();
    expect((await state()).columns).toEqual(["input", "nn", "lar", "mar", "knn"]);
    expect(await page.getByRole("button", { name: "Method", exact: true }).isDisabled()).toBe(true);
    await columns().nth(4).selectOption("b");
    await page.getByRole("button", { name: "Remove Nearest neighbour" }).click();
    await eventually(() => page.url()).toContain("columns=input,lar,mar,b");
    await page.keyboard.press("Control+z");
    expect((await state()).columns).toHaveLength(5);
    await page.keyboard.press("Control+Shift+z");
  });

  it("change with the style", async () => {
    const before = await figure("input", "Pose difference");
    await page.getByRole("combobox", { name: "Style", exact: true }).selectOption("depressed");
    await eventually(() => figure("input", "Pose difference")).not.toBe(before);
    expect(await page.locator(".compare-summary").textContent()).toMatch(/depressed out/);
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
    expect((await state()).playing).toBe(false);
    await page.locator(".compare-transport input[type=range]").fill("300");
    await eventually(time).toBe("05.00");
  });

  it("gives the picture back to Play", async () => {
    await page.getByRole("link", { name: "Play" }).click();
    await eventually(() => page.locator(".stage canvas").isVisible()).toBe(true);
    await page.waitForFunction(() => window.strut.upToDate);
    expect(await page.evaluate(() => window.strut.frame!.inputFrame), "at the same instant").toBe(300);
  });
});

describe("a narrow screen", () => {
  it("scrolls the columns sideways and nothing else", async () => {
    await page.setViewportSize({ width: 390, height: 844 });
    await page.evaluate(() => {
      location.hash = "view=compare&play=0&frame=160";
    });
    await eventually(() => page.locator(".compare-body").isVisible()).toBe(true);
    const width = await page.evaluate(() => document.documentElement.scrollWidth);
    expect(width).toBe(390);
    await page.waitForTimeout(1500);
    await screenshot(page, "compare-narrow");
    expect(await faults()).toEqual([]);
  });
});
