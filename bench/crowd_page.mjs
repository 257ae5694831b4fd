// node bench/crowd_page.mjs: how many pictures a second the page draws of a hundred people on a machine without a graphics card,
// once it has found the quality that the machine can draw. The picture is 1096 × 716 CSS pixels large.
import { launchWithoutCard, onBuiltSite } from "./built_site.mjs";

const VIEWPORT = { width: 1440, height: 900 };
/** Time in which the stage finds its quality, and the time that is measured, seconds. */
const [SETTLING, MEASURED] = [12, 10];

/** Runs in the page: the rate that the panel shows, twice a second for some time, and the pixels that are drawn. */
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
