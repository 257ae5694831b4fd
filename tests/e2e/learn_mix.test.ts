/** The lesson about the mixture: its figures follow the pointer, and a computed weight is checked. */
import type { Page } from "playwright-core";
import { beforeAll, expect, it } from "vitest";
import { axeFaults } from "./axe";
import { eventually, openSite, screenshot, visit } from "./browser";
import { expectFitsNarrow } from "./narrow";
import { transitionsEnded } from "./rest";

let page: Page;
beforeAll(async () => {
  const opened = await openSite({
    hash: "view=learn&lesson=mix&beat=4",
    size: { width: 1440, height: 900 },
    theme: "light",
  });
  page = opened.page;
  return opened.close;
});

const verdict = (exercise: string) => page.locator(`[data-exercise="${exercise}"] .verdict`).textContent();
const begin = (exercise: string) =>
  page.locator(`[data-exercise="${exercise}"]`).getByRole("button", { name: "Begin" }).click();
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
const playhead = () => page.locator('strut-figure[data-name="reading"]').getByRole("slider", { name: "Instant" });

it("is solved by the keyboard alone, and checks when the hand lets go", async () => {
  await page.locator('[data-exercise="A"]').waitFor();
  await page.locator('[data-exercise="A"]').getByRole("button", { name: "Begin" }).focus();
  await page.keyboard.press("Enter");
  await eventually(() => playhead().getAttribute("aria-valuetext")).toMatch(/^At 1\.00 s: run 1\.00\./);
  await tabTo("Instant");
  await page.keyboard.press("Home");
  for (let press = 0; press < 30; press++) await page.keyboard.press("ArrowRight");
  await eventually(() => verdict("A")).toMatch(/^✗ ?Here it has changed already: walking has 1\.00/);
  await page.keyboard.press("Home");
  for (let press = 0; press < 14; press++) await page.keyboard.press("ArrowRight");
  for (let press = 0; press < 5; press++) await page.keyboard.press("Shift+ArrowLeft");
  await eventually(() => verdict("A")).toMatch(/^✓ ?Yes: at 2\.28 s walking has 0\.\d\d and running 0\.\d\d\./);
  await transitionsEnded(page);
  expect(await axeFaults(page)).toEqual([]);
  await screenshot(page, "learn-mix-solved");
});

it("takes the playhead where it is dragged", async () => {
  const plot = (await page.locator('strut-figure[data-name="reading"] .plot').boundingBox())!;
  await page.mouse.move(plot.x + 0.35 * plot.width, plot.y + 0.5 * plot.height);
  await page.mouse.down();
  await page.mouse.up();
  await eventually(() => verdict("A")).toMatch(/^✗ ?Here it has changed already: walking has 1\.00/);
});

it("judges a weight that was computed by hand", async () => {
  await begin("C");
  await eventually(() => page.locator(".bars .asked .name").allTextContents()).toEqual([
    "kick / neutral",
    "jump / neutral",
  ]);
  const guess = page.getByRole("textbox", { name: "Weight of the first of two" });
  await guess.fill("much");
  await guess.press("Enter");
  await guess.fill("0,1");
  await guess.press("Enter");
  await eventually(() => verdict("C")).toMatch(/^✗ ?0\.100 is not the weight for \d+\.\d\d and \d+\.\d\d cm²\./);
});

it("fits a narrow screen, in German", async () => {
  await visit(page, "view=learn&lesson=mix&beat=4&theme=dark&lang=de");
  await eventually(() => page.locator("h1.learn-title").textContent()).toBe("Aus Abständen Gewichte gewinnen");
  await expectFitsNarrow(page, ".learn-text button:visible, .learn-text select:visible");
  await screenshot(page, "learn-mix-narrow");
});
