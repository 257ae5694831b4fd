/** The lesson about one line: solved with only the keyboard, and its figures on a narrow screen. */
import type { Page } from "playwright-core";
import { beforeAll, expect, it } from "vitest";
import type { StrutHook } from "../../web/app/shell/hook";
import { axeFaults } from "./axe";
import { eventually, openSite, screenshot, visit } from "./browser";
import { expectFitsNarrow } from "./narrow";
import { transitionsEnded } from "./rest";

declare const window: { strut: StrutHook };

let page: Page;
beforeAll(async () => {
  const opened = await openSite({
    hash: "view=learn&lesson=line&beat=4",
    size: { width: 1440, height: 900 },
    theme: "dark",
  });
  page = opened.page;
  return opened.close;
});

const verdict = (exercise: string) => page.locator(`[data-exercise="${exercise}"] .verdict`).textContent();
const faults = async () => {
  await transitionsEnded(page);
  return axeFaults(page);
};

/** Presses Tab until an element with this name has the focus. */
async function tabTo(name: string): Promise<void> {
  for (let presses = 0; presses < 80; presses++) {
    await page.keyboard.press("Tab");
    const focused = await page.evaluate(() => {
      let element = document.activeElement;
      while (element?.shadowRoot?.activeElement) element = element.shadowRoot.activeElement;
      return element?.getAttribute("aria-label") ?? element?.textContent ?? "";
    });
    if (focused === name) return;
  }
  throw new Error(`Tab does not lead to '${name}'.`);
}

it("is solved by the keyboard alone, and refuses what it is about", async () => {
  await page.locator('[data-exercise="B"]').waitFor();
  await page.locator('[data-exercise="B"]').getByRole("button", { name: "Begin" }).focus();
  await page.keyboard.press("Enter");
  await tabTo("Ridge λ");
  await page.keyboard.type("5");
  await page.keyboard.press("Enter");
  await eventually(() => verdict("B")).toMatch(/^✗ ?Only the mean is left: λ 5\.0000/);
  await page.keyboard.press("Escape");
  await page.keyboard.type("0.9");
  await page.keyboard.press("Enter");
  await eventually(() => verdict("B")).toMatch(/^✓ ?Yes: at λ 0\.9000 the prediction is −0\.\d\d° from the mean\./);
  expect(await faults()).toEqual([]);
  await screenshot(page, "learn-line-solved");
});

it("shows the sweep once exercise A is solved, and its handle turns the ridge", async () => {
  const sweep = page.locator('strut-figure[data-name="sweep"]');
  await visit(page, "view=learn&lesson=line&beat=5&K=12&nu=4&taper=0&ridge=0.02&theme=light");
  await page.locator('strut-figure[data-name="scatter"]').waitFor();
  expect(await sweep.isVisible(), "it would give the answer away").toBe(false);
  await visit(page, "view=learn&lesson=line&beat=4&theme=light");
  await page.locator('[data-exercise="A"]').getByRole("button", { name: "Begin" }).press("Enter");
  await tabTo("Ridge λ");
  await page.keyboard.type("0.009");
  await page.keyboard.press("Enter");
  await eventually(() => verdict("A")).toMatch(/^✓ ?Yes: λ 0\.0090 gives 1\.50°/);
  const handle = sweep.getByRole("slider", { name: "Ridge λ" });
  await eventually(() => handle.getAttribute("aria-valuetext")).toMatch(/^At λ 0\.0090 .* 1\.50°; the least is 1\.50°/);
  await handle.focus();
  await page.keyboard.press("End");
  await eventually(() => page.evaluate(() => window.strut.state.figures)).toContain("ridge=10");
  await eventually(() => handle.getAttribute("aria-valuetext")).toMatch(/^At λ 10\.0000 .* 1\.64°/);
  expect(await faults()).toEqual([]);
  await screenshot(page, "learn-line-sweep");
});

it("is reached from the lesson before, and from the list", async () => {
  await visit(page, "view=learn&lesson=near&beat=5&theme=light");
  const title = () => page.locator("h1.learn-title").textContent();
  await eventually(title).toBe("Know what the distance ignores");
  await page.getByRole("button", { name: "Say what K, λ and β do to one prediction" }).click();
  await eventually(title).toBe("Say what K, λ and β do to one prediction");
  await eventually(() => page.locator(".learn-part:not([hidden])").getAttribute("data-beat")).toBe("idea");
  await page.getByRole("combobox", { name: "Lesson" }).selectOption({ value: "style" });
  await eventually(title).toBe("Tell content from style");
});

it("fits a narrow screen", async () => {
  await visit(page, "view=learn&lesson=line&beat=2&theme=light");
  await eventually(() => page.locator('.symbol[data-term="c"] .value').textContent()).toMatch(/^0\.\d\d$/);
  await expectFitsNarrow(page, "strut-figure:not([hidden]) .head select, .learn-steps button, .symbol");
  await screenshot(page, "learn-line-narrow");
});
