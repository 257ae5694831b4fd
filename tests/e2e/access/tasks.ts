/** The main task of each view, with any input method. */
import type { Page } from "playwright-core";
import { expect } from "vitest";
import type { StrutHook } from "../../../web/app/shell/hook";
import { eventually, visit } from "../browser";
import type { Hands } from "./hands";

declare const window: { strut: StrutHook };

/** A user at the page. */
export interface Person {
  page: Page;
  hands: Hands;
}

/** A file to choose. */
export interface NamedClip {
  name: string;
  content: string;
}

const state = (page: Page) => page.evaluate(() => window.strut.state);

/** Opens a view by its tab, or by the menu that replaces the tabs on a narrow screen. */
async function open({ page, hands }: Person, view: string): Promise<void> {
  const tab = page.getByRole("link", { name: view, exact: true });
  if (await tab.isVisible()) return hands.press(tab);
  await hands.press(page.getByRole("button", { name: "Menu", exact: true }));
  await hands.press(page.locator("#menu").getByRole("button", { name: view, exact: true }));
}

/** Presses a control that saves a file, and returns the file's name. */
async function savedBy(page: Page, press: Promise<void>): Promise<string> {
  const [download] = await Promise.all([page.waitForEvent("download"), press]);
  return download.suggestedFilename();
}

/** Play: changes the style and saves as BVH. */
export async function play({ page, hands }: Person): Promise<void> {
  await visit(page, "play=0&frame=60&styles=proud:0.6,old:0.1,childlike:0.3");
  const weights = async () => (await state(page)).styles.map(({ weight }) => weight);
  await eventually(weights).toEqual([0.6, 0.1, 0.3]);
  // The built-in database, regardless of the database before.
  await page.locator('.vertex[data-style="childlike"]').waitFor();
  await page.waitForFunction(() => window.strut.analysed);
  await hands.move(page.getByRole("slider", { name: "Style", exact: true }), { x: 0, y: 30 });
  await eventually(weights).not.toEqual([0.6, 0.1, 0.3]);
  await page.waitForFunction(() => window.strut.analysed);
  await hands.press(page.getByRole("button", { name: "Export", exact: true }));
  const item = page.locator(".export-menu").getByRole("button", { name: /^BVH/ });
  expect(await savedBy(page, hands.press(item))).toMatch(/\.bvh$/);
}

/** Walk: selects a block, shortens it and changes its style, and saves the walk. */
export async function walk(person: Person): Promise<void> {
  const { page, hands } = person;
  await open(person, "Walk");
  await visit(page, "view=walk&play=0&walk=1_3_2~neutral:1,old:0,sexy:0;1_4_2~proud:1,old:0,sexy:0");
  await eventually(() => page.locator(".walk .stage-title").textContent()).toMatch(/two styles$/);
  const second = async () => (await state(page)).walk[1]!;
  await hands.press(page.locator('[data-key="block-1"]'));
  await eventually(async () => (await state(page)).walkBlock).toBe(1);
  await hands.move(page.locator('[data-key="end-1"]'), { x: -60, y: 0 });
  await eventually(async () => (await second()).steps).toBeLessThan(4);
  await hands.move(page.locator(".walk-panel").getByRole("slider", { name: "Style", exact: true }), { x: 0, y: 40 });
  await eventually(async () => (await second()).styles[0]!.weight).toBeLessThan(1);
  const save = page.locator(".walk .editor-actions").getByRole("button", { name: "BVH", exact: true });
  expect(await savedBy(page, hands.press(save))).toBe("walk.bvh");
}

/** Walk: scrolling with the finger on a slider must not change it. */
export async function scrollPast({ page, hands }: Person): Promise<void> {
  await visit(page, "view=walk&play=0&block=1&walk=1_3_2~neutral:1,old:0,sexy:0;1_4_2~proud:1,old:0,sexy:0");
  const intensity = page.locator(".walk-panel").getByRole("slider", { name: "Intensity", exact: true });
  await intensity.waitFor();
  const before = await intensity.inputValue();
  const top = () => page.locator("main.walk").evaluate((e) => e.scrollTop);
  await hands.move(intensity, { x: 0, y: 80 });
  const scrolled = await top();
  await hands.move(intensity, { x: 0, y: -80 });
  await eventually(top).toBeGreaterThan(scrolled);
  expect(await intensity.inputValue()).toBe(before);
}

