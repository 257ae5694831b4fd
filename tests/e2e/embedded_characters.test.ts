/** Characters of other people in players on pages of other people: under a policy, and in frames without an origin. */
import { cpSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import type { StrutPlayer } from "../../web/element";
import { serveFolder } from "../package/server";
import { root } from "../recordings";
import { othersAbsent, rigOfOthers } from "../rigs/others";
import { eventually, launchBrowser } from "./browser";
import { colouredPixels } from "./pixels";

/** Only the character itself may be read from elsewhere, as on the host of a person who gives it away. */
const headersOf = (path: string): Record<string, string> =>
  path.endsWith(".glb") ? { "Access-Control-Allow-Origin": "*" } : {};

/** The policy that docs/embedding.md recommends. */
const POLICY = /```text\n(default-src 'none';[^`]*)```/
  .exec(readFileSync(join(root, "docs", "embedding.md"), "utf8"))?.[1]
  ?.replaceAll("\n", " ")
  .trim();

let browser: Browser;
let folder: string;
let site: Awaited<ReturnType<typeof serveFolder>>;
let policed: typeof site;
beforeAll(async () => {
  folder = mkdtempSync(join(tmpdir(), "strut-embedded-"));
  for (const file of ["embed", "embed.html"]) cpSync(join(root, "dist", file), join(folder, file), { recursive: true });
  for (const file of ["strut-player.js", "strut-character.js", "walk.bin", "walk.bin.js"])
    cpSync(join(root, "dist", "package", file), join(folder, "package", file), { recursive: true });
  if (!othersAbsent) writeFileSync(join(folder, "sophia.glb"), rigOfOthers("m2m-sophia.glb"));
  [browser, site, policed] = await Promise.all([
    launchBrowser(),
    serveFolder(folder, headersOf),
    serveFolder(folder, { "Content-Security-Policy": POLICY ?? "default-src 'none'" }),
  ]);
});
afterAll(async () => {
  await browser.close();
  await site.close();
  await policed.close();
  rmSync(folder, { recursive: true });
});

/** A page with a body, and all that its console says. */
async function open(url: string, body: string): Promise<{ page: Page; console: string[] }> {
  writeFileSync(join(folder, "index.html"), `<!doctype html><meta charset="utf-8"><title>A page</title>${body}`);
  const context = await browser.newContext({ viewport: { width: 500, height: 400 } });
  const page = await context.newPage();
  const said: string[] = [];
  page.on("console", (message) => said.push(message.text()));
  await page.goto(url);
  return { page, console: said };
}

const SOPHIA = 'character="sophia.glb" ghost="off" styles="neutral" loading="eager"';

/** The colours of the player in a page's picture, which has no others. */
const expectColours = (page: Page) =>
  eventually(async () => colouredPixels(browser, await page.screenshot())).toBeGreaterThan(1000);

test("a frame without an origin plays from a host that allows nobody to fetch", async () => {
  const { page } = await open(site.url, '<iframe sandbox="allow-scripts" src="embed.html?styles=old:1"></iframe>');
  const player = page.frameLocator("iframe").locator("strut-player");
  expect(await player.evaluate((element) => (element as StrutPlayer).ready.then(() => "ready", String))).toBe("ready");
  await page.context().close();
});

test.skipIf(othersAbsent)("a textured character has its colours in a frame without an origin", async () => {
  const query = new URLSearchParams({ character: `${site.url}/sophia.glb`, ghost: "off", styles: "neutral" });
  const frame = `<iframe sandbox="allow-scripts" width="480" height="360" src="embed.html?${query}"></iframe>`;
  const { page } = await open(site.url, frame);
  await expectColours(page);
  await page.context().close();
});

test.skipIf(othersAbsent)("a textured character has its colours under the policy that is recommended", async () => {
  expect(POLICY).toContain("script-src 'self' 'wasm-unsafe-eval'");
  const player = `<script src="package/strut-player.js"></script><strut-player ${SOPHIA}></strut-player>`;
  const { page, console: said } = await open(policed.url, player);
  await expectColours(page);
  expect(said.filter((text) => /Content Security Policy|violates/.test(text))).toEqual([]);
  await page.context().close();
});

test("strut-player.js as a module says what to write instead", async () => {
  const { page } = await open(
    site.url,
    `<script>addEventListener("error", ({ message }) => { document.title = message; });</script>
     <script type="module">import("./package/strut-player.js").catch(({ message }) => { document.title = message; });</script>`,
  );
  await eventually(() => page.title()).toContain("strut-player.js does not know where it lies");
  await page.context().close();
});
