/** Faults around the page: a message is shown, and nothing on screen is lost. */
import type { Page, Worker } from "playwright-core";
import { beforeAll, describe, expect, it } from "vitest";
import type { StrutHook } from "../../web/app/shell/hook";
import {
  drawn,
  dropFile,
  eventually,
  inputName,
  openSite,
  screenshot,
  settledPose,
  styledPose,
  turnBetween,
  visit,
} from "./browser";
import { lastContext } from "./graphics";

declare const window: { strut: StrutHook; restoreContext?: () => void };

let page: Page;

beforeAll(async () => {
  const opened = await openSite();
  page = opened.page;
  return opened.close;
});

const PAUSED = "play=0&frame=60&styles=proud:1,old:0,depressed:0";
/** The worker that tests the renderer has ended, but may still be listed. */
const isEngine = (worker: Worker) => !worker.url().includes("graphics");
const notes = () => page.locator(".toasts").textContent();

describe("a worker that is killed", () => {
  it("is replaced; style, frame and pose are as they were", async () => {
    await visit(page, `${PAUSED}&parts=legs~old:1`);
    const before = await settledPose(page);
    const worker = page.workers().find(isEngine);
    await worker!.evaluate(() => {
      setTimeout(() => {
        throw new Error("killed for the test");
      });
    });
    await eventually(notes).toMatch(/The engine crashed and was restarted. Your settings are kept./);
    await screenshot(page, "restarted");
    expect(turnBetween(before, await settledPose(page))).toBeLessThan(0.2);
    await page.keyboard.press("Space");
    await eventually(async () => turnBetween(before, await styledPose(page))).toBeGreaterThan(1);
    await page.keyboard.press("Space");
  });
});

describe("a lost graphics context", () => {
  it("is survived: the picture comes back", async () => {
    await visit(page, PAUSED);
    const picture = () =>
      page.locator(".stage canvas").evaluate(async (element) => {
        const canvas = element as HTMLCanvasElement;
        const copy = document.createElement("canvas");
        [copy.width, copy.height] = [64, 64];
        const context = copy.getContext("2d")!;
        await new Promise(requestAnimationFrame);
        context.drawImage(canvas, 0, 0, 64, 64);
        const { data } = context.getImageData(0, 0, 64, 64);
        return new Set(data).size;
      });
    await page.keyboard.press("Space");
    await eventually(picture).toBeGreaterThan(40);
    await (await lastContext(page)).evaluate(async (context) => {
      const extension = context.getExtension("WEBGL_lose_context")!;
      const lost = new Promise((resolve) =>
        context.canvas.addEventListener("webglcontextlost", resolve, { once: true }),
      );
      extension.loseContext();
      await lost;
      // All listeners have run by then.
      await new Promise(requestAnimationFrame);
      window.restoreContext = () => extension.restoreContext();
    });
    // An empty file is never saved.
    await page.getByRole("button", { name: "Export" }).click();
    await page.locator(".export-menu").getByRole("button", { name: /^PNG/ }).click();
    await eventually(() => page.getByRole("alert").textContent()).toContain("The browser stopped the 3D graphics");
    await page.getByRole("alert").getByRole("button", { name: "Dismiss" }).click();
    await page.evaluate(() => window.restoreContext!());
    await eventually(picture).toBeGreaterThan(40);
    await page.keyboard.press("Space");
    expect(await page.getByRole("alert").textContent()).toBe("");
  });
});

describe("a page that went offline", () => {
  it("goes on, and says what it cannot load", async () => {
    await visit(page, PAUSED);
    const before = await settledPose(page);
    await page.context().setOffline(true);
    await page.locator('.vertex[data-style="depressed"] .vertex-dot').dblclick();
    await eventually(async () => turnBetween(before, await settledPose(page))).toBeGreaterThan(3);
    await page.getByRole("link", { name: "Compare" }).click();
    await eventually(() => page.getByRole("alert").textContent()).toMatch(
      /This view could not be loaded because there is no network. Connect, then try again./,
    );
    await eventually(() => page.evaluate(() => window.strut.state.view)).toBe("play");
    await page.context().setOffline(false);
    await page.getByRole("alert").getByRole("button", { name: "Dismiss" }).click();
  });
});

describe("a file that vanishes while it is read", () => {
  it("gets a sentence, and what was on screen stays", async () => {
    await visit(page, PAUSED);
    const before = await settledPose(page);
    const input = await inputName(page);
    await page.evaluate(() => {
      File.prototype.arrayBuffer = () => Promise.reject(new DOMException("gone", "NotFoundError"));
    });
    await dropFile(page, "walk.bvh", "HIERARCHY");
    await eventually(() => page.getByRole("alert").textContent()).toMatch(
      /“walk.bvh” could not be read. Drop it again./,
    );
    expect(await inputName(page)).toBe(input);
    expect(turnBetween(before, await settledPose(page))).toBeLessThan(0.2);
    await page.getByRole("alert").getByRole("button", { name: "Dismiss" }).click();
  });
});

describe("a person who wants less motion", () => {
  it("gets another camera at once, and the character still moves", async () => {
    await page.emulateMedia({ reducedMotion: "reduce" });
    await visit(page, PAUSED);
    await settledPose(page);
    const hand = () => page.evaluate(() => window.strut.jointScreenPosition("left_hand").x);
    const orbiting = await hand();
    await page.getByRole("radio", { name: "Side" }).check({ force: true });
    // The first changed frame is already the camera's last.
    await page.waitForFunction((x) => Math.abs(window.strut.jointScreenPosition("left_hand").x - x) > 1, orbiting);
    const at = await hand();
    await page.waitForTimeout(800);
    expect(Math.abs((await hand()) - at)).toBeLessThan(0.5);
    const before = await styledPose(page);
    await page.keyboard.press("Space");
    await eventually(async () => turnBetween(before, await styledPose(page))).toBeGreaterThan(1);
    await page.emulateMedia({ reducedMotion: null });
  });
});

describe("a tab that stood still, as one that is hidden does", () => {
  it("goes on where it was, without a leap", async () => {
    await visit(page, "play=1");
    await eventually(() => page.evaluate(() => window.strut.frame!.inputFrame)).toBeGreaterThan(5);
    const advances = await page.evaluate(async () => {
      const picture = () => new Promise(requestAnimationFrame);
      await picture();
      let before = window.strut.frame!.inputFrame;
      const stillUntil = performance.now() + 2000;
      while (performance.now() < stillUntil);
      const advances: number[] = [];
      while (advances.length < 5) {
        await picture();
        const { inputFrame } = window.strut.frame!;
        if (inputFrame !== before) advances.push(inputFrame - before);
        before = inputFrame;
      }
      return advances;
    });
    // At most a tenth of a second, which the style may stretch.
    expect(Math.max(...advances)).toBeLessThan(12);
  });
});

describe("the motion trail", () => {
  it("is drawn as lines, with bodies, and not at all, in turn", async () => {
    await visit(page, `${PAUSED}&ghost=off`);
    await page.waitForFunction(() => window.strut.analysed);
    const modes: string[] = [];
    for (let i = 0; i < 3; i++) {
      await page.keyboard.press("t");
      modes.push(await page.evaluate(() => window.strut.state.trace));
      await drawn(page, 5);
      await screenshot(page, `trail-${modes.at(-1)}`);
    }
    expect(modes).toEqual(["lines", "onion", "off"]);
  });
});
