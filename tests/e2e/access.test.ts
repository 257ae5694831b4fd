/** Accessibility of the controls: large text, forced colours, touch, keyboard and screen readers. */
import type { Browser, Page } from "playwright-core";
import { beforeAll, describe, expect, it } from "vitest";
import type { StrutHook } from "../../web/app/shell/hook";
import { cutOff } from "./access/layout";
import { axeFaults } from "./axe";
import { closePage, dragHolding, eventually, middleOf, openPage, openSite, screenshot, shown, visit } from "./browser";
import { atRest, transitionsEnded } from "./rest";

declare const window: { strut: StrutHook };

const WIDE = { width: 1440, height: 900 };
const STYLES = "play=0&frame=60&styles=proud:0.6,old:0.1,childlike:0.3";

let browser: Browser;
let page: Page;
let url: string;

beforeAll(async () => {
  const opened = await openSite({ size: WIDE, hash: STYLES });
  [browser, page, url] = [opened.browser, opened.page, opened.site.url];
  return opened.close;
});

const weights = () =>
  page.evaluate(() => Object.fromEntries(window.strut.state.styles.map(({ name, weight }) => [name, weight])));
const handleOf = (of: Page) => of.getByRole("slider", { name: "Style", exact: true });
const handle = () => handleOf(page);
/** Waits until the handle has reached the position of a link. */
const handleAtRest = (of = page) => atRest(of, () => middleOf(handleOf(of)));

describe("a drag", () => {
  it("is undone by Escape, while the page's own Escape stays silent", async () => {
    await visit(page, STYLES);
    await handleAtRest();
    const [from, to] = [
      await middleOf(handle()),
      await middleOf(page.locator('.vertex[data-style="old"] .vertex-dot')),
    ];
    await dragHolding(page, from, { x: (from.x + to.x) / 2, y: (from.y + to.y) / 2 });
    await eventually(weights).not.toEqual({ proud: 0.6, old: 0.1, childlike: 0.3 });
    await page.keyboard.press("Escape");
    await eventually(weights).toEqual({ proud: 0.6, old: 0.1, childlike: 0.3 });
    await page.mouse.move(to.x, to.y);
    expect(await weights()).toEqual({ proud: 0.6, old: 0.1, childlike: 0.3 });
    await page.mouse.up();
  });

  it("that Escape cancels leaves nothing to undo", async () => {
    const fresh = await openPage(browser, url, { size: WIDE, hash: `${STYLES}&part=legs` });
    const state = () => fresh.evaluate(() => window.strut.state);
    await handleAtRest(fresh);
    const { x, y } = await middleOf(handleOf(fresh));
    await dragHolding(fresh, { x, y }, { x, y: y + 15 });
    await eventually(async () => (await state()).parts.legs).toBeDefined();
    await fresh.keyboard.press("Escape");
    await fresh.mouse.up();
    await eventually(async () => (await state()).parts, "the legs have no style of their own").toEqual({});
    await eventually(() => fresh.getByRole("button", { name: "Undo", exact: true }).isDisabled()).toBe(true);
    await closePage(fresh);
  });

  it("ends where the pointer is lost", async () => {
    await visit(page, STYLES);
    await handleAtRest();
    const [from, to] = [
      await middleOf(handle()),
      await middleOf(page.locator('.vertex[data-style="old"] .vertex-dot')),
    ];
    await dragHolding(page, from, { x: from.x, y: from.y + 10 });
    await page.locator("svg.polygon").evaluate((polygon) => {
      for (let pointer = 0; pointer < 100; pointer++)
        if (polygon.hasPointerCapture(pointer)) polygon.releasePointerCapture(pointer);
    });
    // The browser reports the loss with the next movement.
    await page.mouse.move(from.x, from.y + 11);
    await eventually(() => page.locator("svg.polygon").getAttribute("class")).not.toContain("dragging");
    const kept = await weights();
    await page.mouse.move(to.x, to.y);
    expect(await weights()).toEqual(kept);
    await page.mouse.up();
  });
});

