/** A style from one clip: a file that is dropped on the polygon becomes a vertex of it. */
import type { Page } from "playwright-core";
import { beforeAll, describe, expect, it } from "vitest";
import type { StrutHook } from "../../web/app/shell/hook";
import { everyNth, walksIn } from "../clips";
import { dropFile, eventually, inputName, middleOf, openSite, screenshot } from "./browser";

declare const window: { strut: StrutHook };

let page: Page;
let walk: string;

beforeAll(async () => {
  const [opened, walks] = await Promise.all([openSite({ size: { width: 1280, height: 800 } }), walksIn(["old"], 260)]);
  [page, walk] = [opened.page, walks.old];
  return opened.close;
});

const vertices = () => page.locator(".vertex").evaluateAll((v) => v.map((e) => e.getAttribute("data-style")!));
const weights = () => page.evaluate(() => Object.fromEntries(window.strut.state.styles.map((s) => [s.name, s.weight])));
const alert = () => page.getByRole("alert").textContent();
const polygon = async () => {
  const { x, y } = await middleOf(page.locator(".polygon-box"));
  return { clientX: x, clientY: y };
};

describe("a walk that falls on the polygon", () => {
  it("becomes a style, is kept, and goes again", async () => {
    const input = await inputName(page);
    await dropFile(page, "walk_weary_01.bvh", walk, await polygon());
    await page.getByRole("dialog").waitFor();
    // The file's name contains this action.
    await eventually(() => page.getByLabel("Action of the clip").inputValue()).toBe("walk");
    await screenshot(page, "style-of-clip-name");
    const begin = performance.now();
    await page.keyboard.press("Enter");
    await eventually(vertices).toContain("weary");
    const secs = (performance.now() - begin) / 1000;
    console.log(`a style from a clip of 260 frames: ${secs.toFixed(1)} s`);
    await eventually(vertices).toHaveLength(9);
    await eventually(weights).toMatchObject({ weary: 1 });
    expect(await inputName(page), "the input stays").toBe(input);
    expect(await alert()).toBe("");
    await eventually(() => page.locator(".stage-title").textContent()).toContain("weary");
    await screenshot(page, "style-of-clip");
    // Wait for another frame of it.
    const before = await page.evaluate(() => window.strut.frame!.inputFrame);
    await eventually(() => page.evaluate(() => window.strut.frame!.inputFrame)).not.toBe(before);

    await page.getByRole("button", { name: "Undo" }).click();
    await eventually(vertices).toHaveLength(8);
    await eventually(() => page.evaluate(() => window.strut.state.database)).toBe("");
    await page.getByRole("button", { name: "Redo" }).click();
    await eventually(vertices).toContain("weary");
    await eventually(weights).toMatchObject({ weary: 1 });
    await eventually(() => page.evaluate(() => window.strut.state.database)).toBe("Built-in + weary");
  });

  it("has the name that the person gives it", async () => {
    await dropFile(page, "walk_weary_02.bvh", walk, await polygon());
    const name = page.getByLabel("Name of the style");
    await eventually(() => name.inputValue()).toBe("weary 2");
    await name.fill("weary");
    const make = page.getByRole("button", { name: "Make it a style" });
    await eventually(() => make.isDisabled()).toBe(true);
    await eventually(() => page.getByRole("dialog").textContent()).toContain("A style “weary” already exists.");
    await name.fill("<b>tired</b>");
    await make.click();
    await eventually(vertices).toContain("<b>tired</b>");
    await eventually(() => page.evaluate(() => window.strut.state.database)).toBe("Built-in + weary + <b>tired</b>");
    await page.getByRole("button", { name: "Undo" }).click();
    await eventually(vertices).toHaveLength(9);
  });

  it("is left alone where the person does not want it", async () => {
    await dropFile(page, "walk_weary_02.bvh", walk, await polygon());
    await page.getByRole("dialog").waitFor();
    await page.keyboard.press("Escape");
    await eventually(() => page.getByRole("dialog").count()).toBe(0);
    expect(await vertices()).toHaveLength(9);
  });

  it("says which action was found in it, and lets that be changed", async () => {
    await dropFile(page, "stooping_01.bvh", walk, await polygon());
    const action = page.getByLabel("Action of the clip");
    // The file's name does not contain an action.
    await eventually(() => action.inputValue()).toBe("");
    await page.getByRole("button", { name: "Make it a style" }).click();
    const says = (text: string) => page.getByRole("status").getByText(text);
    await eventually(() => says("“stooping” was made from the action “walk” and changes no other.").isVisible()).toBe(
      true,
    );
    await screenshot(page, "style-of-clip-action");
    const change = page.getByRole("button", { name: "Change…" }).last();
    await change.click();
    await eventually(() => action.inputValue()).toBe("walk");
    await action.selectOption("jump");
    await page.getByRole("button", { name: "Make it a style" }).click();
    // A walk is not a jump: the previous result is kept.
    await eventually(alert).toContain(
      "does not fit 'jump': it contains walking or running, unlike the other clips of the action; it fits 'walk'",
    );
    expect(await vertices()).toContain("stooping");
    await page.getByRole("button", { name: "Dismiss" }).first().click();
    await change.click();
    await page.getByLabel("Name of the style").fill("bent");
    await action.selectOption("walk");
    await page.getByRole("button", { name: "Make it a style" }).click();
    await eventually(() => says("“bent” was made from the action “walk”").isVisible()).toBe(true);
    await eventually(vertices).toContain("bent");
    // It replaces the one before.
    expect(await vertices()).not.toContain("stooping");
  });

  it("is refused with a sentence where it is too short", async () => {
    await dropFile(page, "walk_short.bvh", everyNth(walk, 1, 40), await polygon());
    await eventually(() => page.getByRole("dialog").textContent()).toContain("It needs at least 1 s");
    await page.getByRole("button", { name: "Make it a style" }).click();
    await eventually(alert).toContain("It lasts 0.7 s; a complete action of at least 1.0 s was expected");
    expect(await vertices()).toContain("weary");
  });

  it("elsewhere it is the input, as ever", async () => {
    await dropFile(page, "walk_weary_01.bvh", walk);
    await eventually(() => inputName(page)).toBe("walk_weary_01");
  });

  it("is a style until the page is closed where the browser has no room left", async () => {
    await page.evaluate(() => {
      const { add } = IDBObjectStore.prototype;
      IDBObjectStore.prototype.add = function (this: IDBObjectStore, ...args: Parameters<typeof add>) {
        const request = add.apply(this, args);
        this.transaction.abort();
        return request;
      };
      const full = new DOMException("full", "QuotaExceededError");
      Object.defineProperty(IDBTransaction.prototype, "error", { get: () => full });
    });
    await dropFile(page, "walk_stooped_01.bvh", walk, await polygon());
    await page.getByRole("button", { name: "Make it a style" }).click();
    await eventually(alert).toMatch(/“stooped” will not be here after a reload. The browser has no room left for it./);
    await eventually(vertices).toContain("stooped");
    await eventually(weights).toMatchObject({ stooped: 1 });
    await screenshot(page, "quota-full");
  });
});
