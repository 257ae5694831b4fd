/** How files of other programs were read: shown and corrected on the page. */
import { readFileSync } from "node:fs";
import type { Page } from "playwright-core";
import { beforeAll, describe, expect, it } from "vitest";
import type { StrutHook } from "../../web/app/shell/hook";
import { caseFile, casesAbsent } from "../cases";
import { axeFaults } from "./axe";
import { drag, dropFile, eventually, inputName, middleOf, openSite, screenshot, settledPose, visit } from "./browser";
import { showTheme } from "./rest";

declare const window: { strut: StrutHook };

const WIDE = { width: 1440, height: 900 };
const NARROW = { width: 390, height: 844 };
const HEADING = "How this file was read";
const OPENER = "How it was read";

let page: Page;

beforeAll(async () => {
  if (casesAbsent) return;
  const opened = await openSite({ size: WIDE, screenPixels: 1 });
  page = opened.page;
  return opened.close;
});

/** Drops a test file, with another name if given, and waits until it is the input. */
async function drop(name: string, as = name): Promise<void> {
  await dropFile(page, `${as}.bvh`, readFileSync(caseFile(name)));
  await eventually(() => inputName(page)).toBe(as);
}

const panel = () => page.getByRole("dialog", { name: HEADING });
const opener = () => page.locator(".how-read");
const row = (name: string) => panel().locator(".reading-row", { hasText: name });
const control = (name: string) => panel().getByLabel(name, { exact: true });
const source = (name: string) => row(name).locator(".row-source").textContent();
const reading = () => page.evaluate(() => window.strut.state.reading);

/** Opens the panel if it is closed. */
async function openPanel(): Promise<void> {
  if (!(await panel().isVisible())) await opener().click();
  await eventually(() => panel().isVisible()).toBe(true);
}

/** Drags the sheet down by its header. */
async function pull(pixels: number): Promise<void> {
  const head = (await panel().locator(".reading-head").boundingBox())!;
  const from = { x: head.x + head.width / 2, y: head.y + 10 };
  await drag(page, from, { x: from.x, y: from.y + pixels });
}

/** While the file is read, the sheet shows the progress. */
async function showsProgress(): Promise<void> {
  const line = panel().locator(".progress");
  const show = (shown: boolean) => line.evaluate((e, shown) => e.toggleAttribute("hidden", !shown), shown);
  await show(true);
  const place = await middleOf(line);
  const onTop = await page.evaluate(
    ({ x, y }) => document.elementFromPoint(x, y)?.closest(".reading-panel") !== null,
    place,
  );
  expect(onTop).toBe(true);
  await screenshot(page, "how-read-narrow-progress");
  await show(false);
}

/** Returns the height of the hips of the paused styled figure. */
async function hips(): Promise<number> {
  return (await settledPose(page))[1]!;
}

/** Returns the first pose of the clean walk for four seconds: a figure that stands still. */
function idle(): string {
  const [head = "", rows = ""] = readFileSync(caseFile("00_clean"), "utf8").split(/(?<=Frame Time:.*\n)/);
  const frames = 240;
  return head.replace(/Frames: \d+/, `Frames: ${frames}`) + `${rows.split("\n")[0]}\n`.repeat(frames);
}

/** Returns the clean walk shifted by ten metres. */
function elsewhere(): string {
  const [head = "", rows = ""] = readFileSync(caseFile("00_clean"), "utf8").split(/(?<=Frame Time:.*\n)/);
  return head + rows.replace(/^\s*-?[\d.]+/gm, (x) => String(Number(x) + 1000));
}