/** Key-style: moves the point, sets a key there, and saves the motion. */
export async function keyStyle(person: Person): Promise<void> {
  const { page, hands } = person;
  await open(person, "Key-style");
  await visit(page, "view=key-style&play=0&secs=0.2");
  await page.locator('.key-style[aria-busy="false"] .pad-key').first().waitFor();
  const count = async () => (await state(page)).keys.length;
  const [keys, at] = [await count(), (await state(page)).keyHandle];
  await hands.move(page.locator(".pad").getByRole("slider", { name: "Style", exact: true }), { x: 40, y: -20 });
  await eventually(async () => (await state(page)).keyHandle).not.toEqual(at);
  const foot = page.locator(".key-style .editor-actions");
  await hands.press(foot.getByRole("button", { name: "Set a key", exact: true }));
  await eventually(count).toBe(keys + 1);
  expect(await savedBy(page, hands.press(foot.getByRole("button", { name: "BVH", exact: true })))).toBe(
    "key-style.bvh",
  );
}

/** Data: chooses clips, builds a database of them, and opens it. */
export async function data(person: Person, clips: readonly NamedClip[]): Promise<void> {
  const { page, hands } = person;
  await open(person, "Data");
  const clear = page.getByRole("button", { name: "Clear", exact: true });
  const choose = page.getByRole("button", { name: "Choose files", exact: true });
  await page.locator(".data").waitFor();
  if (await clear.isVisible()) await hands.press(clear);
  const [chooser] = await Promise.all([page.waitForEvent("filechooser"), hands.press(choose)]);
  const files = clips.map(({ name, content }) => ({ name, mimeType: "text/plain", buffer: Buffer.from(content) }));
  await chooser.setFiles(files);
  await page.locator('.data.filled[aria-busy="false"]').waitFor();
  const name = page.getByLabel("Name of the database");
  await eventually(() => name.inputValue()).toMatch(/^My clips/);
  const database = await name.inputValue();
  await hands.press(page.getByRole("button", { name: "Build the database", exact: true }));
  await hands.press(page.getByRole("button", { name: `Open ${database}`, exact: true }));
  await eventually(async () => (await state(page)).database).toBe(database);
  await eventually(async () => (await state(page)).view).toBe("play");
}

/** Returns the visible part of a lesson; buttons select the parts, from 1 on. */
const lessonPart = (page: Page) => page.locator(".learn-part:not([hidden])");
const partButton = (page: Page, n: number) => page.locator(".learn-steps button").nth(n - 1);

/** Places the bet of a lesson, which shows its topic. */
async function placeBet({ page, hands }: Person, lesson: string): Promise<void> {
  await visit(page, `view=learn&play=0&lesson=${lesson}`);
  await eventually(() => page.locator(".lessons select").inputValue()).toBe(lesson);
  const shown = lessonPart(page);
  await hands.press(partButton(page, 2));
  await hands.press(shown.getByRole("radio").first());
  await hands.press(shown.getByRole("button", { name: "Place the bet", exact: true }));
  await eventually(() => shown.locator(".reveal").textContent()).toMatch(/\w/);
}

/** Learn: places a bet, starts an exercise and answers it. */
export async function learn(person: Person, lesson: string): Promise<void> {
  await placeBet(person, lesson);
  const { page, hands } = person;
  await hands.press(partButton(page, 5));
  await hands.press(lessonPart(page).getByRole("button", { name: "Begin", exact: true }).first());
  await eventually(async () => (await state(page)).task).not.toBe("");
  await moveInFigure(person, ".playhead");
}

/** The lesson on poses: turns a limb of the figure. */
export async function pose(person: Person): Promise<void> {
  await placeBet(person, "pose");
  await person.hands.press(partButton(person.page, 3));
  await moveInFigure(person, ".limb");
}

async function moveInFigure({ page, hands }: Person, handle: string): Promise<void> {
  const figures = async () => (await state(page)).figures;
  const before = await figures();
  await hands.move(page.locator("strut-figure:not([hidden])").locator(handle).last(), { x: 30, y: 0 });
  await eventually(figures).not.toBe(before);
}
