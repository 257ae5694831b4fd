/** Every lesson on the page: accessible, on a narrow screen, in German; and features of single lessons. */
import type { Page } from "playwright-core";
import { beforeAll, describe, it, test } from "vitest";
import { LESSONS } from "../../web/lessons/lessons";
import { learn as german } from "../../web/lessons/text/de";
import { axeFaults } from "./axe";
import { eventually, openSite, screenshot, visit } from "./browser";
import { expectFitsNarrow } from "./narrow";
import { transitionsEnded } from "./rest";

const WIDE = { width: 1440, height: 900 };
const NARROW = { width: 390, height: 844 };

let page: Page;
beforeAll(async () => {
  const opened = await openSite({ hash: "view=learn&lesson=style&beat=4", size: WIDE, theme: "light" });
  page = opened.page;
  return opened.close;
});

const verdict = (exercise: string) => page.locator(`[data-exercise="${exercise}"] .verdict`).textContent();
const begin = (exercise: string) =>
  page.locator(`[data-exercise="${exercise}"]`).getByRole("button", { name: "Begin" }).press("Enter");

/** Opens a lesson, and waits until its figures are drawn. */
async function open(lesson: string, rest = ""): Promise<void> {
  await visit(page, `view=learn&lesson=${lesson}&beat=4${rest}`);
  await page.waitForFunction(
    (id) => document.querySelector<HTMLSelectElement>(".lessons select")?.value === id,
    lesson,
  );
  await page.evaluate(async () => {
    for (const figure of document.querySelectorAll("strut-figure:not([hidden])"))
      await (figure as HTMLElement & { ready(): Promise<void> }).ready();
  });
}

/** Returns the displayed value of a symbol. */
async function liveValue(term: string): Promise<number> {
  const text = await page.locator(`.learn-symbols [data-term="${term}"]`).textContent();
  return Number(/(−?\d+(\.\d+)?)\D*$/.exec(text!)![1]!.replace("−", "-"));
}

describe.each(LESSONS)("$id", ({ id }) => {
  test("is accessible, and says what its figures show", async () => {
    await page.setViewportSize(WIDE);
    await open(id);
    const said = () => page.locator("strut-figure:not([hidden]) [role=status]").allTextContents();
    await eventually(async () => (await said()).every((sentence) => sentence.length > 10)).toBe(true);
    await transitionsEnded(page);
    await eventually(() => axeFaults(page)).toEqual([]);
    await screenshot(page, `lesson-${id}`);
  });

  test("fits a narrow screen, in German, in the dark", async () => {
    await page.setViewportSize(NARROW);
    await open(id, "&theme=dark&lang=de");
    await eventually(() => page.locator("h1.learn-title").textContent()).toBe(german.titles[id]);
    await expectFitsNarrow(page, ".learn-text button:visible, .learn-text select:visible");
    await screenshot(page, `lesson-${id}-narrow`);
  });
});

