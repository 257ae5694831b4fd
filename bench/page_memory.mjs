// The page's memory after visits of several views, and after a further minute in which they were hidden.
import { readFileSync } from "node:fs";
import { platform } from "node:os";

/** The views that are visited after Play. */
const VIEWS = ["compare", "walk", "key-style"];
const VISIT_MS = 8000;
/** Views out of sight are disposed of after a minute. */
const HIDDEN_MS = 65_000;
/** Goal (issue 23), megabytes. */
const MOST_MB = 250;

/**
 * Returns the private memory of the process that runs the page with its workers, or undefined where the system does not
 * report it. The GPU process is separate.
 */
async function privateMegabytes(browser) {
  if (platform() !== "linux") return undefined;
  const session = await browser.newBrowserCDPSession();
  const { processInfo } = await session.send("SystemInfo.getProcessInfo");
  await session.detach();
  const sizes = processInfo
    .filter(({ type }) => type === "renderer")
    .map(({ id }) => {
      const rollup = readFileSync(`/proc/${id}/smaps_rollup`, "utf8");
      return [...rollup.matchAll(/^Private_(?:Clean|Dirty):\s+(\d+) kB/gm)].reduce(
        (sum, [, kB]) => sum + Number(kB),
        0,
      );
    });
  // A spare process waits for the next page.
  return Math.round(Math.max(...sizes) / 1000);
}

/** Visits the views of an open page and measures its memory. */
export async function measurePageMemory(browser, page) {
  const go = (view) => page.evaluate((hash) => location.assign(hash), `#view=${view}`);
  const play = await privateMegabytes(browser);
  for (const view of VIEWS) {
    await go(view);
    await page.waitForTimeout(VISIT_MS);
  }
  const views = await privateMegabytes(browser);
  await go("play");
  await page.waitForTimeout(HIDDEN_MS);
  return { play_mb: play, four_views_mb: views, a_minute_later_mb: await privateMegabytes(browser) };
}

/** Returns the line that shows the result of {@link measurePageMemory}. */
export function lineOfMemory({ play_mb: play, four_views_mb: views, a_minute_later_mb: later }) {
  if (play === undefined) return "memory           not measured: only Linux tells";
  return `memory           ${views} of ${MOST_MB} MB with four views, ${play} with Play alone, ${later} a minute later`;
}
