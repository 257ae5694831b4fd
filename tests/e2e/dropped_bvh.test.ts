/** A typical BVH file of another tool: other joint names, units and rate than ours. Needs no recordings. */
import type { Page } from "playwright-core";
import { beforeAll, describe, expect, it } from "vitest";
import type { StrutHook } from "../../web/app/shell/hook";
import { asForeignTool, walksIn } from "../clips";
import { FAMILIES } from "../rigs/families";
import { makeRig } from "../rigs/rig";
import { dropFile, eventually, inputName, openSite, saved, settledPose, turnBetween, visit } from "./browser";

declare const window: { strut: StrutHook };

let page: Page;
let walk: string;

beforeAll(async () => {
  const [opened, { neutral }] = await Promise.all([openSite(), walksIn(["neutral"], 260)]);
  [page, walk] = [opened.page, asForeignTool(neutral)];
  return opened.close;
});

describe("a BVH of another tool", () => {
  it("walks in the style", async () => {
    await visit(page, "styles=proud:1,old:0,depressed:0");
    await dropFile(page, "mine.bvh", walk);
    await eventually(() => inputName(page)).toBe("mine");
    await page.waitForFunction(() => window.strut.analysed && window.strut.frame!.inputFrame > 30);
    await visit(page, "play=0&frame=60&input=mine&styles=proud:1,old:0,depressed:0");
    const styled = await settledPose(page);
    expect(styled.every(Number.isFinite)).toBe(true);
    // Its hips are at a person's height, so inches were not read as centimetres.
    expect(styled[1]).toBeGreaterThan(0.7);
    expect(styled[1]).toBeLessThan(1.2);
    // The same instant without the style.
    await visit(page, "play=0&frame=60&input=mine&intensity=0&styles=proud:1,old:0,depressed:0");
    expect(turnBetween(styled, await settledPose(page))).toBeGreaterThan(1);
    expect(await page.getByRole("alert").textContent()).toBe("");
  });

  it("is opened with a character where both are dropped while the page is still opening its own input", async () => {
    await visit(page, "styles=proud:1,old:0,depressed:0");
    await page.reload({ waitUntil: "commit" });
    await page.waitForFunction(() => "strut" in window);
    const { glb } = makeRig(FAMILIES.find(({ name }) => name === "chibi")!);
    await dropFile(page, "chibi.glb", glb);
    await dropFile(page, "early.bvh", walk);
    await eventually(() => inputName(page)).toBe("early");
    await eventually(() => page.locator(".cast-name").textContent()).toBe("chibi");
    await page.waitForFunction(() => window.strut.analysed);
    expect(await inputName(page)).toBe("early");
  });

  it("is exported on its own skeleton", async () => {
    await visit(page, "input=mine&styles=proud:1,old:0,depressed:0");
    const { name, bytes } = await saved(page, "BVH");
    expect(name).toBe("mine-proud.bvh");
    const joints = (bvh: string) => [...bvh.matchAll(/(?:ROOT|JOINT)\s+(\S+)/g)].map((match) => match[1]);
    expect(joints(bytes.toString())).toEqual(joints(walk));
    const offsets = (bvh: string) =>
      [...bvh.matchAll(/OFFSET\s+(.*)/g)].map((match) => match[1]!.split(/\s+/).map(Number));
    for (const [i, offset] of offsets(bytes.toString()).entries())
      for (const [axis, value] of offset.entries()) expect(value).toBeCloseTo(offsets(walk)[i]![axis]!, 2);
  });

  it("has a bar with its length, its rate and its trim", async () => {
    await visit(page, "play=0&frame=60&input=mine&styles=proud:1,old:0,depressed:0");
    await eventually(() => inputName(page)).toBe("mine");
    const bar = page.getByRole("region", { name: "This file" });
    const [from, to] = [bar.getByLabel("Trim from, seconds"), bar.getByLabel("Trim to, seconds")];
    const { secs, rate, frames } = await page.evaluate(() => {
      const facts = document.querySelector(".file-facts")!.textContent!;
      const [, secs, rate] = /^([\d.]+) s · ([\d.]+) Hz$/.exec(facts) ?? [];
      const frames = Number(document.querySelector<HTMLInputElement>(".scrub input")!.max) + 1;
      return { secs: Number(secs), rate: Number(rate), frames };
    });
    expect(secs).toBeCloseTo(frames / 60, 1);
    expect(rate).toBe(Math.round(100 / Number(/Frame Time: (\S+)/.exec(walk)![1])) / 100);
    const range = () => page.evaluate(() => window.strut.state.range);
    await from.fill("0.5");
    await from.press("Enter");
    await eventually(range).toEqual({ first: 30, last: frames - 1 });
    await to.fill("999");
    await to.press("Enter");
    await to.fill("1.5");
    await to.press("Enter");
    await eventually(range).toEqual({ first: 30, last: 90 });
    await eventually(() => bar.textContent()).toContain("1.00 s kept");
    await from.fill("");
    await from.press("Enter");
    expect(await from.inputValue()).toBe("0.50");
    await page.getByRole("button", { name: "Undo" }).click();
    await eventually(range).toEqual({ first: 30, last: frames - 1 });
    await bar.getByRole("button", { name: "Whole clip" }).click();
    await eventually(range).toBeUndefined();
    // A trim belongs to its input.
    await from.fill("0.5");
    await from.press("Enter");
    await page.getByLabel("Input motion").selectOption({ label: "neutral run" });
    await eventually(range).toBeUndefined();
    await eventually(() => bar.isVisible()).toBe(false);
    await page.getByRole("button", { name: "Undo" }).click();
    await eventually(range).toEqual({ first: 30, last: frames - 1 });
    await eventually(() => inputName(page)).toBe("mine");
  });

  it("is chosen as a style beside the polygon", async () => {
    await visit(page, "play=0&frame=60&styles=proud:1,old:0,depressed:0");
    const [chooser] = await Promise.all([
      page.waitForEvent("filechooser"),
      page.getByRole("button", { name: "Add a style" }).click(),
    ]);
    await chooser.setFiles({ name: "tired.bvh", mimeType: "text/plain", buffer: Buffer.from(walk) });
    const dialog = page.getByRole("dialog", { name: "A new style" });
    await eventually(() => dialog.isVisible()).toBe(true);
    await page.keyboard.press("Escape");
    await eventually(() => dialog.count()).toBe(0);
  });

  it("is taken out of the inputs, and undo brings it back", async () => {
    await visit(page, "play=0&frame=60&input=mine&styles=proud:1,old:0,depressed:0");
    await eventually(() => inputName(page)).toBe("mine");
    const remove = page.getByRole("button", { name: "Remove this file from the inputs" });
    const listed = () => page.getByLabel("Input motion").locator("option", { hasText: "mine" }).count();
    await remove.click();
    await eventually(listed).toBe(0);
    expect(await inputName(page)).toBe("neutral walk");
    expect(await remove.isVisible(), "a built-in input stays").toBe(false);
    await page.locator(".toast").getByRole("button", { name: "Undo" }).click();
    await eventually(() => inputName(page)).toBe("mine");
    await page.waitForFunction(() => window.strut.analysed);
    await remove.click();
    await eventually(listed).toBe(0);
    await page.keyboard.press("Control+z");
    await eventually(() => inputName(page)).toBe("mine");
    expect((await saved(page, "BVH")).name).toBe("mine-proud.bvh");
    expect(await page.getByRole("alert").textContent()).toBe("");
  });

  it("comes back by undo also after another was taken out", async () => {
    await visit(page, "play=0&frame=60&input=mine&styles=proud:1,old:0,depressed:0");
    await dropFile(page, "other.bvh", walk);
    await eventually(() => inputName(page)).toBe("other");
    const remove = page.getByRole("button", { name: "Remove this file from the inputs" });
    await remove.click();
    await eventually(() => inputName(page)).toBe("neutral walk");
    await page.getByLabel("Input motion").selectOption("mine");
    await eventually(() => inputName(page)).toBe("mine");
    await remove.click();
    for (const name of ["mine", "neutral walk", "other"]) {
      if (name === "mine") await eventually(() => inputName(page)).toBe("neutral walk");
      await page.keyboard.press("Control+z");
      await eventually(() => inputName(page)).toBe(name);
    }
  });
});
