/** bench.html in Chromium: the benchmark runs, can be cancelled, and gives its report. */
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import { ENGINES, MODES, type Report } from "../../bench/report";
import { eventually, launchBrowser, screenshot, serveSite } from "./browser";
import { expectNoViolation, recordViolations } from "./policy";

let browser: Browser;
let site: Awaited<ReturnType<typeof serveSite>>;
let page: Page;
const faults: string[] = [];

beforeAll(async () => {
  [browser, site] = await Promise.all([launchBrowser(), serveSite()]);
  const context = await browser.newContext({
    viewport: { width: 1440, height: 900 },
    colorScheme: "dark",
    permissions: ["clipboard-read", "clipboard-write"],
  });
  await recordViolations(context);
  page = await context.newPage();
  page.on("pageerror", (error) => faults.push(error.message));
  await page.goto(`${site.url}bench.html`);
});
afterAll(async () => {
  await browser.close();
  await site.close();
});

const measure = () => page.getByRole("button", { name: "Measure" });

test("it is cancelled at once", async () => {
  await measure().click();
  await page.getByText("Making a database").waitFor();
  await page.getByRole("button", { name: "Cancel" }).click();
  await eventually(() => measure().isEnabled()).toBe(true);
  await eventually(() => page.getByRole("progressbar").isVisible()).toBe(false);
});

test("it measures every engine in every mode, and the yardsticks agree with Strut", {
  timeout: 1_800_000,
}, async () => {
  await page.getByLabel("Database").selectOption("4800");
  await measure().click();
  await page.getByRole("progressbar").waitFor();
  await screenshot(page, "bench-running");
  const copy = page.getByRole("button", { name: "Copy as JSON" });
  const failed = page.getByRole("alert").filter({ hasText: /\w/ });
  await copy.or(failed).waitFor({ timeout: 1_790_000 });
  expect(await page.getByRole("alert").textContent()).toBe("");
  await copy.click();
  await page.getByRole("button", { name: "Copied" }).waitFor();
  const report: Report = JSON.parse(await page.evaluate(() => navigator.clipboard.readText()));

  for (const engine of ENGINES)
    for (const mode of MODES)
      for (const stage of ["frame", "search", "regression"]) {
        const row = report.rows.find((r) => r.engine === engine && r.mode === mode && r.stage === stage);
        expect(row, `${engine} ${mode} ${stage}`).toMatchObject({ frames: 4800, classes: 48 });
        // The clock of a page may be too coarse for a stage.
        if (stage === "frame") expect(row!.median_ms).toBeGreaterThan(0);
        expect(row!.p95_ms).toBeGreaterThanOrEqual(row!.median_ms);
      }
  for (const { identical, tied, neighbour_sets } of report.agreement) {
    expect(identical + tied).toBe(neighbour_sets);
    expect(tied).toBeLessThan(0.02 * neighbour_sets);
  }
  const overflow = () => page.evaluate(() => document.documentElement.scrollWidth > innerWidth);
  await screenshot(page, "bench");
  await eventually(overflow).toBe(false);
  await page.setViewportSize({ width: 390, height: 844 });
  await screenshot(page, "bench-narrow");
  await eventually(overflow).toBe(false);
  expect(faults).toEqual([]);
  await expectNoViolation(page);
});
