/**
 * Pictures of `<strut-player>` with all of its controls: wide, as on a phone, and in a narrow column, in both themes.
 */
import { cpSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Browser } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import type { StrutPlayer } from "../../web/element";
import { launchBrowser } from "../e2e/browser";
import { SWIFTSHADER } from "../e2e/graphics";
import { serveFolder } from "../package/server";
import { root } from "../recordings";
import { expectAsKept, steady, stillPicture } from "./pictures";

/** Widths of the player, pixels. */
const WIDTHS = [1440, 390, 300];
const CASES = WIDTHS.flatMap((width) => (["dark", "light"] as const).map((theme) => [width, theme] as const));

let browser: Browser;
let folder: string;
let server: Awaited<ReturnType<typeof serveFolder>>;
beforeAll(async () => {
  folder = mkdtempSync(join(tmpdir(), "strut-pictures-"));
  for (const file of ["strut-player.js", "walk.bin"]) cpSync(join(root, "dist", "package", file), join(folder, file));
  [browser, server] = await Promise.all([launchBrowser({ graphics: SWIFTSHADER }), serveFolder(folder)]);
});
afterAll(async () => {
  await browser.close();
  await server.close();
  rmSync(folder, { recursive: true });
});

test.each(CASES)("%d pixels wide, %s", async (width, theme) => {
  const html = `<!doctype html><meta charset="utf-8"><title>A page</title><style>body { margin: 0 }</style>
    <script src="strut-player.js"></script>
    <strut-player controls theme="${theme}" frame="160" styles="proud:0.62,old:0.12,childlike:0.26"></strut-player>`;
  writeFileSync(join(folder, "index.html"), html);
  const context = await browser.newContext({ viewport: { width, height: 640 } });
  const page = await context.newPage();
  const errors: string[] = [];
  page.on("pageerror", ({ message }) => errors.push(message));
  await page.addInitScript(steady);
  await page.goto(server.url);
  await page.locator("strut-player").evaluate((player) => (player as StrutPlayer).ready);
  await expectAsKept(page, `player-${width}-${theme}`, await stillPicture(page));
  await context.close();
  expect(errors).toEqual([]);
});
