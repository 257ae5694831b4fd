/** Players on other pages: the page for iframes, its messages, its presets, and the code of the Embed dialog. */
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { writeEmbedPage } from "../../scripts/embed_page.mjs";
import type { StrutPlayer } from "../../web/element";
import { serveFolder } from "../package/server";
import { axeFaults } from "./axe";
import { eventually, openSite } from "./browser";

let site: Awaited<ReturnType<typeof openSite>>;
let folder: string;
let elsewhere: Awaited<ReturnType<typeof serveFolder>>;
beforeAll(async () => {
  folder = mkdtempSync(join(tmpdir(), "strut-embed-"));
  [site, elsewhere] = await Promise.all([openSite(), serveFolder(folder)]);
});
afterAll(async () => {
  await site.close();
  await elsewhere.close();
  rmSync(folder, { recursive: true });
});

/** Opens a page of another host with a body. */
async function openElsewhere(body: string): Promise<Page> {
  writeFileSync(join(folder, "index.html"), `<!doctype html><meta charset="utf-8"><title>A page</title>${body}`);
  const context = await site.browser.newContext({ viewport: { width: 800, height: 600 } });
  const page = await context.newPage();
  await page.goto(elsewhere.url);
  return page;
}

/** Returns the player in a page's iframe, once it is ready. */
async function playerIn(page: Page) {
  const player = page.frameLocator("iframe").locator("strut-player");
  await player.evaluate((element) => (element as StrutPlayer).ready);
  return player;
}

describe("the page for frames", () => {
  test("shows what its address says, on a page of another host, and walks", async () => {
    const address = `${site.site.url}embed.html?styles=old:1&theme=dark&autoplay&utm_source=mail#?secret=abc`;
    const page = await openElsewhere(`<iframe title="A walk" width="688" height="342" src="${address}"></iframe>`);
    const player = await playerIn(page);
    expect(await player.evaluate((element) => (element as StrutPlayer).styles)).toEqual({ old: 1 });
    await eventually(() => player.evaluate((element) => (element as StrutPlayer).currentTime)).toBeGreaterThan(0.1);
    await page.context().close();
  });

  test("takes settings from the page around it, tells them, and loads nothing for it", async () => {
    const page = await openElsewhere(`<iframe title="A walk" src="${site.site.url}embed.html?styles=old:1"></iframe>`);
    const player = await playerIn(page);
    const told = await page.evaluate(() => {
      const frame = document.querySelector("iframe")!.contentWindow!;
      const answered = new Promise((resolve) =>
        addEventListener("message", ({ data }) => data.event === undefined && resolve(data)),
      );
      frame.postMessage(
        { strut: 1, set: { styles: "proud:1", src: "https://example.org/x.bvh" }, get: ["styles"] },
        "*",
      );
      return answered;
    });
    expect(told).toEqual({ strut: 1, state: { styles: "proud:1" } });
    expect(await player.evaluate((element) => element.hasAttribute("src"))).toBe(false);
    await page.context().close();
  });

  test("tells the page around it what a visitor chose", async () => {
    const page = await openElsewhere(
      `<script>told = []; addEventListener("message", ({ data }) => told.push(data.event + " " + data.state.styles));</script>
       <iframe title="A walk" width="688" height="342" src="${site.site.url}embed.html?styles=old:1&controls"></iframe>`,
    );
    const player = await playerIn(page);
    await player.getByRole("slider", { name: "Style" }).press("ArrowUp");
    await eventually(() => page.evaluate(() => (globalThis as unknown as { told: string[] }).told.join())).toMatch(
      /ready old:1.*stylechange .*old:0\.9/,
    );
    await page.context().close();
  });

  test("has pages of presets that oEmbed finds, with absolute addresses", async () => {
    const at = "https://strut.example/a/";
    await writeEmbedPage({ site: at, dist: folder });
    const page = readFileSync(join(folder, "embed", "old-walk", "index.html"), "utf8");
    const found = /application\/json\+oembed" href="([^"]+)"/.exec(page)![1]!;
    expect(found).toBe(`${at}embed/old-walk/oembed.json`);
    const answer = JSON.parse(readFileSync(join(folder, new URL(found).pathname.slice("/a/".length)), "utf8"));
    expect(answer).toMatchObject({
      version: "1.0",
      type: "rich",
      width: 688,
      thumbnail_width: 688,
      thumbnail_height: 300,
    });
    expect(answer.html).toContain(`<iframe src="${at}embed.html?styles=old%3A1&amp;`);
  });
});

describe("the Embed dialog", () => {
  test("gives code that shows the same figure on another page, as a frame and as an element", async () => {
    const { page } = site;
    await page.getByRole("button", { name: "Embed" }).click();
    const dialog = page.getByRole("dialog", { name: "Embed" });
    await dialog.getByRole("radio", { name: "Off" }).check();
    const code = dialog.getByRole("textbox", { name: "Code to copy" });
    await eventually(() => code.inputValue()).toContain("ghost=off");
    const frame = await code.inputValue();
    await dialog.getByRole("radio", { name: "Element" }).check();
    await eventually(() => code.inputValue()).toContain("<strut-player");
    const element = await code.inputValue();
    await eventually(() => axeFaults(page)).toEqual([]);
    // Three figures at once are too slow on a machine without a GPU.
    await dialog.getByRole("button", { name: "Close" }).click();
    await eventually(() => dialog.count()).toBe(0);
    const shown = await page.evaluate(
      () => (window as never as { strut: { state: { styles: object } } }).strut.state.styles,
    );
    const weights = Object.fromEntries((shown as { name: string; weight: number }[]).map((s) => [s.name, s.weight]));
    for (const body of [frame, element]) {
      const other = await openElsewhere(body);
      const inside = body === frame ? other.frameLocator("iframe") : other;
      const said = await inside.locator("strut-player").evaluate(async (found) => {
        const player = found as StrutPlayer;
        await player.ready;
        return { styles: player.styles, ghost: player.ghost, paused: player.paused };
      });
      expect(said).toEqual({ styles: weights, ghost: "off", paused: false });
      await other.context().close();
    }
  });
});