describe.skipIf(casesAbsent)("a file of another program", () => {
  it("says what was guessed, and is read again as a person says", async () => {
    await drop("A05_ydown_full");
    await eventually(() => opener().textContent()).toBe("1 guess");
    await openPanel();
    await eventually(() => control("Up axis").inputValue()).toBe("-y");
    await eventually(() => source("Up axis")).toBe("guessed");
    await eventually(() => source("Floor")).toBe("measured");
    await eventually(() => source("Joints")).toBe("by name");
    await control("Up axis").selectOption("y");
    await eventually(reading).toEqual({ up: "y" });
    await eventually(() => source("Up axis")).toBe("set by you");
    await eventually(() => opener().textContent()).toBe(OPENER);
    await eventually(() => panel().getByText("Saved for every file with this skeleton.").isVisible()).toBe(true);
  });

  it("takes back what was said with undo, and says it again with redo", async () => {
    await page.keyboard.press("Control+z");
    await eventually(reading).toEqual({});
    await eventually(() => control("Up axis").inputValue()).toBe("-y");
    await page.keyboard.press("Control+Shift+z");
    await eventually(reading).toEqual({ up: "y" });
    await eventually(() => control("Up axis").inputValue()).toBe("y");
    await panel().getByRole("button", { name: "Reset all" }).click();
    await eventually(reading).toEqual({});
    await eventually(() => source("Up axis")).toBe("guessed");
    await eventually(() => panel().getByRole("button", { name: "Reset all" }).isDisabled()).toBe(true);
  });

  it("is exchanged and stands where its feet rest", async () => {
    await drop("A06_mirrored_lefthanded");
    await eventually(() => source("Sides")).toBe("guessed");
    await eventually(() => control("Sides").inputValue()).toBe("1");
    await drop("A20_ground_-93");
    await eventually(() => control("Floor, centimetres").inputValue()).toMatch(/^-9[234]/);
    await eventually(() => source("Floor")).toBe("measured");
    await eventually(() => opener().textContent()).toBe(OPENER);
    await visit(page, "play=0&frame=40&input=A20_ground_-93");
    const before = await hips();
    const floor = control("Floor, centimetres");
    await floor.fill("-83");
    await floor.press("Enter");
    await eventually(reading).toEqual({ floor: -0.83 });
    // The floor is nearer to the hips.
    await eventually(hips).toBeLessThan(before - 0.03);
    await panel().getByRole("button", { name: "Floor: back to the detected value" }).click();
    await eventually(reading).toEqual({});
    await eventually(async () => Math.abs((await hips()) - before)).toBeLessThan(0.01);
  });

  it("keeps its reading in the link", async () => {
    await visit(page, "play=0&frame=40&input=A20_ground_-93&read=up~y%3Bfloor~-0.9");
    await eventually(reading).toEqual({ up: "y", floor: -0.9 });
    await eventually(() => control("Floor, centimetres").inputValue()).toBe("-90");
    await eventually(() => page.evaluate(() => location.hash)).toContain("read=");
    await visit(page, "play=0&frame=40&input=A20_ground_-93");
    await eventually(reading).toEqual({});
  });

  it("is used without a pointer", async () => {
    await panel().getByRole("button", { name: "Close" }).click();
    await eventually(() => panel().isVisible()).toBe(false);
    await opener().focus();
    await page.keyboard.press("Enter");
    await eventually(() => panel().isVisible()).toBe(true);
    await eventually(() => opener().getAttribute("aria-expanded")).toBe("true");
    const focused = () => page.evaluate(() => document.activeElement?.getAttribute("aria-label") ?? "");
    await page.keyboard.press("Tab");
    await eventually(focused).toBe("Close");
    await page.keyboard.press("Tab");
    await eventually(focused).toBe("Up axis");
    await page.keyboard.press("Escape");
    await eventually(() => panel().isVisible()).toBe(false);
    await eventually(() => page.evaluate(() => document.activeElement?.classList.contains("how-read"))).toBe(true);
  });

  it("has its joints exported, imported and chosen, which is remembered for the next file", async () => {
    await openPanel();
    const [download] = await Promise.all([
      page.waitForEvent("download"),
      panel().getByRole("button", { name: "Export…" }).click(),
    ]);
    expect(download.suggestedFilename()).toBe("A20_ground_-93 joints.json");
    const { joints } = JSON.parse(readFileSync(await download.path(), "utf8"));
    expect(Object.keys(joints)).toHaveLength(21);
    const take = (text: string) =>
      panel()
        .locator("input[type=file]")
        .setInputFiles({ name: "mine.json", mimeType: "application/json", buffer: Buffer.from(text) });
    const alert = () => page.getByRole("alert").textContent();
    await take("HIERARCHY");
    await eventually(alert).toContain("“mine.json” is not a JSON file.");
    await take('{"joints": {"left_hand": "Paw"}}');
    await eventually(alert).toContain("This skeleton has no joint 'Paw', which was chosen as the left wrist.");
    // The former input is kept.
    expect(await reading()).toEqual({});
    await take(JSON.stringify({ joints: { ...joints, left_toes: null } }));
    await eventually(() => source("Joints")).toBe("set by you");
    await eventually(() => row("Joints").locator(".joint-count").textContent()).toBe("20 of 21");
    await panel().getByRole("button", { name: "Edit…" }).click();
    const dialog = page.getByRole("dialog", { name: "Joint mapping" });
    await dialog.getByLabel("right toes").selectOption({ label: "none" });
    await dialog.getByRole("button", { name: "Use these joints" }).click();
    await eventually(() => row("Joints").locator(".joint-count").textContent()).toBe("19 of 21");
    await drop("00_clean");
    await eventually(() => row("Joints").locator(".joint-count").textContent()).toBe("19 of 21");
    await eventually(() =>
      panel().getByText("Read with your settings for an earlier file with this skeleton.").isVisible(),
    ).toBe(true);
    await panel().getByRole("button", { name: "Reset all" }).click();
    await eventually(() => row("Joints").locator(".joint-count").textContent()).toBe("21 of 21");
    await drop("00_clean", "clean again");
    await eventually(() => source("Joints")).toBe("by name");
  });

  it("has its other notes below the rows, and beside the input", async () => {
    await drop("T17_fewer");
    await openPanel();
    // They take no space from the sections below.
    const hidden = () => page.locator(".panels").evaluate((e) => e.scrollHeight - e.clientHeight);
    await eventually(() => page.locator(".input-note").isVisible()).toBe(true);
    await eventually(hidden).toBe(0);
    await eventually(() => panel().getByRole("list", { name: "Notes" }).textContent()).toMatch(/frames/);
    await eventually(() => page.locator(".input-note").textContent()).toMatch(/frames/);
    await screenshot(page, "how-read-notes");
  });

  it("is unlike anything where it is: never the kick that begins as somebody stands", async () => {
    await drop("00_clean", "a walk");
    await openPanel();
    await eventually(() => source("Similar to")).toBe("walk, neutral");
    const readsAs = () => page.locator(".section.input .reading").textContent();
    await dropFile(page, "idle.bvh", idle());
    await eventually(() => inputName(page)).toBe("idle");
    await eventually(() => source("Similar to")).toBe("unlike any style");
    await eventually(readsAs).toBe("unlike any style");
    await eventually(() => page.locator(".input-note").textContent()).toBe("The result is a guess.");
    await control("Similar to").selectOption("kick");
    await eventually(() => page.evaluate(() => window.strut.state.action)).toBe("kick");
    await eventually(() => source("Similar to")).toBe("set by you");
    await panel().getByRole("button", { name: "Similar to: back to the detected value" }).click();
    await eventually(() => page.evaluate(() => window.strut.state.action)).toBe("");
    // With another up axis it floats above the ground.
    await control("Up axis").selectOption("x");
    await eventually(() => row("Similar to").locator(".row-why").textContent()).toMatch(
      /^Its poses are \d+ cm from the database/,
    );
    await panel().getByRole("button", { name: "Reset all" }).click();
    await eventually(reading).toEqual({});
  });

  it("is looked at where it is, and its title says what it is", async () => {
    const title = () => page.locator(".stage-title").first().textContent();
    await page.getByLabel("Input motion").selectOption({ label: "neutral run" });
    await eventually(title).toMatch(/^Run, /);
    await visit(page, "play=0&frame=0&follow=0");
    const seen = async () => {
      await settledPose(page);
      const { x, y } = await page.evaluate(() => window.strut.jointScreenPosition("hips"));
      const stage = (await page.locator(".stage").boundingBox())!;
      return x > stage.x && x < stage.x + stage.width && y > stage.y && y < stage.y + stage.height;
    };
    await dropFile(page, "elsewhere.bvh", elsewhere());
    await eventually(() => inputName(page)).toBe("elsewhere");
    await eventually(title).toMatch(/^Walk, /);
    await eventually(seen).toBe(true);
    await dropFile(page, "idle again.bvh", idle());
    // Unlike any example: no action is named, and not the one before.
    await eventually(title).toMatch(/^Mostly |^Proud/);
    await visit(page, "play=0&frame=0");
  });

  it("closes with the file, and a built-in motion has nothing to say", async () => {
    await page.getByLabel("Input motion").selectOption({ label: "neutral walk" });
    await eventually(() => panel().isVisible()).toBe(false);
    await eventually(() => opener().isVisible()).toBe(false);
  });

  for (const theme of ["dark", "light"] as const)
    it(`is shown whole on wide and narrow screens (${theme})`, async () => {
      await page.setViewportSize(WIDE);
      await showTheme(page, theme);
      await drop("A05_ydown_full");
      await visit(page, "play=0&frame=60&input=A05_ydown_full");
      await openPanel();
      await settledPose(page);
      const overflow = () => panel().evaluate((e) => e.scrollWidth - e.clientWidth);
      const clipped = () =>
        panel()
          .locator("h2, p, li, span, button")
          .evaluateAll((all) => all.filter((e) => e.scrollWidth > e.clientWidth + 1).map((e) => e.textContent));
      expect([await overflow(), await clipped()]).toEqual([0, []]);
      await eventually(() => page.locator(".panels").evaluate((e) => e.scrollHeight - e.clientHeight)).toBe(0);
      await eventually(() => axeFaults(page)).toEqual([]);
      // The figures are next to the panel.
      const right = (await panel().boundingBox())!;
      for (const label of ["input", "styled"]) {
        const at = () => page.locator(".stage-view").getByText(label, { exact: true }).boundingBox();
        await eventually(async () => (await at())!.x).toBeGreaterThan(right.x + right.width);
      }
      await screenshot(page, `how-read-wide-${theme}`);
      await page.setViewportSize(NARROW);
      await eventually(() => page.evaluate(() => document.documentElement.scrollWidth)).toBe(390);
      expect([await overflow(), await clipped()]).toEqual([0, []]);
      await eventually(() => axeFaults(page)).toEqual([]);
      const controls = await panel().locator("button:visible, select:visible, input:visible").all();
      for (const box of await Promise.all(controls.map((control) => control.boundingBox())))
        expect(Math.min(box!.width, box!.height)).toBeGreaterThanOrEqual(44);
      await screenshot(page, `how-read-narrow-${theme}`);
      await panel().evaluate((e) => e.scrollTo(0, e.scrollHeight));
      await screenshot(page, `how-read-narrow-end-${theme}`);
      await showsProgress();
      await pull(30);
      expect(await panel().isVisible()).toBe(true);
      await pull(140);
      await eventually(() => panel().isVisible()).toBe(false);
      await page.getByRole("button", { name: "Input", exact: true }).click();
      await screenshot(page, `how-read-narrow-input-${theme}`);
    });

  it("is no human's: it is moved as one where a person says which joint is which", async () => {
    await page.setViewportSize(WIDE);
    const before = await inputName(page);
    await dropFile(page, "dog.bvh", readFileSync(caseFile("S38_dog")));
    // One message, with a hint.
    const toast = page.getByRole("alert").locator(".toast");
    await eventually(() => toast.count()).toBe(1);
    await eventually(() => toast.getByRole("button", { name: "Choose joints…" }).isVisible()).toBe(true);
    expect(await toast.textContent()).toContain("stands on four legs");
    expect(await page.locator(".toast").count()).toBe(1);
    expect(await inputName(page)).toBe(before);
    await screenshot(page, "how-read-refused");
    await page.getByRole("button", { name: "Choose joints…" }).click();
    const roles = page.getByRole("dialog", { name: "Joint mapping" });
    await eventually(() => roles.getByText("stands on four legs").isVisible()).toBe(true);
    await screenshot(page, "how-read-choose-joints");
    await roles.getByRole("button", { name: "Use these joints" }).click();
    await eventually(() => inputName(page)).toBe("dog");
    await openPanel();
    await eventually(() => source("Joints")).toBe("set by you");
    // The choice is remembered: the page does not ask again.
    await drop("S38_dog", "dog again");
  });
});
