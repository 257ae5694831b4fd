// The first load of the page in Lighthouse's mobile profile: a simulated mid-range phone on slow 4G.
import { join } from "node:path";
import lighthouse from "lighthouse";
import { root, Sentence } from "../scripts/steps.mjs";
import { freePort, launchChromium, requireBuiltSite } from "./built_site.mjs";
import { serveCompressed } from "./hosted_site.mjs";

/** The reported audits: the unit of each, and the goal if there is one. */
const AUDITS = {
  "first-contentful-paint": { name: "first contentful paint", unit: "ms", most: 1800 },
  "largest-contentful-paint": { name: "largest contentful paint", unit: "ms" },
  "cumulative-layout-shift": { name: "layout shift", unit: "", most: 0.05, digits: 3 },
  "total-blocking-time": { name: "blocking time", unit: "ms", most: 200 },
  "speed-index": { name: "speed index", unit: "ms" },
  "total-byte-weight": { name: "bytes", unit: "bytes" },
};
/** Least score, out of 100. */
const LEAST_SCORE = 90;
/** Number of visits. The visit with the median blocking time counts, which varies most between visits. */
const VISITS = 3;
/** Lighthouse counts the part of a main-thread task beyond this as blocking, milliseconds. */
const UNNOTICED_MS = 50;

/** Files that no visitor of the page loads: the package, the page for iframes, the benchmark. */
const OTHER_PAGES = /^(package|embed)\/|bench/;

/** A phone has a GPU. Without one the page's text must not wait for the software-rendered picture. */
const WITHOUT_GRAPHICS = ["--disable-gpu-rasterization"];

/**
 * A page that replaces one of the same process destroys it after a second, and first waits for its own drawing: without
 * a GPU a tenth of a second. Lighthouse navigates from an empty page; a visitor comes from another site, which has
 * another process.
 */
const FROM_ANOTHER_SITE = ["--disable-features=DelayLayerTreeViewDeletionOnLocalSwap"];

/**
 * Loads the page a few times.
 * @returns the score and the audits' values, each a number, and `blocking_own_time`: the blocking time without waiting
 * for other threads, for example SwiftShader's on a machine without a GPU
 */
export async function measureFirstLoad() {
  requireBuiltSite();
  const site = await serveCompressed(join(root, "dist"), (path) => !OTHER_PAGES.test(path));
  const visits = [];
  try {
    for (let i = 0; i < VISITS; i++) visits.push(await visit(site.url));
  } finally {
    await site.close();
  }
  const blocking = (load) => load["total-blocking-time"];
  return visits.toSorted((a, b) => blocking(a) - blocking(b))[VISITS >> 1];
}

async function visit(url) {
  const port = await freePort();
  const browser = await launchChromium([...WITHOUT_GRAPHICS, ...FROM_ANOTHER_SITE, `--remote-debugging-port=${port}`]);
  try {
    const { lhr, artifacts } = await lighthouse(url, { port, onlyCategories: ["performance"], logLevel: "error" });
    if (lhr.runtimeError) throw new Sentence(`Lighthouse could not load the page: ${lhr.runtimeError.message}`);
    const figures = Object.keys(AUDITS).map((audit) => [audit, lhr.audits[audit].numericValue]);
    return {
      score: Math.round(100 * lhr.categories.performance.score),
      ...Object.fromEntries(figures),
      blocking_own_time: ownBlockingMs(
        artifacts.Trace.traceEvents,
        lhr.configSettings.throttling.cpuSlowdownMultiplier,
      ),
    };
  } finally {
    await browser.close();
  }
}

/**
 * Returns the blocking time after the first paint, counting the CPU time of the main thread, scaled by `slowdown` for a
 * phone.
 */
function ownBlockingMs(events, slowdown) {
  const paint = events.findLast(({ name }) => name === "firstContentfulPaint");
  const tasks = events.filter(
    ({ name, pid, tid, ts }) => name === "RunTask" && pid === paint.pid && tid === paint.tid && ts > paint.ts,
  );
  return tasks.reduce((sum, { tdur = 0 }) => sum + Math.max(0, (slowdown * tdur) / 1000 - UNNOTICED_MS), 0);
}

/** Returns the lines that show the result of {@link measureFirstLoad}. */
export function linesOf(load) {
  const figures = Object.entries(AUDITS).map(([audit, { name, unit, most, digits = 0 }]) => {
    const goal = most === undefined ? "" : ` of ${most}`;
    const own = audit === "total-blocking-time" ? `, ${load.blocking_own_time.toFixed(0)} of its own` : "";
    return `  ${name.padEnd(24)} ${load[audit].toFixed(digits)}${goal} ${unit}`.trimEnd() + own;
  });
  return [`  ${"Lighthouse, mobile".padEnd(24)} ${load.score} of at least ${LEAST_SCORE}`, ...figures];
}

/** Throws a message that names the missed goals. */
export function checkFirstLoad(load) {
  const missed = Object.entries(AUDITS)
    .filter(([audit, { most }]) => most !== undefined && load[audit] > most)
    .map(([, { name }]) => name);
  if (load.score < LEAST_SCORE) missed.unshift("score");
  if (missed.length > 0) throw new Sentence(`The first load misses its goals: ${missed.join(", ")}.`);
}
