/**
 * Pictures of every view, in both themes, wide and narrow and in various states, compared with those that a person has
 * approved (`pictures/`).
 */
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, it } from "vitest";
import type { StrutHook } from "../../web/app/shell/hook";
import {
  closePage,
  dragHolding,
  eventually,
  launchBrowser,
  middleOf,
  openPage,
  saved,
  serveSite,
  shown,
} from "../e2e/browser";
import { SWIFTSHADER } from "../e2e/graphics";
import { expectAsKept, steady, stillPicture } from "./pictures";

declare const window: Window & { strut?: StrutHook };

const WIDE = { width: 1440, height: 900 };
const NARROW = { width: 390, height: 844 };

/** The same instant of the same motion everywhere. */
const SECOND = "play=0&frame=160&styles=proud:0.62,old:0.12,childlike:0.26";

interface Case {
  name: string;
  hash: string;
  size: { width: number; height: number };
  theme: "dark" | "light";
  /** Whether the view has no 3D picture. */
  flat?: true;
  /** Brings the page into an intermediate state of an interaction. */
  act?: (page: Page) => Promise<void>;
}

/** Neutral, proud and old in turn, as in the design's picture. */
const WALK = "play=0&view=walk&block=1&walk=1_3_3~neutral:1;1_4_2~proud:1,old:0,sexy:0;1_3_2~old:1";

/** Seeks into the transition to the second block. */
async function walkOn(page: Page): Promise<void> {
  await page.locator('.planner-block, [data-key="block-0"]').first().waitFor();
  const { width } = (await page.locator(".planner .timeline-seek").boundingBox())!;
  await page.locator(".planner .timeline-seek").click({ position: { x: 0.24 * width, y: 6 } });
  await page.mouse.move(1, 1);
}

/** Waits until the atlas is drawn. */
async function mapped(page: Page): Promise<void> {
  // Then it shows how long that took.
  await page.locator(".atlas[data-drawn]").waitFor();
  await page.locator(".atlas-by").evaluate((by: HTMLElement) => by.style.setProperty("visibility", "hidden"));
}

/** Holds the handle of the polygon half way to a corner. */
async function dragHandle(page: Page): Promise<void> {
  const from = await middleOf(page.getByRole("slider", { name: "Style", exact: true }));
  const to = await middleOf(page.locator('.vertex[data-style="old"] .vertex-dot'));
  await dragHolding(page, from, { x: (from.x + to.x) / 2, y: (from.y + to.y) / 2 });
}

/** Waits until every column has its values. */
async function compared(page: Page): Promise<void> {
  // The figure behind is computed last, and the last column's first value is its distance from that.
  await eventually(() => page.locator(".compare-table").last().locator("dd").first().textContent()).toMatch(/\d/);
  await page.locator(".compare .progress").first().waitFor({ state: "hidden" });
}

/** Waits for the list of public data sets. */
async function listed(page: Page): Promise<void> {
  await page.locator(".catalogue li button:enabled").first().waitFor();
}

/** Drops clips of two styles, one of which has a meaningless name. */
async function dropClips(page: Page): Promise<void> {
  await listed(page);
  const names = ["walk_neutral_1.bvh", "walk_old_1.bvh", "walk_old_2.bvh", "run_neutral_1.bvh", "something.bvh"];
  const files = names.map((name) => ({ name, mimeType: "text/plain", buffer: clip }));
  await page.locator("input[type=file][multiple]").last().setInputFiles(files);
  await page.locator('.data[aria-busy="false"]').waitFor();
}

/** The third key of the built-in punches: the left hand is extended. */
const PUNCH = "play=0&view=key-style&set=punch&keyno=2&secs=0.4";
/** The middle of a step. */
const STEP = "play=0&view=key-style&secs=0.3";

/** Waits until the model is trained; the model of the previous link may still be displayed. */
async function learn(page: Page): Promise<void> {
  await page.locator('.key-style[aria-busy="false"] .pad-key').first().waitFor();
}

/** Waits until the crowd is present. */
async function gathered(page: Page): Promise<void> {
  await page.locator(".crowd-foot .button:enabled").first().waitFor();
  await eventually(() => page.locator(".crowd-chart canvas").getAttribute("aria-label")).toMatch(/average \d/);
}

