/**
 * Comparison of pictures with those that a person has approved (`pictures/`). STRUT_UPDATE_PICTURES=1 replaces those
 * that differ: look at them.
 */
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { resolve } from "node:path";
import type { Page } from "playwright-core";
import { expect } from "vitest";

const PICTURES = resolve(import.meta.dirname, "pictures");
/** Folder of the pictures that differ, which git ignores. */
const OUTPUT = resolve(import.meta.dirname, "../output");
const UPDATE = process.env.STRUT_UPDATE_PICTURES === "1";

/**
 * Pictures are compared in squares of this many pixels of the halved picture, so that a small fault is not averaged
 * out.
 */
const REGION = 90;
/** Greatest share of the pixels of a region that may differ. */
const MOST_DIFFERENT = 0.002;
/** Difference of a colour channel, 0–255, from which a pixel counts as different. */
const DIFFERENT = 28;

/**
 * Makes pictures of a page reproducible: hides measured values and playing previews, and lets a second pass between
 * animation frames. Transitions then end immediately, and no measured frame rate lowers the quality of the 3D picture.
 */
export function steady(): void {
  const request = window.requestAnimationFrame.bind(window);
  let frames = 0;
  let counted = -1;
  window.requestAnimationFrame = (callback) =>
    request((now) => {
      if (now !== counted) frames++;
      counted = now;
      callback(1000 * frames);
    });
  const hidden =
    ".read-out, .compare-table > div:last-child, .model-menu summary, .toasts, .preview-view, .crowd-figures";
  const sheet = new CSSStyleSheet();
  sheet.replaceSync(`${hidden} { visibility: hidden }`);
  document.adoptedStyleSheets = [sheet];
}

/**
 * Returns the picture once nothing moves any more: each 3D view draws a refined one after it has been unchanged for a
 * while.
 */
export async function stillPicture(page: Page): Promise<Buffer> {
  await page.waitForFunction(() =>
    [document, ...[...document.querySelectorAll("*")].flatMap(({ shadowRoot }) => shadowRoot ?? [])]
      .flatMap((root) => [...root.querySelectorAll("canvas[role=application]")])
      .filter((canvas) => canvas.checkVisibility({ visibilityProperty: true }))
      .every((canvas) => canvas.hasAttribute("data-still")),
  );
  let before = await page.screenshot();
  for (let i = 0, same = 0; i < 40 && same < 2; i++) {
    await page.waitForTimeout(200);
    const now = await page.screenshot();
    same = now.equals(before) ? same + 1 : 0;
    before = now;
  }
  return before;
}

/** Difference between a picture and the stored one. */
interface Comparison {
  /** The picture at half size as WebP. */
  webp: string;
  /** The halved picture with the pixels that differ in red, as PNG. */
  marked: string;
  /** Regions in which too many pixels differ: positions on the page and shares, `864,180: 1.3 %`. */
  regions: string[];
}

function compare(page: Page, picture: Buffer, kept: Buffer | undefined): Promise<Comparison> {
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

/** Expects that a picture equals the stored one of that name, or stores it. */
export async function expectAsKept(page: Page, name: string, picture: Buffer): Promise<void> {
  const file = resolve(PICTURES, `${name}.webp`);
  const { webp, marked, regions } = await compare(page, picture, existsSync(file) ? readFileSync(file) : undefined);
  const write = (path: string, dataUrl: string) => writeFileSync(path, Buffer.from(dataUrl.split(",")[1]!, "base64"));
  if (UPDATE) {
    mkdirSync(PICTURES, { recursive: true });
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
}
