/** The Learn view: a lesson is read, its bet placed, its exercise tried and solved. */
import type { Page } from "playwright-core";
import { beforeAll, describe, expect, it } from "vitest";
import type { StrutHook } from "../../web/app/shell/hook";
import { axeFaults } from "./axe";
import { openSite, screenshot, visit } from "./browser";
import { expectFitsNarrow } from "./narrow";
import { transitionsEnded } from "./rest";

declare const window: { strut: StrutHook };

const WIDE = { width: 1440, height: 900 };
/** Polls until an expectation holds after an action. */
const soon = <T>(ask: () => T | Promise<T>, message?: string) =>
  expect.poll(ask, { timeout: 20_000, ...(message ? { message } : {}) });

let page: Page;

beforeAll(async () => {
  const opened = await openSite({ hash: "view=learn", size: WIDE, theme: "light" });
  page = opened.page;
  return opened.close;
});

const state = () => page.evaluate(() => window.strut.state);
const visible = (selector: string) => page.locator(selector).isVisible();
const verdict = (exercise: string) => page.locator(`[data-exercise="${exercise}"] .verdict`).textContent();
const part = () => page.locator(".learn-part:not([hidden])").getAttribute("data-beat");
const value = (term: string) => page.locator(`.symbol[data-term="${term}"] .value`).textContent();
const faults = async () => {
  await transitionsEnded(page);
  return axeFaults(page);
};
/** Returns elements that overflow the lesson's text or a figure horizontally. */
const overflow = () =>
  page.evaluate(() => {
    const boxes = [...document.querySelectorAll(".learn-text *, .learn-figures strut-figure")];
    const wide = boxes.filter(
      (box) => box.scrollWidth > box.clientWidth + 1 && getComputedStyle(box).overflowX === "visible",
    );
    const shown = wide.filter((box) => box.clientWidth > 0 && !box.closest(".katex"));
    return shown.map((box) => `${box.className} ${box.scrollWidth} > ${box.clientWidth}`);
  });

