/** Every lesson under classroom conditions: projected, printed, with longer words, offline, with a wrong link. */
import type { Page } from "playwright-core";
import { beforeAll, describe, expect, test } from "vitest";
import type { StrutHook } from "../../web/app/shell/hook";
import { LESSONS } from "../../web/lessons/lessons";
import { axeFaults } from "./axe";
import { openSite, visit } from "./browser";
import { transitionsEnded } from "./rest";

declare const window: Window & { strut: StrutHook };

const WIDE = { width: 1440, height: 900 };
const NARROW = { width: 390, height: 844 };
const BEATS = [0, 1, 2, 3, 4, 5];

/** Polls until an expectation holds after an action. */
const soon = <T>(ask: () => T | Promise<T>, message?: string) =>
  expect.poll(ask, { timeout: 20_000, ...(message ? { message } : {}) });

let page: Page;
beforeAll(async () => {
  const opened = await openSite({ hash: "view=learn&lesson=style", size: WIDE, theme: "light" });
  page = opened.page;
  return opened.close;
});

/** Opens a part of a lesson, skipping its bet, and waits until its figures are drawn. */
async function open(lesson: string, beat: number, rest = ""): Promise<void> {
  await visit(page, `view=learn&lesson=${lesson}&beat=${beat}${rest}`);
  await page.waitForFunction(
    (id) => document.querySelector<HTMLSelectElement>(".lessons select")?.value === id,
    lesson,
  );
  const skip = page.locator(".lock:not([hidden])").getByRole("button", { name: /Skip the bet|überspringen/ });
  if (await skip.isVisible()) await skip.click();
  await drawn();
}

/** Waits until the figures on the page are drawn. */
const drawn = () =>
  page.evaluate(async () => {
    for (const figure of document.querySelectorAll("strut-figure:not([hidden])"))
      await (figure as HTMLElement & { ready(): Promise<void> }).ready();
  });

/** Returns elements that overflow the lesson's text or its figures horizontally. */
const overflow = () =>
  page.evaluate(() => {
    const figures = [...document.querySelectorAll(".learn-figures strut-figure:not([hidden])")];
    const inside = figures.flatMap((figure) => [figure, ...figure.shadowRoot!.querySelectorAll("*")]);
    const boxes = [...document.querySelectorAll(".learn-text *"), ...inside].filter(
      (box) => box instanceof HTMLElement && box.clientWidth > 0 && !box.closest(".equation, .visually-hidden"),
    );
    const wide = boxes.filter(
      (box) => box.scrollWidth > box.clientWidth + 1 && getComputedStyle(box).overflowX === "visible",
    );
    return wide.map((box) => `${box.localName}.${box.className} ${box.scrollWidth} > ${box.clientWidth}`);
  });

