// node bench/card.mjs [--json FILE] [--shots FOLDER] [--db DB] [--yardstick] [--software]: measures the built site with
// a GPU, in Chromium without a window: frame rates of a crowd and of the Play view, the time of the atlas (with the
// built-in motions, and with a database) and whether the CPU draws the same, Lighthouse's results, and with --yardstick
// those of bench.html. --software uses a software GPU, to test the script without a GPU. Needs a GPU with a Vulkan
// driver; CHROME_PATH selects another Chromium.
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { basename, join } from "node:path";
import { parseArgs } from "node:util";
import lighthouse from "lighthouse";
import { chromium } from "playwright-core";
import { root } from "../scripts/steps.mjs";
import { serveCompressed } from "./hosted_site.mjs";

/** Makes Chromium draw without a display, with Vulkan, and expose its GPU to WebGPU. */
const CARD = [
  "--use-angle=vulkan",
  "--enable-features=Vulkan",
  "--disable-vulkan-surface",
  "--ignore-gpu-blocklist",
  "--enable-unsafe-webgpu",
];
const SOFTWARE = [
  "--use-angle=swiftshader",
  "--enable-unsafe-swiftshader",
  "--enable-unsafe-webgpu",
  "--use-webgpu-adapter=swiftshader",
];
/** Without these flags the frame rate is at most 60 Hz. */
const UNLIMITED = ["--disable-frame-rate-limit", "--disable-gpu-vsync"];
/** Time in which the stage adapts its quality, and time in which frames are counted, milliseconds. */
const [SETTLING_MS, COUNTING_MS] = [5000, 6000];
const VIEWPORT = { width: 1440, height: 900 };
/** Number of Lighthouse visits. */
const VISITS = 3;
/** Number of frames of the procedural benchmark database: that of the paper. */
const FRAMES = 79_829;
const YARDSTICK_MS = 400_000;

const { values } = parseArgs({
  options: {
    json: { type: "string" },
    shots: { type: "string" },
    db: { type: "string" },
    yardstick: { type: "boolean", default: false },
    software: { type: "boolean", default: false },
  },
});
if (values.shots) mkdirSync(values.shots, { recursive: true });

const launch = (flags = []) =>
  chromium.launch({
    executablePath: process.env.CHROME_PATH ?? "/usr/bin/chromium",
    args: ["--no-sandbox", "--disable-background-networking", ...(values.software ? SOFTWARE : CARD), ...flags],
  });

const median = (numbers) => numbers.toSorted((a, b) => a - b)[numbers.length >> 1];
const shot = (page, name) => values.shots && page.screenshot({ path: join(values.shots, `${name}.png`) });

async function open(browser, url, { pixels = 1, before } = {}) {
  const permissions = ["clipboard-read", "clipboard-write"];
  const options = {
    viewport: VIEWPORT,
    deviceScaleFactor: pixels,
    colorScheme: "dark",
    serviceWorkers: "block",
    permissions,
  };
  const page = await (await browser.newContext(options)).newPage();
  if (before) await page.addInitScript(before);
  await page.goto(url);
  return page;
}

/** Returns the names of the GPU in WebGL and WebGPU. */
async function nameCard(browser, url) {
  const page = await open(browser, url);
  const names = await page.evaluate(async () => {
    const gl = document.createElement("canvas").getContext("webgl2");
    const adapter = await navigator.gpu?.requestAdapter();
    const { vendor, architecture, description, isFallbackAdapter } = adapter?.info ?? {};
    return {
      webgl: gl?.getParameter(gl.getExtension("WEBGL_debug_renderer_info").UNMASKED_RENDERER_WEBGL) ?? null,
      webgpu: adapter ? { vendor, architecture, description, isFallbackAdapter } : null,
      threads: navigator.hardwareConcurrency,
      browser: navigator.userAgent,
    };
  });
  await page.context().close();
  return names;
}

/**
 * Counts the frames of a page for a while. Returns the frame rate, the time between frames, and the tasks longer than
 * 50 ms.
 */
async function count(page) {
  await page.waitForTimeout(SETTLING_MS);
  return page.evaluate(async (ms) => {
    const tasks = [];
    const observer = new PerformanceObserver((list) =>
      tasks.push(...list.getEntries().map(({ duration }) => duration)),
    );
    observer.observe({ type: "longtask" });
    const times = [];
    const begin = performance.now();
    for (let now = begin; now - begin < ms; ) {
      now = await new Promise(requestAnimationFrame);
      times.push(now);
    }
    observer.disconnect();
    const between = times
      .slice(1)
      .map((time, i) => time - times[i])
      .sort((a, b) => a - b);
    const at = (share) => between[Math.floor(share * (between.length - 1))];
    return {
      per_second: (1000 * between.length) / (times.at(-1) - times[0]),
      median_ms: at(0.5),
      p95_ms: at(0.95),
      most_ms: at(1),
      long_tasks: tasks,
    };
  }, COUNTING_MS);
}

/** Measures a crowd, and reads its panel. */
async function measureCrowd(browser, url, people, pixels) {
  const page = await open(browser, `${url}#view=crowd&crowd=${people}`, { pixels });
  await page.locator(".crowd-figures dd").first().waitFor();
  const pictures = await count(page);
  const panel = await page.locator(".crowd-figures").innerText();
  await shot(page, `crowd-${people.replaceAll(/\W/g, "-")}-${pixels}`);
  await page.context().close();
  return { people, pixels, ...pictures, panel: panel.replaceAll("\n", " ") };
}

async function measurePlay(browser, url, hash, pixels) {
  const page = await open(browser, `${url}${hash}`, { pixels });
  await page.locator("#app[data-view]").waitFor();
  const pictures = await count(page);
  await shot(page, `play-${hash.replaceAll(/\W/g, "-")}-${pixels}`);
  await page.context().close();
  return { view: hash || "play", pixels, ...pictures };
}

