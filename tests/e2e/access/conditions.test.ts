/**
 * The main task of each view with only the keyboard and with only one finger: in large text, zoomed, in forced colours,
 * with reduced motion.
 */
import type { CDPSession, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { walksIn } from "../../clips";
import { eventually, openSite, screenshot } from "../browser";
import { transitionsEnded } from "../rest";
import { expectFocusVisible, Finger, type Hands, Keys, Mouse } from "./hands";
import { cutOff, scrolledSideways } from "./layout";
import { data, keyStyle, learn, type NamedClip, play, pose, scrollPast, walk } from "./tasks";

let page: Page;
let session: CDPSession;
let clips: NamedClip[];

beforeAll(async () => {
  const [opened, walks] = await Promise.all([openSite({ size: WIDE }), walksIn(["neutral", "old"])]);
  page = opened.page;
  session = await page.context().newCDPSession(page);
  clips = (["neutral", "old"] as const).map((style) => ({ name: `walk_${style}_1.bvh`, content: walks[style] }));
  return opened.close;
});

const WIDE = { width: 1440, height: 900 };
/** Drawings over time, columns and tables, which need two dimensions. */
const TWO_DIMENSIONAL = ["walk-plan", "compare-body", "matrix", "learn-figures", "equation"];

interface Condition {
  name: string;
  size: { width: number; height: number };
  /** The lesson of the test: a bet is placed only once. */
  lesson: string;
  begin?: () => Promise<unknown>;
  end?: () => Promise<unknown>;
  hands: () => Hands;
}

const CONDITIONS: readonly Condition[] = [
  {
    name: "keys-forced-colours",
    size: WIDE,
    lesson: "style",
    begin: () => page.emulateMedia({ forcedColors: "active" }),
    end: () => page.emulateMedia({ forcedColors: "none" }),
    hands: () => new Keys(page, (control) => expectFocusVisible(page, control)),
  },
  {
    name: "finger-reduced-motion",
    size: { width: 390, height: 844 },
    lesson: "mix",
    begin: async () => {
      await page.emulateMedia({ reducedMotion: "reduce" });
      await session.send("Emulation.setTouchEmulationEnabled", { enabled: true, maxTouchPoints: 1 });
    },
    end: async () => {
      await page.emulateMedia({ reducedMotion: "no-preference" });
      await session.send("Emulation.setTouchEmulationEnabled", { enabled: false });
    },
    hands: () => new Finger(page, session),
  },
  {
    name: "text-200",
    size: WIDE,
    lesson: "time",
    begin: () => session.send("Page.setFontSizes", { fontSizes: { standard: 32, fixed: 26 } }),
    end: () => session.send("Page.setFontSizes", { fontSizes: { standard: 16, fixed: 13 } }),
    hands: () => new Mouse(page),
  },
  {
    // A window of 1280 × 1024 pixels at 400 %.
    name: "zoom-400",
    size: { width: 320, height: 256 },
    lesson: "feet",
    hands: () => new Mouse(page),
  },
];

describe.for(CONDITIONS)("$name", ({ name, size, lesson, begin, end, hands }) => {
  beforeAll(async () => {
    await page.setViewportSize(size);
    await begin?.();
  });
  afterAll(() => end?.());

  const person = () => ({ page, hands: hands() });

  /** Checks that nothing is cut off, and nothing needs unnecessary scrolling in two directions. */
  async function fits(view: string): Promise<void> {
    await transitionsEnded(page);
    await screenshot(page, `access-${name}-${view}`);
    await eventually(() => cutOff(page)).toEqual([]);
    expect(await scrolledSideways(page, TWO_DIMENSIONAL)).toEqual([]);
  }

  it("Play", async () => {
    await play(person());
    await fits("play");
  });

  it("Walk", async () => {
    await walk(person());
    await fits("walk");
  });

  it.runIf(name.startsWith("finger"))("Walk, where a swipe begins on a slider", () => scrollPast(person()));

  it("Key-style", async () => {
    await keyStyle(person());
    await fits("key-style");
  });

  it("Data", async () => {
    await data(person(), clips);
    await fits("data");
  });

  it("Learn", async () => {
    await learn(person(), lesson);
    await fits("learn");
  });

  it.runIf(name.startsWith("finger"))("Learn, where a drawing over the 3-D picture is dragged", () => pose(person()));
});
