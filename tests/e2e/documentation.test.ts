// Every page of the documentation in Chromium, from a nested folder and without a network.
import { mkdirSync, mkdtempSync, readdirSync, rmSync, symlinkSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import type { RunOptions } from "axe-core";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import { OUT, writeDocs } from "../../scripts/docs/site.mjs";
import type { StrutPlayer } from "../../web/element";
import { serveFolder } from "../package/server";
import { root } from "../recordings";
import { axeFaults } from "./axe";
import { drawn, eventually, launchBrowser, screenshot } from "./browser";

let browser: Browser;
let folder: string;
let server: Awaited<ReturnType<typeof serveFolder>>;
/** Address of the documentation. */
let site: string;

beforeAll(async () => {
  await writeDocs();
  folder = mkdtempSync(join(tmpdir(), "strut-site-"));
  mkdirSync(join(folder, "a"));
  symlinkSync(join(root, "dist"), join(folder, "a", "b"));
  server = await serveFolder(folder);
  site = `${server.url}/a/b/docs/`;
  browser = await launchBrowser();
}, 900_000);
afterAll(async () => {
  await browser.close();
  await server.close();
  rmSync(folder, { recursive: true });
});

/** Waits until fonts have arrived and what they change has been laid out. */
async function laidOut(page: Page): Promise<void> {
  await page.evaluate(() => document.fonts.ready.then(() => {}));
  await drawn(page, 2);
}

const pages = () => readdirSync(OUT, { recursive: true, encoding: "utf8" }).filter((name) => name.endsWith(".html"));

/** Opens a page without access to other hosts, and records its errors. */
async function openOffline(theme: "dark" | "light", width: number): Promise<{ page: Page; complaints: string[] }> {
  const context = await browser.newContext({
    viewport: { width, height: 844 },
    colorScheme: theme,
    deviceScaleFactor: 0.5,
  });
  const complaints: string[] = [];
  await context.route(
    (url) => url.protocol.startsWith("http") && url.origin !== server.url,
    (route) => {
      complaints.push(`asks for ${route.request().url()}`);
      return route.abort();
    },
  );
  const page = await context.newPage();
  page.on("pageerror", (error) => complaints.push(error.message));
  page.on("console", (line) => {
    if (line.type() === "error") complaints.push(`${line.text()} (${line.location().url})`);
  });
  return { page, complaints };
}

/** Pages with all kinds of elements; all pages share one style sheet. */
const COLOURED = ["index.html", "concepts/style-transfer.html", "reference/errors.html", "examples/plain.html"];

test("every page is readable by everybody and complains of nothing", async () => {
  const { page, complaints } = await openOffline("light", 1280);
  const faults: string[] = [];
  // Figures have their own tests.
  await page.route("**/{strut-player,strut-figure}.js", (route) =>
    route.fulfill({ contentType: "text/javascript", body: "" }),
  );
  const check = async (name: string, options: RunOptions) =>
    faults.push(...(await axeFaults(page, options)).map((fault) => `${name}: ${fault}`));
  for (const name of pages()) {
    await page.goto(`${site}${name}`);
    await laidOut(page);
    // This test checks every word; colours are tested below.
    await check(name, { rules: { "color-contrast": { enabled: false } }, resultTypes: ["violations"] });
    faults.push(...complaints.splice(0).map((complaint) => `${name}: ${complaint}`));
  }
  for (const name of COLOURED) {
    await page.goto(`${site}${name}`);
    for (const theme of ["dark", "light"]) {
      await page.evaluate((chosen) => {
        document.documentElement.dataset.theme = chosen;
      }, theme);
      await check(`${name}, ${theme}`, { runOnly: ["color-contrast"] });
    }
  }
  await page.context().close();
  expect(faults).toEqual([]);
});

test("players and figures on pages are alive", async () => {
  const { page, complaints } = await openOffline("dark", 1280);
  await page.goto(`${site}index.html`);
  await page.locator("strut-player").evaluate((player) => (player as StrutPlayer).ready);
  await screenshot(page, "documentation-player");
  for (const name of ["style-transfer", "walk-synthesis", "key-styling"]) {
    await page.goto(`${site}concepts/${name}.html`);
    const figure = page.locator("strut-figure");
    await figure.scrollIntoViewIfNeeded();
    await eventually(() => figure.evaluate((element) => element.shadowRoot?.querySelector("svg, canvas") !== null));
  }
  await page.context().close();
  expect(complaints).toEqual([]);
});

test("the search finds a command by keys alone, and a page from a disk is whole", async () => {
  const { page, complaints } = await openOffline("light", 1280);
  for (const address of [site, `${pathToFileURL(OUT)}/`]) {
    await page.goto(`${address}get-started.html`);
    await page.keyboard.press("/");
    await page.keyboard.type("stylize-batch");
    await page.locator(".results a").first().waitFor();
    await page.keyboard.press("ArrowDown");
    await page.keyboard.press("Enter");
    await page.waitForURL(/reference\/command-line\.html#strut-stylize-batch$/);
  }
  await page.context().close();
  expect(complaints).toEqual([]);
});

test("on a phone the map opens and leads on, and no page is wider than the screen", async () => {
  const { page } = await openOffline("light", 390);
  await page.goto(`${site}get-started.html`);
  await page.getByRole("button", { name: "Pages" }).click();
  await page.locator("#map").getByRole("link", { name: "Glossary" }).click();
  await page.waitForURL(/glossary/);
  const wide: string[] = [];
  for (const name of pages()) {
    await page.goto(`${site}${name}`);
    if (await page.evaluate(() => document.documentElement.scrollWidth > innerWidth)) wide.push(name);
  }
  await page.context().close();
  expect(wide).toEqual([]);
});
