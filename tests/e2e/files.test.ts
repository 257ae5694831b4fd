/** File import and export: a real BVH, broken ones, and the export. */
import { readFileSync } from "node:fs";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { beforeAll, describe, expect, it } from "vitest";
import type { StrutHook } from "../../web/app/shell/hook";
import { recordings } from "../recordings";
import {
  dropFile,
  eventually,
  inputName,
  openSite,
  saved,
  screenshot,
  type serveSite,
  settledPose,
  styledPose,
  turnBetween,
  visit,
} from "./browser";

declare const window: { strut: StrutHook };

let browser: Browser;
let site: Awaited<ReturnType<typeof serveSite>>;
let page: Page;

beforeAll(async () => {
  const opened = await openSite();
  browser = opened.browser;
  site = opened.site;
  page = opened.page;
  return opened.close;
});

const data = recordings();
const alert = () => page.getByRole("alert");

/** Exports and returns the name and text of the file. */
async function exported(): Promise<{ name: string; text: string }> {
  const { name, bytes } = await saved(page, "BVH");
  return { name, text: bytes.toString() };
}

describe("a BVH that is dropped", () => {
  for (const [name, path] of [
    ["bandai-namco-2", "bandai-namco-2/dataset-2_walk_normal_001.bvh"],
    ["xia", "xia/neutral_01_000.bvh"],
  ] as const)
    it.skipIf(!data)(`walks in the style (${name})`, async () => {
      await visit(page, "styles=proud:1,old:0,depressed:0");
      await eventually(() => inputName(page)).toBe("neutral walk");
      const file = path.split("/").at(-1)!;
      await dropFile(page, file, readFileSync(join(data!, path)));
      await eventually(() => inputName(page)).toBe(file.replace(".bvh", ""));
      await page.waitForFunction(() => window.strut.analysed && window.strut.frame!.inputFrame > 30);
      // The same instant of the same walk, with and without the style.
      await page.keyboard.press("Space");
      const styled = await settledPose(page);
      expect(styled.every(Number.isFinite)).toBe(true);
      await page.getByRole("slider", { name: "Intensity" }).fill("0");
      expect(turnBetween(styled, await settledPose(page))).toBeGreaterThan(1);
      expect(await alert().textContent()).toBe("");
      await screenshot(page, `dropped-${name}`);
    });

  it.skipIf(!data)("is exported on its own skeleton", async () => {
    await visit(page, "styles=proud:1,old:0,depressed:0");
    await eventually(() => inputName(page)).toBe("neutral walk");
    const file = readFileSync(join(data!, "xia/neutral_01_000.bvh"), "utf8");
    await dropFile(page, "neutral_01_000.bvh", file);
    await eventually(() => inputName(page)).toBe("neutral_01_000");
    const { name, text } = await exported();
    expect(name).toBe("neutral-01-000-proud.bvh");
    const joints = (bvh: string) => [...bvh.matchAll(/(?:ROOT|JOINT)\s+(\S+)/g)].map((match) => match[1]);
    expect(joints(text)).toEqual(joints(file));
  });
});

describe("an export", () => {
  it("opens again as an input", async () => {
    await visit(page, "play=0&frame=60&styles=old:1,proud:0,depressed:0");
    await eventually(() => inputName(page)).toBe("neutral walk");
    const { name, text } = await exported();
    expect(name).toMatch(/-old\.bvh$/);
    await dropFile(page, name, text);
    await eventually(() => inputName(page)).toBe(name.replace(".bvh", ""));
    expect(await alert().textContent()).toBe("");
    // Undo restores the previous input, redo the dropped one.
    await page.keyboard.press("Control+z");
    await eventually(() => inputName(page)).not.toBe(name.replace(".bvh", ""));
    await page.keyboard.press("Control+Shift+z");
    await eventually(() => inputName(page)).toBe(name.replace(".bvh", ""));
  });
});

describe("a file that cannot be used", () => {
  const truncated = "HIERARCHY\nROOT Hips\n{\n  OFFSET 0 0 0\n  CHANNELS 6 Xposition Yposition Zposition";
  const files: [what: string, name: string, content: string | Uint8Array][] = [
    ["an empty BVH", "empty.bvh", ""],
    ["a text file by the name of BVH", "letter.bvh", "Dear Sir or Madam,\nno motion here.\n"],
    ["a BVH that stops in its hierarchy", "cut.bvh", truncated],
    ["a picture", "picture.png", new Uint8Array([137, 80, 78, 71])],
    ["a broken database", "broken.strutdb", new Uint8Array([1, 2, 3, 4, 5, 6, 7, 8, 9])],
  ];

  it("gets a sentence each, and what was on screen stays", async () => {
    await visit(page, "play=0&frame=60");
    const before = await settledPose(page);
    const input = await inputName(page);
    expect(input).toBe("neutral walk");
    for (const [what, name, content] of files) {
      await dropFile(page, name, content);
      await eventually(() => alert().textContent(), what).toMatch(/\.$/);
      if (name === "letter.bvh") await screenshot(page, "broken-file");
      await alert().getByRole("button", { name: "Dismiss" }).click();
      await eventually(() => alert().textContent(), what).toBe("");
      expect(await inputName(page), what).toBe(input);
    }
    expect(turnBetween(before, await settledPose(page))).toBeLessThan(0.2);
    await page.keyboard.press("Space");
    await eventually(async () => turnBetween(before, await styledPose(page))).toBeGreaterThan(1);
  });
});

describe("without a network", () => {
  it("the page says what it could not load", async () => {
    const context = await browser.newContext();
    await context.route("**/built_in*.bin", (route) => route.abort());
    const offline = await context.newPage();
    await offline.goto(site.url);
    const said = () => offline.getByRole("alert").textContent();
    await eventually(said).toContain("The built-in motions could not be loaded: the server cannot be reached for /");
    await context.close();
  });
});
