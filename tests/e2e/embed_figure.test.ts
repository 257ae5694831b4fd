/** Figures of the lessons on pages of another host: as an iframe and as an element, with the state of a link. */
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import type { StrutFigure } from "../../web/figures/figure_element";
import { LESSONS } from "../../web/lessons/lessons";
import { serveFolder } from "../package/server";
import { axeFaults } from "./axe";
import { eventually, openSite, screenshot, visit } from "./browser";
import { failNextCall } from "./faults/inject";

const STATE = "i=200&K=12&ridge=0.02";

let site: Awaited<ReturnType<typeof openSite>>;
let folder: string;
let elsewhere: Awaited<ReturnType<typeof serveFolder>>;
beforeAll(async () => {
  folder = mkdtempSync(join(tmpdir(), "strut-figure-"));
  [site, elsewhere] = await Promise.all([
    openSite({ hash: `view=learn&lesson=line&beat=3&${STATE}` }),
    serveFolder(folder),
  ]);
});
afterAll(async () => {
  await site.close();
  await elsewhere.close();
  rmSync(folder, { recursive: true });
});

/** Opens a page of another host with a body. */
async function openElsewhere(body: string): Promise<Page> {
  const head =
    '<!doctype html><html lang="en"><meta charset="utf-8"><title>A page</title><main><h1>A page</h1><h2>A figure</h2>';
  writeFileSync(join(folder, "index.html"), `${head}${body}</main>`);
  const context = await site.browser.newContext({ viewport: { width: 800, height: 600 } });
  const page = await context.newPage();
  await page.goto(elsewhere.url);
  return page;
}

/** The element's script may be loaded after the element. */
async function measured(figure: Element): Promise<unknown> {
  await customElements.whenDefined("strut-figure");
  return (figure as StrutFigure).measure();
}