describe("a lesson", () => {
  it("hides its answer until the bet is placed", async () => {
    await soon(part).toBe("idea");
    expect(await page.locator(".bar nav").getByText("Learn").getAttribute("aria-current")).not.toBeNull();
    await page.getByRole("button", { name: "3: Look closely" }).click();
    await soon(() => visible(".learn-part:not([hidden]) .lock")).toBe(true);
    expect(await visible('strut-figure[data-name="curve"]')).toBe(false);
    await page.locator(".lock").first().getByRole("button", { name: "Your bet" }).click();
    await page.getByLabel("The same second").check();
    await page.getByRole("button", { name: "Place the bet" }).click();
    await soon(() => page.locator(".reveal").textContent()).toMatch(/You bet right\..*17\.25 cm.*13\.39 cm/);
    expect(await faults()).toEqual([]);
  });

  it("is scrolled by the wheel over a picture, which zooms while it has the focus", async () => {
    const picture = page.locator("strut-figure:not([hidden]) canvas[role=application]").first();
    await picture.waitFor();
    const takes = () =>
      picture.evaluate((e) => !e.dispatchEvent(new WheelEvent("wheel", { deltaY: 100, cancelable: true })));
    expect(await takes()).toBe(false);
    await picture.focus();
    expect(await takes()).toBe(true);
    await picture.blur();
  });

  it("shows values of the engine, and symbols light their marks", async () => {
    await page.locator(".turn.next").click();
    await soon(part).toBe("look");
    await soon(() => value("e")).toBe("21.3 cm");
    await soon(() => value("tau")).toBe("2.67 s");
    await page.locator('.symbol[data-term="tau"]').focus();
    await soon(() => page.locator("strut-figure .thread.lit").count()).toBe(1);
    await page.locator('.term[data-term="e"]').hover();
    await soon(() => page.locator("strut-figure .curve.lit").count()).toBe(2);
    await soon(() => page.locator('.equation [data-term="e"].lit').count()).toBe(1);
    expect(await faults()).toEqual([]);
    await screenshot(page, "learn-look");
  });

  it("has an exercise solved by the keyboard alone, and remembers it", async () => {
    await visit(page, "view=learn&beat=4");
    await soon(part).toBe("exercises");
    const begin = page.locator('[data-exercise="B"]').getByRole("button", { name: "Begin" });
    await begin.focus();
    await page.keyboard.press("Enter");
    await soon(async () => (await state()).task).toBe("B");
    await soon(async () => (await state()).figures).toContain("style=sexy");
    const playhead = page.locator('strut-figure[data-name="curve"]').getByRole("slider");
    await playhead.focus();
    await soon(() => playhead.getAttribute("aria-valuenow")).toBe("0");
    await page.keyboard.press("ArrowRight");
    await soon(() => verdict("B")).toMatch(/^✗ /);
    await soon(() => playhead.getAttribute("aria-valuenow")).toBe("10");
    for (let step = 0; step < 24 && !(await verdict("B"))!.startsWith("✓"); step++) {
      for (let press = 0; press < 3; press++) await page.keyboard.press("ArrowRight");
      const said = await verdict("B");
      await expect
        .poll(() => verdict("B"), { timeout: 1000 })
        .not.toBe(said)
        .catch(() => undefined);
    }
    await soon(() => verdict("B")).toMatch(/^✓ Yes: at \d+\.\d\d s/);
    const kept = await page.evaluate(() => localStorage.getItem("strut.learn.1"));
    expect(JSON.parse(kept!).lessons.style.solved).toEqual(["B"]);
    expect(await faults()).toEqual([]);
  });

  it("undoes what was set in a figure", async () => {
    const before = (await state()).figures;
    await page.locator('strut-figure[data-name="stage"] select').selectOption("angry");
    await soon(async () => (await state()).figures).toContain("style=angry");
    await page.keyboard.press("Control+z");
    await soon(async () => (await state()).figures).toBe(before);
  });

  it("refuses the mistake that an exercise is about, helps, and gives a solution after three tries", async () => {
    await visit(page, "view=learn&beat=4&task=A");
    const style = page.locator('strut-figure[data-name="stage"] select');
    await style.selectOption("childlike");
    await soon(() => verdict("A")).toMatch(/^✗ You compared different moments of the step\./);
    await style.selectOption("proud");
    await soon(() => verdict("A")).toMatch(/^✗ proud has 5\.94 cm on average\. Another style is closer\.$/);
    const card = page.locator('[data-exercise="A"]');
    await card.getByRole("button", { name: "Hint 1" }).click();
    await soon(() => card.locator(".hints li:not([hidden])").count()).toBe(1);
    await style.selectOption("angry");
    await card.getByRole("button", { name: "Show a solution" }).click();
    await soon(() => verdict("A")).toMatch(/^✓ Yes: sexy, with 4\.80 cm/);
    await soon(() => page.url()).toMatch(/task=A.*style=sexy/);
  });

  it("keeps a text while it is written, even if the page is reloaded before the field loses the focus", async () => {
    await visit(page, "view=learn&lesson=near&beat=3");
    await soon(part).toBe("why");
    await page.locator(".learn-part:not([hidden]) .lock").getByRole("button", { name: "Skip the bet" }).click();
    const words = page.locator(".learn-part:not([hidden]) textarea");
    const text = "Styles differ most in the arms.";
    await words.pressSequentially(text);
    expect(await words.evaluate((field) => field === document.activeElement)).toBe(true);
    const kept = await page.evaluate(() => localStorage.getItem("strut.learn.1"));
    expect(JSON.parse(kept!).lessons.near.words).toBe(text);
    await page.reload();
    await soon(() => words.inputValue()).toBe(text);
  });
});