describe.each(LESSONS)("$id", ({ id }) => {
  test("has a value for every symbol where it explains them", async () => {
    await open(id, 2);
    const values = () => page.locator(".learn-symbols .symbol .value").allTextContents();
    await soon(async () => (await values()).filter((value) => value.trim() === "")).toEqual([]);
  });

  test("is projected without overflow, and accessible", async () => {
    for (const beat of BEATS) {
      await open(id, beat, "&present=1");
      await soon(overflow, `part ${beat}`).toEqual([]);
    }
    await open(id, 2, "&present=1");
    await transitionsEnded(page);
    await soon(() => axeFaults(page)).toEqual([]);
  });

  test("has room for German, and for words that are longer still", async () => {
    for (const beat of BEATS) {
      await open(id, beat, "&lang=de");
      await soon(overflow, `part ${beat}`).toEqual([]);
    }
    // Makes every text 1.4 times as long.
    await page.evaluate(() => {
      const figures = [...document.querySelectorAll("strut-figure:not([hidden])")];
      for (const root of [document.querySelector(".learn-text")!, ...figures.map((figure) => figure.shadowRoot!)]) {
        const walker = document.createTreeWalker(root, NodeFilter.SHOW_TEXT);
        for (let node = walker.nextNode(); node; node = walker.nextNode()) {
          const text = node.textContent!;
          if (text.trim().length > 1 && !node.parentElement!.closest(".katex, option, svg, style"))
            node.textContent = text.replace(/\p{L}{2,}/gu, (word) => word + "x".repeat(Math.ceil(word.length * 0.4)));
        }
      }
    });
    await soon(overflow, "long words").toEqual([]);
    await page.setViewportSize(NARROW);
    await soon(overflow, "long words on a narrow screen").toEqual([]);
    await page.setViewportSize(WIDE);
  });

  test("prints all its parts and figures, and nothing is cut off", async () => {
    await open(id, 2);
    await page.emulateMedia({ media: "print" });
    await page.setViewportSize({ width: 680, height: 900 });
    try {
      const clipped = () =>
        page.evaluate(() => {
          const figures = [...document.querySelectorAll(".learn-figures strut-figure:not([hidden])")];
          const boxes = [document.querySelector(".learn")!, ...document.querySelectorAll(".learn *")].filter(
            (box) => box instanceof HTMLElement && !box.closest(".katex, .visually-hidden, strut-figure"),
          );
          const cut = [
            ...boxes,
            ...figures.flatMap((figure) => [...figure.shadowRoot!.querySelectorAll("div, p")]),
          ].filter(
            (box) =>
              box.clientHeight > 0 &&
              getComputedStyle(box).overflowY !== "visible" &&
              !box.classList.contains("visually-hidden") &&
              box.scrollHeight > box.clientHeight + 1,
          );
          return cut.map((box) => `${box.localName}.${box.className} ${box.scrollHeight} > ${box.clientHeight}`);
        });
      await soon(clipped).toEqual([]);
      const parts = await page
        .locator(".learn-part")
        .evaluateAll((all) => all.filter((part) => !part.checkVisibility()));
      expect(parts).toEqual([]);
      expect((await page.pdf({ preferCSSPageSize: true })).length).toBeGreaterThan(10_000);
    } finally {
      await page.emulateMedia({ media: "screen" });
      await page.setViewportSize(WIDE);
    }
  });

  test("goes on without a network once it is open", async () => {
    await page.goto("about:blank");
    await page.goBack();
    await page.waitForFunction(() => window.strut?.frame !== undefined);
    await open(id, 0);
    await page.locator(".learn-figures[data-prefetched]").waitFor({ state: "attached" });
    await page.context().setOffline(true);
    try {
      for (const beat of BEATS) {
        await open(id, beat);
        await soon(() => page.locator("strut-figure:not([hidden]) .message:visible").allTextContents()).toEqual([]);
      }
      await soon(() => page.evaluate(missingFonts)).toEqual([]);
    } finally {
      await page.context().setOffline(false);
    }
  });

  test("opens by a link in which all is wrong, or of another lesson", async () => {
    const keys = await page.evaluate(() => location.hash);
    expect(keys).toContain("view=learn");
    for (const wrong of [
      "i=-1e99&K=NaN&style=constructor&lambda=&ridge=1e999&s=0&kappa=x&rho=-1&__proto__=1&turned=head~1,2",
      "motion=%00&joint=tail&pick=%3Cb%3E&keys=9,9,9&old=2&childlike=2&task=Z&window=7&guess=1e400",
    ]) {
      await open(id, 4, `&${wrong}`);
      await soon(() => page.locator("strut-figure:not([hidden]) .message:visible").allTextContents()).toEqual([]);
      await soon(() => page.locator(".toast.error").count()).toBe(0);
    }
  });
});

/** Returns the page's fonts that could not be loaded, except for the system's fallback fonts. */
function missingFonts(): string[] {
  const missing = [...document.fonts].filter(({ status }) => status === "error").map(({ family }) => family);
  return missing.filter((family) => !family.includes("stand-in"));
}
