/** The lesson about the mixture: its figures follow the hand, and a computed weight is judged. */
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
const playhead = () => page.locator('strut-figure[data-name="reading"]').getByRole("slider", { name: "Instant" });

it("takes the playhead where it is dragged, and checks when the hand lets go", async () => {
  await begin("A");
  await eventually(() => playhead().getAttribute("aria-valuetext")).toMatch(/^At 1\.00 s: run 1\.00\./);
  const plot = (await page.locator('strut-figure[data-name="reading"] .plot').boundingBox())!;
  await page.mouse.move(plot.x + 0.35 * plot.width, plot.y + 0.5 * plot.height);
  await page.mouse.down();
  await page.mouse.up();
  await eventually(() => verdict("A")).toMatch(/^✗ ?Here it has changed already: walking has 1\.00/);
  await playhead().focus();
  await page.keyboard.press("Home");
  for (let press = 0; press < 14; press++) await page.keyboard.press("ArrowRight");
  for (let press = 0; press < 5; press++) await page.keyboard.press("Shift+ArrowLeft");
  await eventually(() => verdict("A")).toMatch(/^✓ ?Yes: at 2\.28 s walking has 0\.52 and running 0\.48\./);
  await transitionsEnded(page);
  expect(await axeFaults(page)).toEqual([]);
  await screenshot(page, "learn-mix-solved");
});

it("judges a weight that was computed by hand", async () => {
  await begin("C");
  const guess = page.getByRole("textbox", { name: "Weight of the first of two" });
  await guess.fill("much");
  await guess.press("Enter");
  await guess.fill("0,1");
  await guess.press("Enter");
  await eventually(() => verdict("C")).toMatch(/^✗ ?0\.10 is not the weight for \d+\.\d\d and \d+\.\d\d cm²\./);
});

it("fits a narrow screen, in German", async () => {
  await visit(page, "view=learn&lesson=mix&beat=4&theme=dark&lang=de");
  await eventually(() => page.locator("h1.learn-title").textContent()).toBe("Aus Entfernungen Gewichte gewinnen");
  await expectFitsNarrow(page, ".learn-text button:visible, .learn-text select:visible");
  await screenshot(page, "learn-mix-narrow");
});
