// npm run budget [-- --first-load] [--film FOLDER] [--minutes N] [--json FILE]: measures the page's budgets in Chromium
// on the built site: size; the first load in Lighthouse; the first seconds on slow 4G, filmed into a folder (with
// --first-load nothing more); the time to the first styled frame; the time for a clip of a minute, with the longest
// main-thread task meanwhile; the growth of memory while the styles change; and the memory of the page with four views.
// The results depend on the machine, whose name is printed.
//
// Growing memory is what is reachable after garbage collection. Code is counted separately: for minutes the browser
// recompiles and optimises hot code, which is most of the heap's growth and is not kept by the page.
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { cpus, tmpdir } from "node:os";
import { join } from "node:path";
import { parseArgs } from "node:util";
import { checkSize } from "../scripts/size.mjs";
import { main, Sentence } from "../scripts/steps.mjs";
import { onBuiltSite } from "./built_site.mjs";
import { checkFirstLoad, linesOf, measureFirstLoad } from "./first_load.mjs";
import { checkFirstSeconds, linesOfSeconds, measureFirstSeconds } from "./first_seconds.mjs";
import { lineOfMemory, measurePageMemory } from "./page_memory.mjs";
import { reachable } from "./reachable.mjs";

/** Number of visits over which the time to the first character is measured. */
const VISITS = 5;
/** Number of frames of the styled clip: a minute. */
const LONG_CLIP = 3600;
/** Time in which the stage adapts its quality to the machine. */
const SETTLING_MS = 8000;
const BUDGET = { firstCharacterMs: 2000, longestTaskMs: 50, longClipMs: 1000, growthPercent: 5 };

const median = (values) => values.toSorted((a, b) => a - b)[values.length >> 1];

/**
 * Runs in the page before its scripts: records the first movement of the character, the arrival of a file, and every
 * long task.
 */
function observe() {
  window.budget = { tasks: [] };
  const given = ({ target }) => {
    if (target.type === "file") window.budget.fileMs = performance.now();
  };
  addEventListener("change", given, { capture: true });
  new PerformanceObserver((list) => {
    for (const { startTime, duration } of list.getEntries()) window.budget.tasks.push({ startTime, duration });
  }).observe({ type: "longtask", buffered: true });
  const look = () => {
    if ((window.strut?.frame?.inputFrame ?? 0) > 0) window.budget.firstMs = performance.now();
    else requestAnimationFrame(look);
  };
  requestAnimationFrame(look);
}

async function open(browser, url, viewport = { width: 1440, height: 900 }) {
  // Without service workers: the page's idle download of files for offline visits would be measured, too.
  const context = await browser.newContext({ viewport, acceptDownloads: true, serviceWorkers: "block" });
  const page = await context.newPage();
  await page.addInitScript(observe);
  await page.goto(url);
  await page.waitForFunction(() => window.budget?.firstMs !== undefined, undefined, { timeout: 60_000 });
  return page;
}

async function firstCharacter(browser, url) {
  const times = [];
  for (let i = 0; i < VISITS; i++) {
    const page = await open(browser, url);
    times.push(await page.evaluate(() => window.budget.firstMs));
    await page.context().close();
  }
  return median(times);
}

/** Returns the built-in walk repeated to LONG_CLIP frames, as BVH. */
async function longClip(page) {
  await page.locator(".bar-action.outlined").click();
  const item = page.locator(".export-menu").getByRole("button", { name: /^BVH/ });
  const [download] = await Promise.all([page.waitForEvent("download"), item.click()]);
  const chunks = [];
  for await (const chunk of await download.createReadStream()) chunks.push(chunk);
  const text = Buffer.concat(chunks).toString();
  const [head, motion] = text.split(/(?<=Frame Time:.*\n)/);
  const frames = motion.trim().split("\n");
  const times = Math.ceil(LONG_CLIP / frames.length);
  const rows = Array.from({ length: times }, () => frames)
    .flat()
    .slice(0, LONG_CLIP);
  return `${head.replace(/Frames:\s*\d+/, `Frames: ${rows.length}`)}${rows.join("\n")}\n`;
}

/**
 * Drops a long clip. Returns the time from the drop until all of it is styled, and the longest main-thread task
 * meanwhile.
 */