describe("the weights", () => {
  it("are number fields for keyboards and screen readers", async () => {
    await visit(page, STYLES);
    const group = page.getByRole("group", { name: "Style weights" });
    const field = group.getByRole("textbox", { name: "proud" });
    await eventually(() => group.getByRole("textbox").count()).toBe(3);
    await field.focus();
    // It is visible while it is used.
    const clipPath = () => field.evaluate((e) => getComputedStyle(e.closest(".polygon-weights")!).clipPath);
    await eventually(clipPath).toBe("none");
    await field.fill("0.2");
    await page.keyboard.press("Enter");
    await eventually(weights).toEqual({ proud: 0.2, old: 0.2, childlike: expect.closeTo(0.6) });
    await field.fill("much");
    await page.keyboard.press("Tab");
    await eventually(() => field.inputValue()).toBe("0.20");
    await eventually(() => axeFaults(page)).toEqual([]);
  });
});

describe("the 3-D view", () => {
  it("says that it takes keys, and what is seen", async () => {
    const view = page.locator(".stage canvas");
    expect(await view.getAttribute("role")).toBe("application");
    expect(await view.getAttribute("aria-label")).toMatch(/\w/);
    expect(await view.evaluate((e) => (e as HTMLElement).tabIndex)).toBe(0);
  });
});

/** Returns the text size of a drawing, pixels, and its labels that are partly outside. */
const labelsOf = (of: Page, drawing: string) =>
  of
    .locator(drawing)
    .first()
    .evaluate((root) => {
      const frame = root.getBoundingClientRect();
      const labels = [...root.querySelectorAll("text")].filter((label) => label.textContent !== "");
      const outside = labels.filter((label) => {
        const { left, right, top, bottom } = label.getBoundingClientRect();
        return left < frame.left - 1 || right > frame.right + 1 || top < frame.top - 1 || bottom > frame.bottom + 1;
      });
      const [first] = labels;
      const size = Number.parseFloat(getComputedStyle(first!).fontSize) * first!.getScreenCTM()!.a;
      return { size, outside: outside.map((label) => label.textContent) };
    });

describe("text of twice the size", () => {
  it("is nowhere cut off, and all panels can be reached", async () => {
    const context = await browser.newContext({ viewport: WIDE, colorScheme: "dark" });
    const large = await context.newPage();
    const session = await context.newCDPSession(large);
    await session.send("Page.enable");
    await session.send("Page.setFontSizes", { fontSizes: { standard: 32, fixed: 26 } });
    await large.goto(`${url}#${STYLES}`);
    await shown(large);
    await large.waitForFunction(() => window.strut.analysed);
    expect(await large.evaluate(() => getComputedStyle(document.querySelector(".label")!).fontSize)).toMatch(
      /^2[4-8]px$/,
    );
    for (const tab of ["style", "input", "model", "curves"]) {
      await visit(large, `${STYLES}&tab=${tab}`);
      await eventually(() => cutOff(large), tab).toEqual([]);
      const wide = () => large.evaluate(() => document.documentElement.scrollWidth - innerWidth);
      await eventually(wide, tab).toBeLessThanOrEqual(0);
    }
    await eventually(() => axeFaults(large)).toEqual([]);
    await screenshot(large, "large-text");
    for (const [view, drawing] of [
      ["walk", ".planner"],
      ["walk", ".walk-plot"],
      ["key-style", ".pad-plot"],
      ["key-style", ".keys-plot"],
    ] as const) {
      const hash = `view=${view}&play=0`;
      await visit(large, hash);
      await visit(page, hash);
      await large.locator(`${drawing} text`).first().waitFor({ state: "visible" });
      await page.locator(`${drawing} text`).first().waitFor({ state: "visible" });
      const growth = async () => (await labelsOf(large, drawing)).size / (await labelsOf(page, drawing)).size;
      await eventually(growth, drawing).toBeCloseTo(2, 5);
      await eventually(async () => (await labelsOf(large, drawing)).outside, drawing).toEqual([]);
      await screenshot(large, `large-text-${view}`);
    }
    await context.close();
  });
});

