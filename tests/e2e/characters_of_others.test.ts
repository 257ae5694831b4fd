/** Characters of other people on the page: textured, of other formats, of other sizes, with joints that are not found. */
import type { Page } from "playwright-core";
import { afterAll, beforeAll, test } from "vitest";
import { othersAbsent, rigOfOthers } from "../rigs/others";
import { drawn, dropFile, eventually, openSite, screenshot } from "./browser";
import { colouredPixels } from "./pixels";

let site: Awaited<ReturnType<typeof openSite>>;
let page: Page;
beforeAll(async () => {
  // Without the ghost and the corners of the styles, which have colours of their own.
  site = await openSite({ hash: "styles=proud:1&ghost=off", size: { width: 1280, height: 800 }, theme: "light" });
  page = site.page;
});
afterAll(() => site.close());

const performer = async () => ((await page.locator(".cast").isVisible()) ? page.locator(".cast-name").innerText() : "");
const dropRig = (name: string) => dropFile(page, name, rigOfOthers(name));

/** The picture of the stage, without the panels around it. */
async function pictureOfStage(): Promise<Buffer> {
  await drawn(page, 10);
  const box = (await page.locator(".stage").first().boundingBox())!;
  const [width, height] = [0.4 * box.width, 0.8 * box.height];
  return page.screenshot({
    clip: { x: box.x + (box.width - width) / 2, y: box.y + (box.height - height) / 2, width, height },
  });
}

test.skipIf(othersAbsent)("a textured character has its colours, under the page's own policy", async () => {
  await dropRig("m2m-sophia.glb");
  await eventually(performer).toBe("m2m-sophia");
  await eventually(async () => colouredPixels(site.browser, await pictureOfStage())).toBeGreaterThan(1000);
  await screenshot(page, "others-m2m-sophia");
});
