/** User tasks of each view in Firefox and WebKit: `npm run browsers`. Chromium's tests are in tests/e2e. */
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import type { StrutHook } from "../../web/app/shell/hook";
import { walksIn } from "../clips";
import { serveSite } from "../e2e/browser";
import { root } from "../recordings";
import { zipOf } from "../zip";
import { BROWSERS } from "./browsers";
import { type BrowserPage, dropOn, type Place } from "./page";

declare const window: { strut: StrutHook; faults: string[] };

const OUTPUT = join(root, "tests/output");

describe.for(BROWSERS)("$name", ({ name, path, launch }) => {
  let site: Awaited<ReturnType<typeof serveSite>>;
  let page: BrowserPage;
  let walks: Record<"neutral" | "old" | "proud", string>;

  beforeAll(async () => {
    if (!path) throw new Error(`${name} is not installed; npm run browsers installs it where it can.`);
    [site, page, walks] = await Promise.all([serveSite(), launch(), walksIn(["neutral", "old", "proud"])]);
    console.log(page.browser);
    await open("play=1");
  });
  afterAll(async () => {
    await page?.close();
    await site?.close();
  });

  /** Loads the page with a state, and records its errors from then on. */
  async function open(hash: string): Promise<void> {
    await page.open(`${site.url}?${hash.length}#${hash}`);
    await page.evaluate(() => {
      window.faults = [];
      addEventListener("error", ({ message }) => window.faults.push(message));
      addEventListener("unhandledrejection", ({ reason }) => window.faults.push(String(reason)));
      document.addEventListener("securitypolicyviolation", ({ violatedDirective, blockedURI }) =>
        window.faults.push(`${violatedDirective} ${blockedURI}`),
      );
    });
    while (!(await page.evaluate(() => window.strut?.frame !== undefined)))
      await new Promise((later) => setTimeout(later, 200));
  }

  const faults = () => page.evaluate(() => window.faults);
  const text = (selector: string) =>
    page.evaluate((selector) => document.querySelector(selector)?.textContent ?? "", selector);
  const view = () => page.evaluate(() => window.strut.state.view);

  /**
   * Returns the middle of the first element of a selector, or of the first one with a text, once it has stopped moving.
   */
  async function middle(selector: string, text?: string): Promise<Place> {
    const find = () =>
      page.evaluate(
        (selector, text) => {
          const all = [...document.querySelectorAll<HTMLElement>(selector)].filter((one) => one.checkVisibility());
          const found = all.find((one) => text === null || one.textContent === text);
          found?.scrollIntoView({ block: "nearest" });
          const box = found?.getBoundingClientRect();
          return box && { x: box.x + box.width / 2, y: box.y + box.height / 2 };
        },
        selector,
        text ?? null,
      );
    let last: Place | undefined;
    const standsStill = async () => {
      const before = last;
      last = (await find()) ?? undefined;
      return last !== undefined && last.x === before?.x && last.y === before.y;
    };
    await expect.poll(standsStill, { message: `${selector} ${text ?? ""}` }).toBe(true);
    return last!;
  }

  const click = async (selector: string, text?: string) => page.click(await middle(selector, text));
  const goTo = async (name: string, wanted: string) => {
    await click(".bar nav a", name);
    await expect.poll(view).toBe(wanted);
  };

  const drop = (name: string, content: string | Uint8Array) => dropOn(page, name, content);

  async function picture(of: string): Promise<void> {
    mkdirSync(OUTPUT, { recursive: true });
    writeFileSync(join(OUTPUT, `${name.toLowerCase()}-${of}.png`), await page.picture());
  }

  it("Play: a walk plays, and a drag and a double click change its style", async () => {
    const frame = () => page.evaluate(() => window.strut.frame!.inputFrame);
    const at = await frame();
    await expect.poll(frame).not.toBe(at);
    const weight = (name: string) =>
      page.evaluate((name) => window.strut.state.styles.find((s) => s.name === name)?.weight ?? 0, name);
    const corner = (style: string) => middle(`.vertex[data-style="${style}"] .vertex-dot`);
    const [proud, childlike] = [await corner("proud"), await corner("childlike")];
    const between = { x: (proud.x + childlike.x) / 2, y: (proud.y + childlike.y) / 2 };
    await page.drag({ from: await middle(".polygon [role=slider]"), to: between });
    await expect.poll(() => weight("proud")).toBeCloseTo(0.5, 1);
    await expect.poll(() => weight("childlike")).toBeCloseTo(0.5, 1);
    await page.click(proud, 2);
    await expect.poll(() => weight("proud")).toBe(1);
    await picture("play");
  });

  it("Play: a dropped BVH walks in the style, and what a frame costs is shown", async () => {
    await drop("mine.bvh", walks.old);
    await expect.poll(() => page.evaluate(() => window.strut.state.input)).toBe("mine");
    await expect.poll(() => page.evaluate(() => window.strut.analysed)).toBe(true);
    // Clocks with a resolution of a millisecond would show 0.00.
    await expect.poll(() => text(".read-out")).toMatch(/0\.(0[1-9]|[1-9]\d) ms|[1-9]\d*\.\d+ ms/);
    expect(await text("[role=alert]")).toBe("");
  });

  it("Compare: the columns are styled and measured", async () => {
    await goTo("Compare", "compare");
    await expect.poll(() => text('.compare-table[data-column="mar"]')).toMatch(/cm\/s/);
    await picture("compare");
  });

  it("Walk: the model is trained, and a plan is walked", async () => {
    await goTo("Walk", "walk");
    await expect.poll(() => text(".walk .stage-title")).toMatch(/ steps, /);
    await expect.poll(() => text(".walk-figures")).toMatch(/0\.\d\d m/);
    await picture("walk");
  });

  it("Key-style: the model is trained, and the body follows the pad", async () => {
    await goTo("Key-style", "key-style");
    await expect.poll(() => text(".model-menu summary")).toMatch(/trained in/);
    const foot = () => page.evaluate(() => window.strut.jointScreenPosition("left_foot").x);
    const pad = await middle(".pad-plot");
    await page.click({ x: pad.x - 40, y: pad.y });
    const before = await foot();
    await page.drag({ from: { x: pad.x - 40, y: pad.y }, to: { x: pad.x + 40, y: pad.y } });
    await expect.poll(async () => Math.abs((await foot()) - before)).toBeGreaterThan(1);
    await picture("key-style");
  });

  it("Crowd: people walk", async () => {
    await goTo("Crowd", "crowd");
    await expect.poll(() => text(".crowd .stage-title")).toMatch(/people/);
    // The drag of the previous task has paused the page; the button works once there are people.
    const plays = () => page.evaluate(() => window.strut.state.playing);
    const play = async () => {
      if (!(await plays())) await click(".crowd button.play");
      return plays();
    };
    await expect.poll(play, { interval: 500 }).toBe(true);
    await expect.poll(() => text(".crowd-figures")).toMatch(/ms per tick.*ms per frame/);
    await picture("crowd");
  });

  it("Learn: a lesson opens, and its figure is drawn", async () => {
    await goTo("Learn", "learn");
    const figures = () =>
      page.evaluate(async () => {
        const figure = document.querySelector("strut-figure") as (HTMLElement & { ready(): Promise<unknown> }) | null;
        await figure?.ready();
        return figure !== null;
      });
    await expect.poll(figures).toBe(true);
    await picture("learn");
  });

  it("Data: a zip of clips becomes a database that is opened, and kept where the browser keeps files", async () => {
    await goTo("Data", "data");
    const clips = (["neutral", "old", "proud"] as const).map((style) => ({
      name: `walk_${style}_1.bvh`,
      content: walks[style],
    }));
    await drop("small.zip", zipOf(clips));
    await expect.poll(() => text(".data-clips h1")).toBe("3 clips, 3 styles");
    await expect
      .poll(() => page.evaluate(() => document.querySelector('.data[aria-busy="false"]') !== null))
      .toBe(true);
    await click(".build button", "Build the database");
    await middle('.stored button[aria-label="Open small"]');
    // WebDriver sessions of WebKit are private and store no files.
    const refusal = name === "WebKit" ? /^“small” is ready, but .* does not let this page keep files/ : /^$/;
    expect(await text(".toasts [role=alert]")).toMatch(refusal);
    await picture("data");
    await click('.stored button[aria-label="Open small"]');
    await expect.poll(() => page.evaluate(() => document.querySelectorAll(".vertex").length)).toBe(3);
  });

  it("nothing was thrown, and nothing was against the content security policy", async () => {
    expect(await faults()).toEqual([]);
  });
});
