/**
 * What the page looks like: pictures of every view, in both themes, wide and narrow and in the middle of things, beside
 * those that a person has looked at (`pictures/`). STRUT_UPDATE_PICTURES=1 writes those anew that differ: look at them.
 */
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { resolve } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import type { StrutHook } from "../../web/app/shell/hook";
import { closePage, dragHolding, launchBrowser, middleOf, openPage, saved, serveSite } from "../e2e/browser";
import { SWIFTSHADER } from "../e2e/graphics";

declare const window: Window & { strut?: StrutHook };

const PICTURES = resolve(import.meta.dirname, "pictures");
/** Where pictures go that differ; git ignores it. */
const OUTPUT = resolve(import.meta.dirname, "../output");
const UPDATE = process.env.STRUT_UPDATE_PICTURES === "1";
const WIDE = { width: 1440, height: 900 };
const NARROW = { width: 390, height: 844 };

/** Pictures are compared in squares of this many pixels of the halved picture, so that a small fault is not outvoted. */
const REGION = 90;
/** Share of the pixels of a region that may differ. */
const MOST_DIFFERENT = 0.002;
/** Difference of a colour channel, 0–255, from which a pixel differs. */
const DIFFERENT = 28;

/** The same second of the same motion everywhere. */
const SECOND = "play=0&frame=160&styles=proud:0.62,old:0.12,childlike:0.26";

interface Case {
  name: string;
  hash: string;
  size: { width: number; height: number };
  theme: "dark" | "light";
  /** What a person is in the middle of. */
  act?: (page: Page) => Promise<void>;
}

/** Neutral, proud and old in turn, as in the design's picture. */
const WALK = "play=0&view=walk&block=1&walk=1_3_3~neutral:1;1_4_2~proud:1,old:0,sexy:0;1_3_2~old:1";

/** Goes into the transition to the second block. */
async function walkOn(page: Page): Promise<void> {
  await page.locator('.planner-block, [data-key="block-0"]').first().waitFor();
  const { width } = (await page.locator(".planner .timeline-seek").boundingBox())!;
  await page.locator(".planner .timeline-seek").click({ position: { x: 0.24 * width, y: 6 } });
  await page.mouse.move(1, 1);
}

/** Holds the handle of the polygon half way to a corner. */
async function dragHandle(page: Page): Promise<void> {
  const from = await middleOf(page.getByRole("slider", { name: "Style", exact: true }));
  const to = await middleOf(page.locator('.vertex[data-style="old"] .vertex-dot'));
  await dragHolding(page, from, { x: (from.x + to.x) / 2, y: (from.y + to.y) / 2 });
}

/** Drops clips of two styles, of which one has no name that tells. */
async function dropClips(page: Page): Promise<void> {
  const names = ["walk_neutral_1.bvh", "walk_old_1.bvh", "walk_old_2.bvh", "run_neutral_1.bvh", "something.bvh"];
  const files = names.map((name) => ({ name, mimeType: "text/plain", buffer: clip }));
  await page.locator("input[type=file][multiple]").last().setInputFiles(files);
  await page.locator('.data[aria-busy="false"]').waitFor();
}

/** The third key of the built-in punches: the left hand is out. */
const PUNCH = "play=0&view=key-style&set=punch&keyno=2&secs=0.4";
/** The middle of a step. */
const STEP = "play=0&view=key-style&secs=0.3";

/** Waits until the motions are learned; what the link before asked for may still be on the stage. */
async function learn(page: Page): Promise<void> {
  await page.locator('.key-style[aria-busy="false"] .pad-key').first().waitFor();
}