async function styleLongClip(browser, url) {
  // A small picture with adapted quality: without a GPU, drawing would dominate the measurement.
  const page = await open(browser, url, { width: 500, height: 640 });
  await page.waitForFunction(() => window.strut.analysed);
  const folder = mkdtempSync(join(tmpdir(), "strut-"));
  const file = join(folder, "long.bvh");
  writeFileSync(file, await longClip(page));
  await page.waitForTimeout(SETTLING_MS);
  await page.locator(".drop-overlay input[multiple]").setInputFiles(file);
  await page.waitForFunction(() => window.strut.analysed === false);
  await page.waitForFunction(() => window.strut.analysed, undefined, { timeout: 120_000 });
  const until = await page.evaluate(() => performance.now());
  const { tasks, fileMs } = await page.evaluate(() => window.budget);
  await page.context().close();
  rmSync(folder, { recursive: true });
  const durations = tasks.filter(({ startTime }) => startTime > fileMs).map(({ duration }) => duration);
  return { ms: until - fileMs, longestTaskMs: Math.max(0, ...durations) };
}

async function growth(browser, url, minutes) {
  const page = await open(browser, url);
  const settled = () => page.waitForFunction(() => window.strut.analysed, undefined, { timeout: 60_000 });
  await settled();
  const client = await page.context().newCDPSession(page);
  const change = async (until) => {
    while (performance.now() < until) {
      await page.keyboard.press(String(1 + Math.floor(Math.random() * 8)));
      await page.waitForTimeout(1000);
    }
    await settled();
  };
  await change(performance.now() + 10_000);
  const before = await reachable(client);
  await change(performance.now() + minutes * 60_000);
  const after = await reachable(client);
  await page.context().close();
  const percent = (kind) => Number(((100 * (after[kind] - before[kind])) / before[kind]).toFixed(1));
  return { data: percent("data"), code: percent("code") };
}

async function memory(browser, url) {
  const page = await open(browser, url);
  await page.waitForFunction(() => window.strut.analysed);
  const measured = await measurePageMemory(browser, page);
  await page.context().close();
  return measured;
}

/** Measures everything except the first load. */
async function measureUse(minutes) {
  return onBuiltSite(async (browser, url) => {
    const first = await firstCharacter(browser, url);
    const clip = await styleLongClip(browser, url);
    return {
      first_character_ms: Math.round(first),
      long_clip_ms: Math.round(clip.ms),
      longest_task_ms: Math.round(clip.longestTaskMs),
      heap_growth_percent: await growth(browser, url, minutes),
      memory: await memory(browser, url),
      minutes,
    };
  });
}

/** Returns the lines that show the result of {@link measureUse}. */
function linesOfUse(use) {
  const { first_character_ms, long_clip_ms, longest_task_ms, minutes, memory } = use;
  const { data, code } = use.heap_growth_percent;
  return [
    `first character  ${first_character_ms} of ${BUDGET.firstCharacterMs} ms (median of ${VISITS} visits)`,
    `a minute's clip  ${long_clip_ms} of ${BUDGET.longClipMs} ms from the file to the last styled frame`,
    `longest task     ${longest_task_ms} of ${BUDGET.longestTaskMs} ms while ${LONG_CLIP} frames are styled`,
    `heap growth      ${data} of ${BUDGET.growthPercent} % in ${minutes} min of changing styles; of code ${code} %`,
    lineOfMemory(memory),
  ];
}

await main(async () => {
  const { values } = parseArgs({
    options: {
      minutes: { type: "string", default: "1" },
      json: { type: "string" },
      film: { type: "string" },
      "first-load": { type: "boolean", default: false },
    },
  });
  const minutes = Number(values.minutes);
  if (!(minutes > 0)) throw new Sentence(`The minutes are '${values.minutes}'; a number above 0 was expected.`);
  const machine = `${cpus().length} × ${cpus()[0].model}`;
  const size = checkSize();
  console.log(`machine          ${machine}\nsize             ${size}`);
  const load = await measureFirstLoad();
  console.log(["first load", ...linesOf(load)].join("\n"));
  const seconds = await measureFirstSeconds(values.film);
  console.log(linesOfSeconds(seconds).join("\n"));
  const use = values["first-load"] ? {} : await measureUse(minutes);
  if (!values["first-load"]) console.log(linesOfUse(use).join("\n"));
  if (values.json)
    writeFileSync(
      values.json,
      `${JSON.stringify({ machine, size, first_load: load, first_seconds: seconds, ...use }, undefined, 2)}\n`,
    );
  checkFirstLoad(load);
  checkFirstSeconds(seconds);
});
