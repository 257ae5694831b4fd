/**
 * Transcripts of each view for a screen reader, compared with those that a person has approved (`transcripts/`). `npx
 * vitest run tests/e2e/access/transcripts.test.ts -u` replaces those that differ: read them as a listener would.
 */
import type { Page } from "playwright-core";
import { beforeAll, describe, expect, it } from "vitest";
import { eventually, openSite, visit } from "../browser";
import { ambiguous, settledTranscript } from "./transcript";

let page: Page;

beforeAll(async () => {
  const opened = await openSite({ size: { width: 1440, height: 900 }, hash: "play=0&frame=60" });
  page = opened.page;
  return opened.close;
});

interface Case {
  view: string;
  /** State of the view; all are paused. */
  hash?: string;
  /** Waits until the view is complete. */
  ready: () => Promise<unknown>;
}

const first = (selector: string) => page.locator(selector).first().waitFor();

const CASES: readonly Case[] = [
  {
    view: "play",
    hash: "frame=60&styles=proud:0.6,old:0.1,childlike:0.3",
    ready: () => page.waitForFunction(() => window.strut?.analysed && window.strut.upToDate),
  },
  {
    view: "walk",
    hash: "block=1&walk=1_3_2~neutral:1,old:0,sexy:0;1_4_2~proud:1,old:0,sexy:0;1_3_2~old:1,proud:0,sexy:0",
    ready: () => eventually(() => page.locator(".walk .stage-title").textContent()).toBe("16 steps, three styles"),
  },
  { view: "key-style", ready: () => first('.key-style[aria-busy="false"] .pad-key') },
  {
    view: "compare",
    hash: "frame=60",
    ready: () =>
      eventually(() => page.locator(".compare-table").last().locator("dd").first().textContent()).toMatch(/\d/),
  },
  {
    view: "learn",
    hash: "lesson=style&beat=4&task=A",
    // A figure announces its sentence after it has been unchanged for a second.
    ready: () =>
      page.waitForFunction(() => {
        const figures = [...document.querySelectorAll("strut-figure:not([hidden])")];
        const said = figures.map((figure) => figure.shadowRoot?.querySelector("[role=status]")?.textContent);
        return said.length > 0 && said.every(Boolean);
      }),
  },
  { view: "crowd", hash: "who=13", ready: () => first(".crowd-foot .button:enabled") },
  { view: "data", ready: () => first(".catalogue li button:enabled") },
];

/** Removes notes, which otherwise disappear after a while. */
const dismissNotes = () =>
  page.evaluate(() => {
    for (const close of document.querySelectorAll<HTMLElement>(".toast .plain, .toast button:last-child"))
      close.click();
  });

describe("the transcript", () => {
  it.for(CASES)("of $view", async ({ view, hash, ready }) => {
    await visit(page, `play=0&view=${view}${hash ? `&${hash}` : ""}`);
    await page.waitForFunction((view) => document.getElementById("app")?.dataset.view === view, view);
    await ready();
    await page.locator(".progress").first().waitFor({ state: "hidden" });
    await dismissNotes();
    const transcript = await settledTranscript(page);
    await expect(transcript).toMatchFileSnapshot(`transcripts/${view}.txt`);
    expect(ambiguous(transcript), "controls without a name of their own").toEqual([]);
  });
});
