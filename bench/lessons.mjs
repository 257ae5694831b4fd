// npm run lessons: measures the cost of the lessons, for docs/lessons.md: calls of their engine in Node, and in
// Chromium on the built site the time to open a lesson after Play and the main-thread time of a figure while its state
// changes. The results depend on the machine, whose name is printed. The part of the page about exercises is
// handwritten.
import { readFileSync, writeFileSync } from "node:fs";
import { cpus } from "node:os";
import { join } from "node:path";
import { runnerImport } from "vite";
import { main, root, step } from "../scripts/steps.mjs";
import { onBuiltSite } from "./built_site.mjs";

const OPENS_IN_MS = 1000;
const FRAME_MS = 4;
/** Number of state changes over which a figure is timed. */
const CHANGES = 60;
/** The changing part of a figure's state, if it is not the instant. */
const CHANGED = {
  chain: (n) => `rhol=${(n / 50).toFixed(2)}`,
  path: (n) => `dvar=${(1 + n).toFixed(2)}`,
  gait: (n) => `share=${(n / 60).toFixed(2)}`,
  som: (n) => `updates=${n}`,
  learning: (n) => `updates=${100 * n}`,
  pad: (n) => `T=${(1 + n / 20).toFixed(2)}`,
  posed: (n) => `sep=${n - 30}`,
  keys: (n) => `marks=0,${1 + (n % 30)}`,
  sweep: (n) => `nu=${(n / 10).toFixed(1)}`,
  leg: (n) => `x=${(n / 300).toFixed(3)}`,
  polygon: (n) => `old=${(n / 60).toFixed(2)}`,
  paced: (n) => `old=${(n / 60).toFixed(2)}`,
};
const BEGIN = "<!-- measured -->";
const END = "<!-- /measured -->";

const median = (values) => values.toSorted((a, b) => a - b)[values.length >> 1];

/** Time for which the pointer hovers over the tab before the click, milliseconds. */
const POINTED_MS = 250;
/** Time after its first frame in which Play settles, milliseconds. */
const REST_MS = 1500;

/**
 * Returns milliseconds from Play to a lesson, by lesson, each on a new page: by a link, and by the hovered tab; until
 * all figures are visible, and until they show all computed values.
 */
async function openings(browser, url, lessons) {
  const times = [];
  for (const lesson of lessons) {
    const [byLink, byTab] = [await opening(browser, url, lesson, false), await opening(browser, url, lesson, true)];
    times.push({ lesson, byLink, byTab });
  }
  return times;
}

async function opening(browser, url, lesson, byTab) {
  // Without service workers: the page's idle download of files for offline visits would be measured, too.
  const context = await browser.newContext({ viewport: { width: 1440, height: 900 }, serviceWorkers: "block" });
  const page = await context.newPage();
  await page.goto(`${url}#lesson=${lesson}&beat=0&play=0`);
  await page.waitForFunction(() => window.strut?.analysed);
  await page.waitForTimeout(REST_MS);
  const tab = page.locator('a.tab[href="#view=learn"]');
  if (byTab) {
    await tab.hover();
    await page.waitForTimeout(POINTED_MS);
  }
  const time = await tab.evaluate(async (tab, byTab) => {
    const begin = performance.now();
    if (byTab) tab.click();
    else location.hash = `view=learn&${location.hash.slice(1)}`;
    const frame = () => new Promise(requestAnimationFrame);
    while (document.querySelector(".lessons select") === null) await frame();
    const figures = [...document.querySelectorAll("strut-figure:not([hidden])")];
    const complete = Promise.all(figures.map((figure) => figure.ready())).then(() => performance.now() - begin);
    while (!figures.every(({ shadowRoot }) => shadowRoot.querySelector(".figure.shown"))) await frame();
    await frame();
    return { seenMs: performance.now() - begin, completeMs: await complete };
  }, byTab);
  await context.close();
  return time;
}

/**
 * Returns the CPU time of the page's thread during `work`, milliseconds, without software rendering, which is on other
 * threads.
 */
async function threadMs(browser, page, work) {
  await browser.startTracing(page, { categories: ["toplevel"] });
  await work();
  const { traceEvents } = JSON.parse((await browser.stopTracing()).toString());
  const threadOf = ({ pid, tid }) => `${pid}/${tid}`;
  const pages = traceEvents.filter(({ name, args }) => name === "thread_name" && args.name === "CrRendererMain");
  const threads = new Set(pages.map(threadOf));
  const tasks = traceEvents.filter((event) => event.ph === "X" && threads.has(threadOf(event)));
  const ends = new Map();
  let microseconds = 0;
  for (const task of tasks.toSorted((a, b) => a.ts - b.ts)) {
    // A task within another one is part of it.
    if (task.ts < (ends.get(threadOf(task)) ?? 0)) continue;
    ends.set(threadOf(task), task.ts + task.dur);
    microseconds += task.tdur ?? 0;
  }
  return microseconds / 1000;
}