/** Drops a database on the page and waits until it is used. */
async function dropDatabase(page, file) {
  const transfer = await page.evaluateHandle(
    ({ name, bytes }) => {
      const data = Uint8Array.from(atob(bytes), (c) => c.charCodeAt(0));
      const transfer = new DataTransfer();
      transfer.items.add(new File([data], name));
      return transfer;
    },
    { name: basename(file), bytes: readFileSync(file, "base64") },
  );
  for (const type of ["dragenter", "dragover", "drop"])
    await page.dispatchEvent("body", type, { dataTransfer: transfer, clientX: 5, clientY: 5 });
  await page
    .getByText(/styles ready/)
    .first()
    .waitFor();
}

/** Draws the atlas on the GPU and on the CPU. Returns the page's measurements, and the difference of the pixels. */
async function measureAtlas(browser, url, db) {
  const draw = async (before) => {
    const page = await open(browser, `${url}?gpu=any#play=0&frame=40${db ? "" : "&atlas=whole"}`, { before });
    if (db) {
      await page.waitForFunction(() => window.strut?.frame);
      await dropDatabase(page, db);
      await page.keyboard.press("a");
    }
    await page.locator(".atlas[data-drawn]").waitFor({ timeout: 90_000 });
    const said = await page.locator(".atlas-by").textContent();
    const data = await page.locator(".atlas-picture").evaluate(async (canvas) => {
      for (let i = 0; i < 2; i++) await new Promise(requestAnimationFrame);
      return [...canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data];
    });
    await shot(page, `atlas-${before ? "processor" : "card"}`);
    await page.context().close();
    return { said, data };
  };
  const card = await draw();
  const processor = await draw(() => Object.defineProperty(navigator, "gpu", { value: undefined }));
  const apart = card.data.reduce((most, v, i) => Math.max(most, Math.abs(v - processor.data[i])), 0);
  return { card: card.said, processor: processor.said, levels_apart: apart, pixels: card.data.length / 4 };
}

/** Returns Lighthouse's results for the first load, with its mobile profile. */
async function measureFirstLoad(url) {
  const loads = [];
  for (let i = 0; i < VISITS; i++) {
    const port = 9333 + i;
    const browser = await launch([`--remote-debugging-port=${port}`]);
    const { lhr } = await lighthouse(url, { port, onlyCategories: ["performance"], logLevel: "error" });
    await browser.close();
    loads.push({
      score: Math.round(100 * lhr.categories.performance.score),
      blocking_ms: Math.round(lhr.audits["total-blocking-time"].numericValue),
      paint_ms: Math.round(lhr.audits["first-contentful-paint"].numericValue),
      largest_ms: Math.round(lhr.audits["largest-contentful-paint"].numericValue),
      speed_index_ms: Math.round(lhr.audits["speed-index"].numericValue),
      benchmark_index: lhr.environment.benchmarkIndex,
    });
  }
  return { median_score: median(loads.map(({ score }) => score)), loads };
}

/** Returns the report of bench.html. */
async function measureYardstick(browser, url) {
  const page = await open(browser, `${url}bench.html${values.software ? "?gpu=any" : ""}`);
  await page.getByLabel("Database").selectOption(String(FRAMES));
  await page.getByRole("button", { name: "Measure" }).click();
  const copy = page.getByRole("button", { name: "Copy as JSON" });
  const failed = page.getByRole("alert").filter({ hasText: /\w/ });
  await copy.or(failed).waitFor({ timeout: YARDSTICK_MS });
  if (await failed.isVisible()) return { failed: await failed.textContent() };
  await shot(page, "bench");
  await copy.click();
  await page.getByRole("button", { name: "Copied" }).waitFor();
  return JSON.parse(await page.evaluate(() => navigator.clipboard.readText()));
}

const site = await serveCompressed(join(root, "dist"));
const report = { date: new Date().toISOString().slice(0, 10) };
/** Runs one measurement. A failure is printed, and the next measurement follows. */
async function measure(name, work) {
  const begin = performance.now();
  report[name] = await work().catch((error) => ({ failed: String(error.message ?? error) }));
  const told = JSON.stringify(report[name]);
  console.log(
    `${name} (${((performance.now() - begin) / 1000).toFixed(0)} s): ${told.length > 3000 ? `${told.slice(0, 3000)}…` : told}`,
  );
  if (values.json) writeFileSync(values.json, JSON.stringify(report, null, 2));
}

const browser = await launch();
await measure("atlas", () => measureAtlas(browser, site.url));
if (values.db) await measure("atlas of a database", () => measureAtlas(browser, site.url, values.db));
for (const [people, pixels] of [
  ["1000_1", 1],
  ["1000_1", 2],
  ["1000_1&people=performers", 1],
  ["200_1", 1],
])
  await measure(`crowd ${people} ${pixels}`, () => measureCrowd(browser, site.url, people, pixels));
for (const [hash, pixels] of [
  ["", 1],
  ["", 2],
  ["#view=compare", 1],
])
  await measure(`play ${hash} ${pixels}`, () => measurePlay(browser, site.url, hash, pixels));
const unlimited = await launch(UNLIMITED);
await measure("crowd, no limit", () => measureCrowd(unlimited, site.url, "1000_1", 1));
await measure("play, no limit", () => measurePlay(unlimited, site.url, "", 1));
await unlimited.close();
// The first pages may open while the GPU process starts, and have no WebGL then.
await measure("card", () => nameCard(browser, site.url));
await measure("first load", () => measureFirstLoad(site.url));
if (values.yardstick) await measure("yardstick", () => measureYardstick(browser, site.url));
await browser.close();
await site.close();