describe("forced colours", () => {
  it("keep what is on apart from what is off, and sliders visible", async () => {
    await visit(page, `${STYLES}&ghost=off`);
    await page.emulateMedia({ forcedColors: "active" });
    const look = (name: string) =>
      page.getByRole("button", { name, exact: true }).evaluate((e) => getComputedStyle(e).backgroundColor);
    const slider = page.getByRole("slider", { name: "Intensity" });
    await eventually(() => slider.evaluate((e) => getComputedStyle(e).appearance)).toBe("auto");
    await transitionsEnded(page);
    expect(await look("Follow")).not.toBe(await look("Ghost"));
    const [outline, panel] = await page.evaluate(() => {
      const of = (selector: string) => getComputedStyle(document.querySelector(selector)!);
      return [of(".polygon-outline").stroke, of("#app").backgroundColor];
    });
    expect(outline).not.toBe(panel);
    await screenshot(page, "forced-colours");
    await page.emulateMedia({ forcedColors: "none" });
  });

  it("are taken by the timeline while it is shown, and given back", async () => {
    await visit(page, STYLES);
    await page.waitForFunction(() => window.strut.analysed && window.strut.upToDate);
    const drawing = () =>
      page
        .locator(".timeline-layer")
        .first()
        .evaluate((canvas: HTMLCanvasElement) => canvas.toDataURL());
    const before = await drawing();
    await page.emulateMedia({ forcedColors: "active" });
    await eventually(drawing).not.toBe(before);
    await page.emulateMedia({ forcedColors: "none" });
    await eventually(drawing).toBe(before);
  });
});

describe("a finger", () => {
  /** Controls that a finger tip of 24 px misses: the element at their edges is neither the control nor its label. */
  const missed = () =>
    page.evaluate(() =>
      [...document.querySelectorAll<HTMLElement>("#app :is(button, select, input, [role=slider], [role=button])")]
        .filter((e) => e.checkVisibility({ visibilityProperty: true, opacityProperty: true }))
        .filter((e) => !e.closest(".polygon-weights") && !(e as HTMLButtonElement).disabled)
        .flatMap((e) => {
          // A corner of the polygon has a label next to its target.
          const { left, right, top, bottom } = (e.querySelector(".vertex-target") ?? e).getBoundingClientRect();
          const [x, y] = [(left + right) / 2, (top + bottom) / 2];
          const panel = e.closest(".panels")?.getBoundingClientRect();
          if (x < 12 || y < 12 || x > innerWidth - 12 || y > (panel?.bottom ?? innerHeight) - 12) return [];
          // A label also belongs to its control's target, and a knob's dial to its number's.
          const target = e.closest("label, .toggle-row, .knob") ?? e;
          const hits = (dx: number, dy: number) => target.contains(document.elementFromPoint(x + dx, y + dy));
          const all = [hits(0, 0), hits(-11, 0), hits(11, 0), hits(0, -11), hits(0, 11)];
          return all.every(Boolean) ? [] : [`${e.getAttribute("aria-label") ?? e.textContent}`];
        }),
    );

  it("finds targets of 24 px at least on a narrow screen", async () => {
    await page.setViewportSize({ width: 390, height: 844 });
    // A weight field covers a corner while it has the focus.
    await page.evaluate(() => (document.activeElement as HTMLElement | null)?.blur());
    for (const tab of ["style", "input", "model", "curves"]) {
      await visit(page, `${STYLES}&tab=${tab}`);
      await eventually(missed, tab).toEqual([]);
    }
  });
});
