/** Third-party characters in players on third-party pages: under a policy, and in iframes without an origin. */
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import type { StrutPlayer } from "../../web/element";
import { othersAbsent } from "../rigs/others";
import { eventually, launchBrowser } from "./browser";
import { characterOf, frameOf, PLAYER, POLICY, serveEmbedded } from "./embedded_folder";
import { colouredPixels } from "./pixels";

let browser: Browser;
let embedded: Awaited<ReturnType<typeof serveEmbedded>>;
beforeAll(async () => {
  [browser, embedded] = await Promise.all([launchBrowser(), serveEmbedded()]);
});
afterAll(async () => {
  await browser.close();
  await embedded.close();
});

/** Opens a page with a body, and records its console. */
async function open({ url }: { url: string }, body: string): Promise<{ page: Page; console: string[] }> {
  embedded.write(body);
  const context = await browser.newContext({ viewport: { width: 500, height: 400 } });
  const page = await context.newPage();
  const said: string[] = [];
  page.on("console", (message) => said.push(message.text()));
  await page.goto(url);
  return { page, console: said };
}

/** Checks the colours of the player in a page's picture; the page has no others. */
const expectColours = (page: Page) =>
  eventually(async () => colouredPixels(browser, await page.screenshot())).toBeGreaterThan(1000);

test("a frame without an origin plays from a host that allows nobody to fetch", async () => {
  const { page } = await open(embedded.site, frameOf("styles=old:1"));
  const player = page.frameLocator("iframe").locator("strut-player");
  expect(await player.evaluate((element) => (element as StrutPlayer).ready.then(() => "ready", String))).toBe("ready");
  await page.context().close();
});

test.skipIf(othersAbsent)("a textured character has its colours in a frame without an origin", async () => {
  const { page } = await open(embedded.site, frameOf(characterOf(embedded.site.url)));
  await expectColours(page);
  await page.context().close();
});

test.skipIf(othersAbsent)("a textured character has its colours under the policy that is recommended", async () => {
  expect(POLICY).toContain("script-src 'self' 'wasm-unsafe-eval'");
  const { page, console: said } = await open(embedded.policed, PLAYER);
  await expectColours(page);
  expect(said.filter((text) => /Content Security Policy|violates/.test(text))).toEqual([]);
  await page.context().close();
});

test("strut-player.js as a module says what to write instead", async () => {
  const { page } = await open(
    embedded.site,
    `<script>addEventListener("error", ({ message }) => { document.title = message; });</script>
     <script type="module">import("./package/strut-player.js").catch(({ message }) => { document.title = message; });</script>`,
  );
  await eventually(() => page.title()).toContain("strut-player.js cannot find its own URL");
  await page.context().close();
});
