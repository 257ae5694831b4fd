// node bench/crowd_page.mjs: the page's frame rate with a hundred people on a machine without a GPU, after the quality
// has adapted to the machine. The picture has 1096 × 716 CSS pixels.
import { launchWithoutCard, onBuiltSite } from "./built_site.mjs";

const VIEWPORT = { width: 1440, height: 900 };
/** Time in which the stage adapts its quality, and measured time, seconds. */
const [SETTLING, MEASURED] = [12, 10];

/**
 * Runs in the page: returns the frame rate in the panel, twice a second for some time, and the number of drawn pixels.
 */
async function rates(secs) {
  const shown = () => Number(/(\d+) fps/.exec(document.querySelector(".crowd-figures").textContent)?.[1]);
  const found = [];
  for (let i = 0; i < 2 * secs; i++) {
    await new Promise((resolve) => setTimeout(resolve, 500));
    found.push(shown());
  }
  const { width, height } = document.querySelector(".crowd canvas");
  return { found: found.sort((a, b) => a - b), width, height };
}

await onBuiltSite(async (browser, url) => {
  const page = await (await browser.newContext({ viewport: VIEWPORT, serviceWorkers: "block" })).newPage();
  await page.goto(`${url}#view=crowd&crowd=100_1`);
  await page.waitForTimeout(1000 * SETTLING);
  const { found, width, height } = await page.evaluate(rates, MEASURED);
  console.log(`100 walkers: ${found[found.length >> 1]} fps median, ${found[0]} least, canvas of ${width} × ${height}`);
}, launchWithoutCard);
