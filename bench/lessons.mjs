// npm run lessons: what the lessons cost, into docs/lessons.md: calls of their engine in Node, and in Chromium on the built
// site how long a lesson takes to open after Play, and what a figure costs the page's thread while its state changes.
// Figures depend on the machine; it says which it was. The part of the page about exercises is written by hand.
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { cpus } from "node:os";
import { join, resolve } from "node:path";
import { chromium } from "playwright-core";
import { preview, runnerImport } from "vite";
import { main, root, Sentence, step } from "../scripts/steps.mjs";

const FLAGS = [
  "--no-sandbox",
  "--use-angle=swiftshader",
  "--enable-unsafe-swiftshader",
  "--disable-background-networking",
];
const OPENS_IN_MS = 1000;
const FRAME_MS = 4;
/** Changes of the state that a figure is timed over. */
const CHANGES = 60;
/** Which part of a figure's state changes, where it is not the instant. */
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

/** Milliseconds from Play to a lesson whose figures are all shown, by lesson; every page is new. */
async function openings(browser, url, lessons) {
  const times = [];
  for (const lesson of lessons) {
    const context = await browser.newContext({ viewport: { width: 1440, height: 900 } });
    const page = await context.newPage();
    await page.goto(`${url}#play=0`);
    await page.waitForFunction(() => window.strut?.analysed);
    const ms = await page.evaluate(async (id) => {
      const begin = performance.now();
      location.hash = `view=learn&lesson=${id}&beat=0&play=0`;
      const open = () => document.querySelector(".lessons select")?.value === id;
      while (!open()) await new Promise(requestAnimationFrame);
      await Promise.all([...document.querySelectorAll("strut-figure:not([hidden])")].map((figure) => figure.ready()));
      await new Promise(requestAnimationFrame);
      return performance.now() - begin;
    }, lesson);
    times.push({ lesson, ms });
    await context.close();
  }
  return times;
}

/** Milliseconds of the page's thread, and until the engine's answer is shown, for a change of a figure's state. */
async function figureCosts(browser, url, kinds) {
  const costs = [];
  for (const kind of kinds) {
    const context = await browser.newContext({ viewport: { width: 688, height: 480 } });
    const page = await context.newPage();
    const client = await context.newCDPSession(page);
    await client.send("Performance.enable");
    const busySecs = async () =>
      (await client.send("Performance.getMetrics")).metrics.find(({ name }) => name === "TaskDuration").value;
    await page.goto(`${url}figure.html?kind=${kind}`);
    await page.locator("strut-figure").evaluate((figure) => figure.ready());
    const change = CHANGED[kind] ?? ((n) => `i=${100 + n}`);
    const states = Array.from({ length: 2 * CHANGES }, (_, n) => change(n % CHANGES));
    const show = (some) =>
      page.locator("strut-figure").evaluate(async (figure, some) => {
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
    // The first round compiles and fills what is remembered.
    await show(states.slice(0, CHANGES));
    const before = await busySecs();
    const times = await show(states.slice(CHANGES));
    costs.push({ kind, threadMs: (1000 * ((await busySecs()) - before)) / CHANGES, shownMs: median(times) });
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
    `| lesson | opens after Play in ms, of ${OPENS_IN_MS} |`,
    "| --- | ---: |",
    ...opened.map(({ lesson, ms }) => `| ${lesson} | ${ms.toFixed(0)}${over(ms, OPENS_IN_MS)} |`),
    "",
    `| figure | page's thread, ms a change, of ${FRAME_MS} | shown after, ms |`,
    "| --- | ---: | ---: |",
    ...costs.map(
      ({ kind, threadMs, shownMs }) =>
        `| ${kind} | ${threadMs.toFixed(2)}${over(threadMs, FRAME_MS)} | ${shownMs.toFixed(1)} |`,
    ),
  ];
  return lines.join("\n");
}

await main(async () => {
  if (!existsSync(resolve(root, "dist/figure.html")))
    throw new Sentence("dist/ is missing; run 'npm run build' first.");
  const { module: lessons } = await runnerImport(join(root, "bench", "lessons.ts"));
  const measured = { machine: `${cpus().length} × ${cpus()[0].model.trim()}` };
  await step("Calls of the engine", async () => {
    measured.calls = await lessons.timeCalls();
  });
  const server = await preview({
    root: resolve(root, "web/app"),
    configFile: resolve(root, "vite.config.ts"),
    preview: { port: 0, strictPort: false, open: false },
    logLevel: "error",
  });
  const url = server.resolvedUrls.local[0];
  const browser = await chromium.launch({
    executablePath: process.env.CHROME_PATH ?? "/usr/bin/chromium",
    args: FLAGS,
  });
  try {
    await step("Opening of lessons", async () => {
      measured.opened = await openings(browser, url, lessons.LESSON_IDS);
    });
    await step("Costs of figures", async () => {
      measured.costs = await figureCosts(browser, url, lessons.KIND_NAMES);
    });
  } finally {
    await browser.close();
    await server.close();
  }
  const file = join(root, "docs", "lessons.md");
  const [before, rest] = readFileSync(file, "utf8").split(BEGIN);
  writeFileSync(file, `${before}${BEGIN}\n\n${tables(measured)}\n\n${END}${rest.split(END)[1]}`);
  console.log(tables(measured));
});
