/** bench.html in Chromium: the benchmark runs, can be cancelled, and shows its report, also of a GPU. */
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import { ENGINES, MODES, type Report } from "../../bench/report";
import { eventually, launchBrowser, screenshot, serveSite } from "./browser";
import { SWIFTSHADER } from "./graphics";
import { expectNoViolation, recordViolations } from "./policy";

let browser: Browser;
let site: Awaited<ReturnType<typeof serveSite>>;
let page: Page;
const faults: string[] = [];

beforeAll(async () => {
  // Chromium's software GPU.
  const args = [...SWIFTSHADER.args, "--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader"];
  [browser, site] = await Promise.all([launchBrowser({ graphics: { ...SWIFTSHADER, args } }), serveSite()]);
  const context = await browser.newContext({
    viewport: { width: 1440, height: 900 },
    colorScheme: "dark",
    permissions: ["clipboard-read", "clipboard-write"],
  });
  await recordViolations(context);
  page = await context.newPage();
  page.on("pageerror", (error) => faults.push(error.message));
  await page.goto(`${site.url}bench.html?gpu=any&motions=2`);
});
afterAll(async () => {
  await browser.close();
  await site.close();
});

/** Returns the box of the GPU. */
const box = (of: Page) => of.getByRole("region", { name: "Graphics card" });
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

  // Times of a software GPU are not meaningful: it must only find the same neighbours.
  expect(report.gpu).toMatchObject({ software: true, backend: "WebGPU", frames: 4800, classes: 48, sets: 64 * 48 });
  expect(report.gpu!.identical).toBe(report.gpu!.sets);
  expect(report.gpu!.candidates_per_neighbour).toBeLessThan(1.2);
  expect(report.gpu!.adapter).toMatch(/swiftshader/i);
  expect(report.rows.filter(({ engine, mode }) => engine === "gpu-brute" || mode === "batch")).toEqual([]);
  await eventually(() => box(page).textContent()).toContain(
    "3,072 of 3,072 sets of neighbours are bit-identical to Strut's",
  );

  const overflow = () => page.evaluate(() => document.documentElement.scrollWidth > innerWidth);
  await screenshot(page, "bench");
  await eventually(overflow).toBe(false);
  await page.setViewportSize({ width: 390, height: 844 });
  await screenshot(page, "bench-narrow");
  await eventually(overflow).toBe(false);
  expect(faults).toEqual([]);
  await expectNoViolation(page);
});

test("where a page has no graphics processor, or a program plays it, a sentence says so before anything is measured", async () => {
  const says = async (of: Page, sentence: RegExp) => {
    const loaded: string[] = [];
    of.on("request", (request) => loaded.push(request.url()));
    await of.goto(`${site.url}bench.html`);
    await eventually(() => box(of).textContent()).toMatch(sentence);
    expect(await box(of).textContent()).toContain("press “Copy as JSON”");
    expect(loaded.filter((url) => url.includes("gpu"))).toEqual([]);
    await of.context().close();
  };
  await says(await (await browser.newContext()).newPage(), /emulates a GPU in software/);
  const without = await (await browser.newContext()).newPage();
  await without.addInitScript(() => Object.defineProperty(navigator, "gpu", { value: undefined }));
  await says(without, /has no GPU for pages, so only the CPU is measured/);
});