describe("a figure elsewhere", () => {
  test("is the code that the lesson gives, as a frame and as an element, and measures the same to the bit", async () => {
    const { page } = site;
    const own = page.locator('strut-figure[data-name="scatter"]');
    const expected = await own.evaluate(measured);
    expect(expected).toMatchObject({ k: 12, lambda: 0.02 });
    await page.getByRole("button", { name: "Embed a figure" }).click();
    const dialog = page.getByRole("dialog", { name: "Embed a figure" });
    const code = dialog.getByRole("textbox", { name: "Code to copy" });
    const frame = await code.inputValue();
    expect(frame.split("\n")).toHaveLength(1);
    await dialog.getByRole("radio", { name: "Element" }).check();
    const element = await code.inputValue();
    expect(element.split("\n")).toHaveLength(2);
    await eventually(() => axeFaults(page)).toEqual([]);
    await dialog.getByRole("button", { name: "Close" }).click();

    const framed = await openElsewhere(frame);
    expect(await framed.frameLocator("iframe").locator("strut-figure").evaluate(measured)).toEqual(expected);
    await framed.context().close();
    const placed = await openElsewhere(element);
    expect(await placed.locator("strut-figure").evaluate(measured)).toEqual(expected);
    const colour = placed.locator("strut-figure .dots");
    expect(await colour.evaluate((dot) => getComputedStyle(dot).fill)).toBe("rgb(223, 165, 31)");
    await eventually(() => axeFaults(placed)).toEqual([]);
    await screenshot(placed, "figure-elsewhere");
    await placed.context().close();
  });

  test("of any kind repeats a lesson's link to the bit", async () => {
    const { page } = site;
    const state = "i=201";
    const expected: { kind: string; measure: unknown }[] = [];
    for (const { id, load } of LESSONS) {
      await visit(page, `view=learn&lesson=${id}&beat=4&${state}`);
      await page.waitForFunction(
        (lesson) => document.querySelector<HTMLSelectElement>(".lessons select")?.value === lesson,
        id,
      );
      for (const { name, kind } of (await load()).figures)
        expected.push({ kind, measure: await page.locator(`strut-figure[data-name="${name}"]`).evaluate(measured) });
    }
    expect(new Set(expected.map(({ kind }) => kind)).size).toBeGreaterThan(30);
    const figures = expected.map(({ kind }) => `<strut-figure kind="${kind}" state="${state}"></strut-figure>`);
    const placed = await openElsewhere(
      `<script type="module" src="${site.site.url}strut-figure.js"></script>${figures.join("")}`,
    );
    for (const [i, { kind, measure }] of expected.entries())
      expect(await placed.locator("strut-figure").nth(i).evaluate(measured), kind).toEqual(measure);
    await placed.context().close();
  });

  test("tells the page around its frame what a visitor set, and takes a state from it", async () => {
    const page = await openElsewhere(
      `<script>told = []; addEventListener("message", ({ data }) => told.push(data));</script>
       <iframe title="A figure" width="688" height="480" src="${site.site.url}figure.html?kind=scatter#${STATE}"></iframe>`,
    );
    const figure = page.frameLocator("iframe").locator("strut-figure");
    await figure.evaluate(measured);
    await figure.getByRole("slider", { name: "Neighbours K" }).press("End");
    const told = () => page.evaluate(() => JSON.stringify((globalThis as unknown as { told: object[] }).told.at(-1)));
    await eventually(told).toBe('{"strut":1,"event":"statechange","state":{"state":"i=200&K=160&ridge=0.02"}}');
    await page.evaluate(() =>
      document.querySelector("iframe")!.contentWindow!.postMessage({ strut: 1, set: { state: "K=5" } }, "*"),
    );
    await eventually(() => figure.evaluate((element) => (element as StrutFigure).state)).toBe("K=5");
    expect(await figure.evaluate(measured)).toMatchObject({ k: 5 });
    await page.context().close();
  });

  test("that could not be loaded is loaded by a click", async () => {
    const page = await openElsewhere("");
    let isDown = true;
    await page.route(/scatter/, (route) => (isDown ? route.abort() : route.continue()));
    await page.evaluate((address) => {
      const script = Object.assign(document.createElement("script"), { type: "module", src: address });
      document.body.append(script, Object.assign(document.createElement("strut-figure")));
      document.querySelector("strut-figure")!.setAttribute("kind", "scatter");
    }, `${site.site.url}strut-figure.js`);
    const message = page.locator("strut-figure .message");
    await eventually(() => message.textContent()).toContain("could not be created");
    isDown = false;
    await message.getByRole("button", { name: "Try again" }).click();
    await eventually(() => page.locator("strut-figure").evaluate((figure) => (figure as StrutFigure).heading)).not.toBe(
      "",
    );
    await page.context().close();
  });

  test("that fails while it is changed says so, and shows the next change", async () => {
    const page = await openElsewhere(
      `<script type="module" src="${site.site.url}strut-figure.js"></script>
       <strut-figure kind="scatter" state="${STATE}"></strut-figure>`,
    );
    const errors: string[] = [];
    page.on("pageerror", ({ message }) => errors.push(message));
    const figure = page.locator("strut-figure");
    await figure.evaluate(measured);
    await failNextCall(page, "fit", "fails");
    await figure.getByRole("slider", { name: "Neighbours K" }).press("End");
    const message = figure.locator(".message");
    await eventually(() => message.textContent()).toContain("ended for the test");
    await figure.getByRole("slider", { name: "Neighbours K" }).press("Home");
    await eventually(() => message.isVisible()).toBe(false);
    expect(await figure.evaluate(measured)).toMatchObject({ k: 1 });
    expect(errors).toEqual([]);
    await page.context().close();
  });

  test("says what it cannot be, and shows its poster until then", async () => {
    const page = await openElsewhere(
      `<script type="module" src="${site.site.url}strut-figure.js"></script>
       <strut-figure kind="no such kind" poster="data:image/gif;base64,R0lGODlhAQABAAAAACH5BAEKAAEALAAAAAABAAEAAAICTAEAOw=="></strut-figure>`,
    );
    await eventually(() => page.locator("strut-figure .message").textContent()).toBe(
      "There is no figure “no such kind”.",
    );
    expect(await page.locator("strut-figure .poster").isVisible()).toBe(true);
    await page.context().close();
  });
});
