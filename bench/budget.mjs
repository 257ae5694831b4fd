// npm run budget [-- --first-load] [--film FOLDER] [--minutes N] [--json FILE]: the page's budgets (DESIGN §8), measured in
// Chromium on the built site: size, the first load as Lighthouse sees it, the first seconds on slow 4G, whose film goes to a
// folder (with --first-load nothing more), the time to the first styled frame, how long a clip of a
// minute takes and the longest task on the main thread meanwhile, the growth of memory while the styles change, and what the page takes with four views. Figures depend
// on the machine; it says which it was.
//
// Memory that grows is what is reachable after garbage collection. Code is counted apart: for minutes the browser compiles anew, and
// better, what runs often, which is most of what the heap gains and nothing that the page keeps.
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

/** Visits that the first character is timed in. */
const VISITS = 5;
/** Frames of the clip that is styled: a minute. */
const LONG_CLIP = 3600;
/** Time in which the stage finds the quality that the machine can draw. */
const SETTLING_MS = 8000;
const BUDGET = { firstCharacterMs: 2000, longestTaskMs: 50, longClipMs: 1000, growthPercent: 5 };

const median = (values) => values.toSorted((a, b) => a - b)[values.length >> 1];

/** Runs in the page before its scripts: when the character first moved, when the page was given a file, and every long task. */
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
  // What the page keeps for visits without a network is fetched when it is idle, and would be measured too.
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

/** The built-in walk several times over, as a BVH of LONG_CLIP frames. */
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

/** Drops a long clip: the time until all of it is styled, from the file on, and the longest task on the main thread meanwhile. */
async function styleLongClip(browser, url) {
  // A small picture that has found its quality: without a graphics card drawing would be all that is measured.
  const page = await open(browser, url, { width: 500, height: 640 });
  await page.waitForFunction(() => window.strut.analysed);
  const folder = mkdtempSync(join(tmpdir(), "strut-"));
  const file = join(folder, "long.bvh");
  writeFileSync(file, await longClip(page));
  await page.waitForTimeout(SETTLING_MS);
  await page.locator(".drop-overlay input[type=file]").setInputFiles(file);
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

/** Everything but the first load. */
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

/** The lines that show what {@link measureUse} returned. */
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