describe("a link", () => {
  it("with an answer checks itself", async () => {
    await visit(page, "view=learn&lesson=style&beat=4&task=C&joint=head");
    await soon(() => verdict("C")).toMatch(/^✓ Yes: head, by 32\.01 cm/);
    await visit(page, "view=learn&lesson=style&beat=4&task=C&joint=left_foot");
    await soon(() => verdict("C")).toMatch(/^✗ The legs move most in every walk/);
  });

  it("that is wrong in every field shows the lesson all the same", async () => {
    await visit(
      page,
      "view=learn&lesson=%3Cb%3E&beat=99&task=__proto__&lang=xx&hide=%00&present=7&i=-1e9&style=constructor&pair=&joint=left&motion=x&K=1e999&__proto__=1",
    );
    await soon(part).toBe("sources");
    await soon(async () => (await state()).figures).toBe("i=0");
    await soon(() => page.locator("h1.learn-title").textContent()).toBe("Tell content from style");
    await soon(() => page.url()).not.toContain("K=");
  });

  it("may hide text, controls and answers", async () => {
    await visit(page, "view=learn&beat=4&hide=text,controls,answers");
    await soon(() => visible(".learn-text")).toBe(false);
    await soon(() => visible('strut-figure[data-name="stage"] .segment')).toBe(false);
    await visit(page, "view=learn&beat=4&hide=answers");
    await soon(() => visible(".learn-text")).toBe(true);
    await soon(() => page.getByRole("button", { name: "Hint 1" }).count()).toBe(0);
  });
});

describe("the view", () => {
  it("presents", async () => {
    await visit(page, "view=learn&beat=2&present=1");
    await soon(() => page.locator(".learn.present").count()).toBe(1);
    await page.locator("h1.learn-title").focus();
    await page.keyboard.press("ArrowRight");
    await soon(part).toBe("why");
    await page.keyboard.press("ArrowLeft");
    await soon(part).toBe("look");
    await page.keyboard.press("l");
    await soon(() => page.evaluate(() => navigator.clipboard.readText())).toMatch(/view=learn/);
    await soon(faults).toEqual([]);
    await soon(overflow).toEqual([]);
    await screenshot(page, "learn-presenter");
  });

  it("speaks German, and has room for longer words", async () => {
    await visit(page, "view=learn&beat=4&lang=de&theme=dark");
    await soon(() => page.locator("h1.learn-title").textContent()).toBe("Inhalt und Stil unterscheiden");
    await soon(() => page.locator('strut-figure[data-name="stage"] .readout').textContent()).toContain("2,67\u00a0s");
    await soon(faults).toEqual([]);
    for (const beat of [0, 1, 2, 3, 4, 5]) {
      await visit(page, `view=learn&beat=${beat}&lang=de`);
      await soon(() => page.locator(".learn-steps [aria-current]").textContent()).toBe(String(beat + 1));
      await soon(overflow, `part ${beat}`).toEqual([]);
    }
    await visit(page, "view=learn&beat=4");
    await soon(() => page.locator("h1.learn-title").textContent()).toBe("Tell content from style");
    // Makes every text 1.4 times as long.
    await page.evaluate(() => {
      const walker = document.createTreeWalker(document.querySelector(".learn-text")!, NodeFilter.SHOW_TEXT);
      for (let node = walker.nextNode(); node; node = walker.nextNode()) {
        const text = node.textContent!;
        if (text.trim().length > 1 && !node.parentElement!.closest(".katex, option"))
          node.textContent = text.replace(/\S+/g, (word) => word + "x".repeat(Math.ceil(word.length * 0.4)));
      }
    });
    await soon(overflow, "long words").toEqual([]);
  });

  it("prints the whole lesson", async () => {
    await visit(page, "view=learn&beat=2");
    await page.emulateMedia({ media: "print" });
    await soon(() => page.locator('.learn-part[data-beat="exercises"]').isVisible()).toBe(true);
    await soon(() =>
      page.evaluate(
        () => document.querySelector(".learn")!.scrollHeight - document.querySelector(".learn")!.clientHeight,
      ),
    ).toBeLessThan(2);
    await page.emulateMedia({ media: "screen" });
  });

  it("fits a narrow screen, in both themes", async () => {
    for (const theme of ["light", "dark"]) {
      await visit(page, `view=learn&beat=4&theme=${theme}`);
      await expectFitsNarrow(
        page,
        ".learn-text button:visible, .learn-text select:visible, strut-figure select:visible",
      );
    }
    await screenshot(page, "learn-narrow");
    await page.setViewportSize(WIDE);
  });
});