describe("by the keyboard alone", () => {
  beforeAll(() => page.setViewportSize(WIDE));

  it("pose: a knee is brought to its mean", async () => {
    await open("pose");
    await begin("B");
    const joint = page.locator('strut-figure[data-name="joint"]');
    await joint.getByRole("slider", { name: "w about x" }).focus();
    await page.keyboard.press("Home");
    await eventually(() => verdict("B")).toMatch(/^✗ ?\|w\| is 1[78]\d\.\d\d°\.$/);
    await page.keyboard.type("4");
    await page.keyboard.press("Enter");
    await eventually(() => verdict("B")).toMatch(/^≈ ?Close: \d\.\d\d°\. Straighten it a little\.$/);
    await joint.getByRole("slider", { name: "w about x" }).focus();
    await page.keyboard.type("0");
    await page.keyboard.press("Enter");
    await eventually(() => verdict("B")).toMatch(/^✓ ?Yes: \|w\| is 0\.\d\d°\./);
    await screenshot(page, "lesson-pose-solved");
  });

  it("register: the cursor goes to where DTW mends the feet", async () => {
    await open("register");
    await begin("B");
    const warp = page.locator('strut-figure[data-name="warp"]');
    await warp.getByRole("slider", { name: "Instant" }).focus();
    await page.keyboard.press("Home");
    await eventually(() => verdict("B")).toMatch(/^✗ ?At 0 ms/);
    for (let i = 0; i < 2; i++) await page.keyboard.press("ArrowRight");
    await eventually(() => verdict("B")).toMatch(/^≈ ?Close: a little later\.$/);
    for (let i = 0; i < 2; i++) await page.keyboard.press("Shift+ArrowRight");
    await eventually(() => verdict("B")).toMatch(/^✓ ?Yes: DTW pairs 200 ms with \d+ ms/);
    await screenshot(page, "lesson-register-solved");
  });

  it("near: a query is moved by its mark, and its distance stays", async () => {
    await open("near");
    await begin("B");
    const query = page.locator('strut-figure[data-name="query"]');
    await query.getByRole("slider", { name: "Position of the query" }).focus();
    for (let i = 0; i < 6; i++) await page.keyboard.press("ArrowUp");
    await query.getByRole("slider", { name: "Turn" }).focus();
    await page.keyboard.type("60");
    await page.keyboard.press("Enter");
    await eventually(() => verdict("B")).toMatch(/^≈ ?Now enter the change below the plot\.$/);
    const change = page.getByRole("textbox", { name: "√D₁ changed by, mm" });
    await change.focus();
    await page.keyboard.type("600");
    await page.keyboard.press("Tab");
    await eventually(() => verdict("B")).toMatch(/^✗ ?You entered 600\.00 mm, but √D₁ changed by 0\.00 mm/);
    await change.fill("0");
    await page.keyboard.press("Tab");
    await eventually(() => verdict("B")).toMatch(/^✓ ?Yes: it changed by 0\.00 mm\./);
    await screenshot(page, "lesson-near-solved");
  });

  it("bias: the least band is computed from the values of the symbols", async () => {
    await open("bias");
    await begin("B");
    await eventually(() => liveValue("x")).toBeLessThan(0);
    const least = Math.abs((await liveValue("x")) - (await liveValue("mu"))) / (await liveValue("sigma"));
    await page.getByRole("slider", { name: "Reach κ" }).focus();
    await page.keyboard.type((least + 0.15).toFixed(1));
    await page.keyboard.press("Enter");
    await eventually(() => verdict("B")).toMatch(/^✓ ?Yes: with κ \d\.\d the band just reaches/);
    await screenshot(page, "lesson-bias-solved");
  });

  it("time: weights of two styles are set until the walk takes 1.2 times as long", async () => {
    await open("time");
    await begin("A");
    const blend = page.locator('strut-figure[data-name="polygon"]').getByRole("slider", { name: "Blend" });
    await blend.focus();
    for (let i = 0; i < 7; i++) await page.keyboard.press("ArrowLeft");
    await eventually(() => verdict("A")).toMatch(/^✗ ?Length now 17\.79 s/);
    for (let i = 0; i < 2; i++) await page.keyboard.press("Shift+ArrowLeft");
    await eventually(() => verdict("A")).toMatch(/^≈ ?Close: length now 17\.7\d s\. A little less old\.$/);
    for (let i = 0; i < 2; i++) await page.keyboard.press("Shift+ArrowLeft");
    await eventually(() => verdict("A")).toMatch(/^✓ ?Yes: with 0\.61 of old it takes 1\.20 times as long\./);
    await screenshot(page, "lesson-time-solved");
  });

  it("feet: a knee is bent by moving the ankle", async () => {
    await open("feet");
    await begin("B");
    const ankle = page.locator('strut-figure[data-name="leg"]').getByRole("slider", { name: "Ankle" });
    await ankle.focus();
    for (let i = 0; i < 5; i++) await page.keyboard.press("ArrowLeft");
    for (let i = 0; i < 4; i++) await page.keyboard.press("ArrowUp");
    await eventually(() => verdict("B")).toMatch(/^≈ ?Close: 5[6-9]\.\d°\. Bend it a little more\.$/);
    for (let i = 0; i < 3; i++) await page.keyboard.press("Shift+ArrowUp");
    await eventually(() => verdict("B")).toMatch(/^✓ ?Yes: at d 0\.69\d m the knee is bent by [56]\d\.\d°\./);
    await screenshot(page, "lesson-feet-solved");
  });

  it("judge: the number of a method that had seen the answer is refused", async () => {
    await open("judge");
    await begin("B");
    const methods = page.locator('strut-figure[data-name="methods"]');
    const picked = () => methods.locator(".method.picked .pose .number").textContent();
    await eventually(picked).toMatch(/^9\.\d\d$/);
    await methods.getByRole("switch", { name: "Leave it in" }).focus();
    await page.keyboard.press("Space");
    await eventually(picked).toMatch(/^0\.\d\d$/);
    await methods.getByRole("radio", { name: "not ticked" }).focus();
    await page.keyboard.press("ArrowLeft");
    await eventually(() => verdict("B")).toMatch(/^✗ ?NN had seen the answer\. 0\.\d\d mm/);
    await page.keyboard.press("ArrowLeft");
    await eventually(() => verdict("B")).toMatch(/^✓ ?Yes: 9\.\d\d mm\./);
    await screenshot(page, "lesson-judge-solved");
  });

  it("chain: steps are made longer by their ends", async () => {
    await open("chain");
    await begin("C");
    const chain = page.locator('strut-figure[data-name="chain"]');
    await chain.getByRole("slider", { name: "End of the left step" }).focus();
    for (let i = 0; i < 3; i++) await page.keyboard.press("ArrowRight");
    await eventually(() => verdict("C")).toMatch(/^✗ ?10\d\.\d steps a minute\.$/);
    await chain.getByRole("slider", { name: "ρ of right steps" }).focus();
    await page.keyboard.type("1");
    await page.keyboard.press("Enter");
    await eventually(() => verdict("C")).toMatch(/^[✓≈] ?/);
    await chain.getByRole("slider", { name: "ρ of left steps" }).focus();
    await page.keyboard.type("1.05");
    await page.keyboard.press("Enter");
    await eventually(() => verdict("C")).toMatch(/^✓ ?Yes: (99|100)\.\d steps a minute with ρ 1\.05 and 1\.00\.$/);
    await screenshot(page, "lesson-chain-solved");
  });

  it("map: the pass is found after which it has learned", async () => {
    await open("map");
    await begin("A");
    await page.locator('strut-figure[data-name="learning"]').getByRole("slider", { name: "pass" }).focus();
    await page.keyboard.press("End");
    await eventually(() => verdict("A")).toMatch(/^✗ ?After 20 passes it is 1\.3\d°\./);
    await page.keyboard.press("Home");
    for (let i = 0; i < 7; i++) await page.keyboard.press("ArrowRight");
    await eventually(() => verdict("A")).toMatch(/^≈ ?Close: 1\.4\d° after pass 7\. A little later\.$/);
    await page.keyboard.press("ArrowRight");
    await eventually(() => verdict("A")).toMatch(/^✓ ?Yes: pass 8, 1\.38°/);
    await screenshot(page, "lesson-map-solved");
  });

  it("map: learning plays only when it is asked to, and stops", async () => {
    await open("map");
    await visit(page, "view=learn&lesson=map&beat=5&updates=0");
    const som = page.locator('strut-figure[data-name="som"]');
    const updates = async () => Number.parseInt((await som.locator(".readout").textContent())!, 10);
    await eventually(updates).toBe(0);
    await som.getByRole("button", { name: "Play" }).press("Enter");
    await eventually(async () => (await updates()) > 3).toBe(true);
    await som.getByRole("button", { name: "Pause" }).press("Enter");
    await eventually(() => som.getByRole("button", { name: "Play" }).count()).toBe(1);
    const linked = () => Number(new URLSearchParams(new URL(page.url()).hash.slice(1)).get("updates"));
    await eventually(async () => (await updates()) - linked()).toBe(0);
  });
});