const CASES: readonly Case[] = [
  { name: "play-wide-dark", hash: SECOND, size: WIDE, theme: "dark" },
  { name: "play-wide-light", hash: SECOND, size: WIDE, theme: "light" },
  { name: "play-narrow-dark", hash: SECOND, size: NARROW, theme: "dark" },
  { name: "play-narrow-light-curves", hash: `${SECOND}&tab=curves`, size: NARROW, theme: "light" },
  { name: "play-dragging", hash: SECOND, size: WIDE, theme: "dark", act: dragHandle },
  {
    name: "play-track-trail-light",
    hash: `${SECOND}&track=60~proud:1,old:0,childlike:0;600~proud:0,old:1,childlike:0&key=1&range=60-620&trail=onion&ghost=off`,
    size: WIDE,
    theme: "light",
  },
  { name: "play-beyond", hash: `${SECOND}&intensity=1.9&part=legs&parts=legs~angry:1`, size: WIDE, theme: "dark" },
  { name: "compare-wide-light", hash: `${SECOND}&view=compare`, size: WIDE, theme: "light" },
  {
    name: "compare-wide-dark",
    hash: `${SECOND}&view=compare&columns=input,mar&behind=input`,
    size: WIDE,
    theme: "dark",
  },
  { name: "compare-narrow-dark", hash: `${SECOND}&view=compare`, size: NARROW, theme: "dark" },
  { name: "walk-wide-dark", hash: WALK, size: WIDE, theme: "dark", act: walkOn },
  { name: "walk-strip-light", hash: `${WALK}&strip=1`, size: WIDE, theme: "light", act: walkOn },
  {
    name: "walk-feet-light",
    hash: "play=0&view=walk&walk=1.4_4_2~proud:1,old:0,sexy:0;r~old:1&tempo=fixed&cadence=96&plot=left_lower_leg",
    size: WIDE,
    theme: "light",
    act: walkOn,
  },
  { name: "walk-narrow-dark", hash: WALK, size: NARROW, theme: "dark", act: walkOn },
  { name: "key-style-wide-dark", hash: PUNCH, size: WIDE, theme: "dark", act: learn },
  { name: "key-style-wide-light", hash: STEP, size: WIDE, theme: "light", act: learn },
  { name: "key-style-three-dark", hash: `${STEP}&between=all`, size: WIDE, theme: "dark", act: learn },
  { name: "key-style-narrow-dark", hash: PUNCH, size: NARROW, theme: "dark", act: learn },
  { name: "data-empty-wide-dark", hash: "play=0&view=data", size: WIDE, theme: "dark" },
  { name: "data-wide-light", hash: "play=0&view=data", size: WIDE, theme: "light", act: dropClips },
  { name: "data-narrow-dark", hash: "play=0&view=data", size: NARROW, theme: "dark", act: dropClips },
];

let browser: Browser;
let site: Awaited<ReturnType<typeof serveSite>>;
let page: Page;
/** A motion that may be shown to anyone. */
let clip: Buffer;

beforeAll(async () => {
  [browser, site] = await Promise.all([launchBrowser(SWIFTSHADER), serveSite()]);
  page = await openPage(browser, site.url, { size: WIDE });
  clip = (await saved(page, "BVH")).bytes;
  await page.addInitScript(steady);
  mkdirSync(PICTURES, { recursive: true });
});
afterAll(async () => {
  await closePage(page).finally(async () => {
    await browser.close();
    await site.close();
  });
});

/**
 * Makes pictures of a page the same every time: hides what is measured and previews, which play, and lets a second pass
 * from each animation frame to the next. Glides then end at once, and no rate of frames is measured that would lower the
 * quality of the 3-D picture.
 */
function steady(): void {
  const request = window.requestAnimationFrame.bind(window);
  let frames = 0;
  let counted = -1;
  window.requestAnimationFrame = (callback) =>
    request((now) => {
      if (now !== counted) frames++;
      counted = now;
      callback(1000 * frames);
    });
  const hidden = ".read-out, .compare-table > div:last-child, .model-menu summary, .toasts, .preview-view";
  const sheet = new CSSStyleSheet();
  sheet.replaceSync(`${hidden} { visibility: hidden }`);
  document.adoptedStyleSheets = [sheet];
}

/** The picture once nothing moves any more: each 3-D view draws a finer one when it has stood still for a while. */
async function stillPicture(): Promise<Buffer> {
  await page.waitForFunction(() =>
    [...document.querySelectorAll("canvas[role=application]")]
      .filter((canvas) => canvas.checkVisibility({ visibilityProperty: true }))
      .every((canvas) => canvas.hasAttribute("data-still")),
  );
  let before = await page.screenshot();
  for (let i = 0; i < 20; i++) {
    await page.waitForTimeout(300);
    const now = await page.screenshot();
    if (now.equals(before)) return now;
    before = now;
  }
  return before;
}