/** Waits until every figure of the lesson shows its state and its sentence. */
async function figured(page: Page): Promise<void> {
  const figures = page.locator("strut-figure:not([hidden]) :is(.readout, .bars)");
  await figures.first().waitFor({ state: "attached" });
  await page.evaluate(async () => {
    for (const figure of document.querySelectorAll("strut-figure:not([hidden])"))
      await (figure as HTMLElement & { ready(): Promise<void> }).ready();
  });
  await eventually(async () => (await figures.allTextContents()).filter((text) => text.trim() === "")).toEqual([]);
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
  { name: "play-atlas-light", hash: `${SECOND}&atlas=whole`, size: WIDE, theme: "light", act: mapped },
  { name: "play-atlas-narrow-dark", hash: `${SECOND}&tab=curves&atlas=legs`, size: NARROW, theme: "dark", act: mapped },
  { name: "play-beyond", hash: `${SECOND}&intensity=1.9&part=legs&parts=legs~angry:1`, size: WIDE, theme: "dark" },
  { name: "learn-style-light", hash: "play=0&view=learn&beat=4", size: WIDE, theme: "light", act: figured },
  {
    name: "learn-line-dark",
    hash: "play=0&view=learn&lesson=line&beat=5&K=12&nu=4&taper=0&ridge=0.02",
    size: WIDE,
    theme: "dark",
    flat: true,
    act: figured,
  },
  {
    name: "learn-line-narrow-light",
    hash: "play=0&view=learn&lesson=line&beat=4",
    size: NARROW,
    theme: "light",
    flat: true,
    act: figured,
  },
  {
    name: "learn-mix-light",
    hash: "play=0&view=learn&lesson=mix&beat=4&i=137",
    size: WIDE,
    theme: "light",
    flat: true,
    act: figured,
  },
  // The other lessons, each while its exercises are solved.
  ...(
    [
      ["pose", "dark", undefined],
      ["register", "light", undefined],
      ["near", "dark", undefined],
      ["bias", "light", undefined],
      ["time", "dark", true],
      ["feet", "light", true],
      ["judge", "dark", true],
      ["chain", "light", true],
      ["map", "dark", true],
    ] as const
  ).map(([lesson, theme, flat]) => ({
    name: `learn-${lesson}-${theme}`,
    hash: `play=0&view=learn&lesson=${lesson}&beat=4`,
    size: WIDE,
    theme,
    ...(flat && { flat }),
    act: figured,
  })),
  { name: "compare-wide-light", hash: `${SECOND}&view=compare`, size: WIDE, theme: "light", act: compared },
  {
    name: "compare-wide-dark",
    hash: `${SECOND}&view=compare&columns=input,mar&behind=input`,
    size: WIDE,
    theme: "dark",
    act: compared,
  },
  { name: "compare-narrow-dark", hash: `${SECOND}&view=compare`, size: NARROW, theme: "dark", act: compared },
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
  { name: "crowd-wide-dark", hash: "play=0&view=crowd&who=13", size: WIDE, theme: "dark", act: gathered },
  {
    name: "crowd-above-light",
    hash: "play=0&view=crowd&seen=above&route=-6_0;0_-6;6_0",
    size: WIDE,
    theme: "light",
    act: gathered,
  },
  { name: "crowd-narrow-light", hash: "play=0&view=crowd&who=13", size: NARROW, theme: "light", act: gathered },
  { name: "data-empty-wide-dark", hash: "play=0&view=data", size: WIDE, theme: "dark", flat: true, act: listed },
  { name: "data-wide-light", hash: "play=0&view=data", size: WIDE, theme: "light", flat: true, act: dropClips },
  { name: "data-narrow-dark", hash: "play=0&view=data", size: NARROW, theme: "dark", flat: true, act: dropClips },
];

let browser: Browser;
let site: Awaited<ReturnType<typeof serveSite>>;
let page: Page;
/** A motion that may be published. */
let clip: Buffer;

beforeAll(async () => {
  [browser, site] = await Promise.all([launchBrowser({ graphics: SWIFTSHADER }), serveSite()]);
  page = await openPage(browser, site.url, { hash: "play=0", size: WIDE, screenPixels: 1 });
  await page.waitForFunction(() => window.strut?.analysed && window.strut.upToDate);
  clip = (await saved(page, "BVH")).bytes;
  await page.addInitScript(steady);
});
afterAll(async () => {
  await closePage(page).finally(async () => {
    await browser.close();
    await site.close();
  });
});

describe("the page looks as it did when it was last looked at", () => {
  for (const { name, hash, size, theme, flat, act } of CASES)
    it(name, async () => {
      await page.setViewportSize(size);
      await page.emulateMedia({ colorScheme: theme });
      // Reloaded: the final camera position depends on what was shown before.
      await page.goto("about:blank");
      await page.goto(`${site.url}#${hash}`);
      await shown(page);
      await page.waitForFunction(() => window.strut?.analysed && window.strut.upToDate);
      if (!flat) await page.locator("canvas[role=application]").first().waitFor({ state: "attached" });
      await page.mouse.move(1, 1);
      await act?.(page);
      const picture = await stillPicture(page);
      if (act) await page.mouse.up();
      await expectAsKept(page, name, picture);
    });
});