/**
 * Returns the CPU time of the page's thread per animation frame, milliseconds, while each frame changes the state, as
 * in a drag; and the median time until a single change is shown, including the engine's answer.
 */
async function figureCosts(browser, url, kinds) {
  const costs = [];
  for (const kind of kinds) {
    const context = await browser.newContext({ viewport: { width: 688, height: 480 } });
    const page = await context.newPage();
    await page.goto(`${url}figure.html?kind=${kind}`);
    await page.locator("strut-figure").evaluate((figure) => figure.ready());
    const change = CHANGED[kind] ?? ((n) => `i=${100 + n}`);
    const states = Array.from({ length: 2 * CHANGES }, (_, n) => change(n % CHANGES));
    const figure = page.locator("strut-figure");
    const show = (some) =>
      figure.evaluate(async (figure, some) => {
        const times = [];
        for (const state of some) {
          await new Promise(requestAnimationFrame);
          const begin = performance.now();
          figure.state = state;
          await figure.ready();
          times.push(performance.now() - begin);
        }
        return times;
      }, some);
    const drag = (some) =>
      figure.evaluate(async (figure, some) => {
        for (const state of some) {
          await new Promise(requestAnimationFrame);
          figure.state = state;
        }
      }, some);
    // The first round compiles the code and fills caches.
    await show(states.slice(0, CHANGES));
    const shown = await show(states.slice(CHANGES));
    const busyMs = await threadMs(browser, page, () => drag(states));
    costs.push({ kind, frameMs: busyMs / states.length, shownMs: median(shown) });
    await context.close();
  }
  return costs;
}

const over = (value, bound) => (value > bound ? " **over**" : "");

function tables({ machine, calls, opened, costs }) {
  const lines = [
    `Measured on ${machine}; Chromium draws in software. Times hold for this machine only.`,
    "",
    "| call of the engine | median ms | bound ms |",
    "| --- | ---: | ---: |",
    ...calls.map(
      ({ name, medianMs, boundMs }) => `| ${name} | ${medianMs.toFixed(3)}${over(medianMs, boundMs)} | ${boundMs} |`,
    ),
    "",
    `| lesson | by its tab, ms of ${OPENS_IN_MS} | complete | by a link, ms | complete |`,
    "| --- | ---: | ---: | ---: | ---: |",
    ...opened.map(({ lesson, byTab, byLink }) => {
      const [tab, link] = [byTab, byLink].map(
        ({ seenMs, completeMs }) => `${seenMs.toFixed(0)}${over(seenMs, OPENS_IN_MS)} | ${completeMs.toFixed(0)}`,
      );
      return `| ${lesson} | ${tab} | ${link} |`;
    }),
    "",
    `| figure | page's thread, ms a frame of a drag, of ${FRAME_MS} | a change is shown after, ms |`,
    "| --- | ---: | ---: |",
    ...costs.map(
      ({ kind, frameMs, shownMs }) =>
        `| ${kind} | ${frameMs.toFixed(2)}${over(frameMs, FRAME_MS)} | ${shownMs.toFixed(1)} |`,
    ),
  ];
  return lines.join("\n");
}

await main(async () => {
  const { module: lessons } = await runnerImport(join(root, "bench", "lessons.ts"));
  const measured = { machine: `${cpus().length} × ${cpus()[0].model.trim()}` };
  await step("Calls of the engine", async () => {
    measured.calls = await lessons.timeCalls();
  });
  await onBuiltSite(async (browser, url) => {
    await step("Opening of lessons", async () => {
      measured.opened = await openings(browser, url, lessons.LESSON_IDS);
    });
    await step("Costs of figures", async () => {
      measured.costs = await figureCosts(browser, url, lessons.KIND_NAMES);
    });
  });
  const file = join(root, "docs", "lessons.md");
  const [before, rest] = readFileSync(file, "utf8").split(BEGIN);
  writeFileSync(file, `${before}${BEGIN}\n\n${tables(measured)}\n\n${END}${rest.split(END)[1]}`);
  console.log(tables(measured));
});