/** How a picture differs from the one that was kept. */
interface Comparison {
  /** Half the picture's size as WebP. */
  webp: string;
  /** The halved picture with the pixels that differ in red, as PNG. */
  marked: string;
  /** Regions in which too many pixels differ: places on the page and shares, `864,180: 1.3 %`. */
  regions: string[];
}

function compare(picture: Buffer, kept: Buffer | undefined): Promise<Comparison> {
  const url = (bytes: Buffer, type: string) => `data:image/${type};base64,${bytes.toString("base64")}`;
  return page.evaluate(
    async ({ picture, kept, threshold, side, most }) => {
      const load = async (source: string) => {
        const image = new Image();
        image.src = source;
        await image.decode();
        return image;
      };
      const draw = (image: HTMLImageElement, width: number, height: number) => {
        const canvas = document.createElement("canvas");
        [canvas.width, canvas.height] = [width, height];
        const context = canvas.getContext("2d", { willReadFrequently: true })!;
        context.imageSmoothingQuality = "high";
        context.drawImage(image, 0, 0, width, height);
        return { canvas, context, data: context.getImageData(0, 0, width, height).data };
      };
      const now = await load(picture);
      const [width, height] = [now.width / 2, now.height / 2];
      const webp = draw(now, width, height).canvas.toDataURL("image/webp", 0.9);
      if (!kept) return { webp, marked: webp, regions: ["everywhere"] };
      const before = draw(await load(kept), width, height).data;
      const after = draw(await load(webp), width, height);
      const regions: string[] = [];
      for (let top = 0; top < height; top += side)
        for (let left = 0; left < width; left += side) {
          const [right, bottom] = [Math.min(width, left + side), Math.min(height, top + side)];
          let count = 0;
          for (let y = top; y < bottom; y++)
            for (let x = left; x < right; x++) {
              const i = 4 * (y * width + x);
              if (![0, 1, 2].some((k) => Math.abs(after.data[i + k]! - before[i + k]!) > threshold)) continue;
              count++;
              after.context.fillStyle = "red";
              after.context.fillRect(x, y, 1, 1);
            }
          const share = count / ((right - left) * (bottom - top));
          if (share > most) regions.push(`${2 * left},${2 * top}: ${(100 * share).toFixed(1)} %`);
        }
      return { webp, marked: after.canvas.toDataURL("image/png"), regions };
    },
    {
      picture: url(picture, "png"),
      kept: kept && url(kept, "webp"),
      threshold: DIFFERENT,
      side: REGION,
      most: MOST_DIFFERENT,
    },
  );
}

describe("the page looks as it did when it was last looked at", () => {
  for (const { name, hash, size, theme, act } of CASES)
    it(name, async () => {
      await page.setViewportSize(size);
      await page.emulateMedia({ colorScheme: theme });
      // Loaded anew: where the camera comes to rest depends on what was seen before.
      await page.goto("about:blank");
      await page.goto(`${site.url}#${hash}`);
      await page.waitForFunction(() => window.strut?.analysed && window.strut.upToDate);
      await page.mouse.move(1, 1);
      await act?.(page);
      const picture = await stillPicture();
      if (act) await page.mouse.up();
      const file = resolve(PICTURES, `${name}.webp`);
      const { webp, marked, regions } = await compare(picture, existsSync(file) ? readFileSync(file) : undefined);
      const write = (path: string, dataUrl: string) =>
        writeFileSync(path, Buffer.from(dataUrl.split(",")[1]!, "base64"));
      if (UPDATE) {
        if (regions.length > 0) write(file, webp);
        return;
      }
      expect(existsSync(file), `${file} is missing; STRUT_UPDATE_PICTURES=1 makes it`).toBe(true);
      if (regions.length > 0) {
        mkdirSync(OUTPUT, { recursive: true });
        write(resolve(OUTPUT, `${name}.webp`), webp);
        write(resolve(OUTPUT, `${name}-differs.png`), marked);
      }
      expect(regions, `what differs is red in ${OUTPUT}/${name}-differs.png`).toEqual([]);
    });
});
