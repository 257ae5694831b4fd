/**
 * A textured third-party character in Firefox and WebKit: on the page, under the recommended policy, in a sandboxed
 * iframe.
 */
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import type { Browser } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { launchBrowser, serveSite } from "../e2e/browser";
import { characterOf, frameOf, PLAYER, serveEmbedded } from "../e2e/embedded_folder";
import { colouredPixels, type Part } from "../e2e/pixels";
import { root } from "../recordings";
import { othersAbsent, rigOfOthers } from "../rigs/others";
import { BROWSERS } from "./browsers";
import { type BrowserPage, dropOn } from "./page";

/** Part of the page with the body, away from the panels, whose corners are coloured. */
const STAGE: Part = { x: 0.25, y: 0.15, width: 0.3, height: 0.6 };

describe.skipIf(othersAbsent).for(BROWSERS)("$name", ({ name, path, launch }) => {
  let page: BrowserPage;
  let site: Awaited<ReturnType<typeof serveSite>>;
  let embedded: Awaited<ReturnType<typeof serveEmbedded>>;
  /** Browser that reads the pictures. */
  let reader: Browser;

  beforeAll(async () => {
    if (!path) throw new Error(`${name} is not installed; npm run browsers installs it where it can.`);
    [page, site, embedded, reader] = await Promise.all([launch(), serveSite(), serveEmbedded(), launchBrowser()]);
  });
  afterAll(async () => {
    await page?.close();
    await reader?.close();
    await site?.close();
    await embedded?.close();
  });

  async function expectColours(of: string, part?: Part): Promise<void> {
    let picture: Buffer | undefined;
    const coloured = async () => {
      picture = Buffer.from(await page.picture());
      return colouredPixels(reader, picture, part);
    };
    await expect.poll(coloured, { interval: 1000 }).toBeGreaterThan(1000);
    mkdirSync(join(root, "tests/output"), { recursive: true });
    writeFileSync(join(root, "tests/output", `${name.toLowerCase()}-textured-${of}.png`), picture!);
  }

  it("has its colours on the page", async () => {
    await page.open(`${site.url}#styles=proud:1&ghost=off&play=0`);
    await expect.poll(() => page.evaluate(() => "strut" in window)).toBe(true);
    await dropOn(page, "m2m-sophia.glb", rigOfOthers("m2m-sophia.glb"));
    const performer = () => page.evaluate(() => document.querySelector(".cast-name")?.textContent ?? "");
    await expect.poll(performer).toBe("m2m-sophia");
    await expectColours("page", STAGE);
  });

  it("has its colours in a player under the recommended policy", async () => {
    embedded.write(PLAYER);
    await page.open(embedded.policed.url);
    await expectColours("policy");
  });

  it("has its colours in a sandboxed frame", async () => {
    embedded.write(frameOf(characterOf(embedded.site.url)));
    await page.open(embedded.site.url);
    await expectColours("frame");
  });
});
