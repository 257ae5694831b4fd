/** Files of the site that are missing or damaged: the page continues with what it has, and a click retries. */
import type { Page } from "playwright-core";
import { beforeAll, beforeEach, describe, expect, it } from "vitest";
import type { StrutHook } from "../../../web/app/shell/hook";
import { walksIn } from "../../clips";
import { zipOf } from "../../zip";
import { dropFile, eventually, inputName, openSite, settledPose, shown, turnBetween, visit } from "../browser";
import { dismissAll } from "./inject";

declare const window: { strut: StrutHook };

const STILL = "play=0&frame=60&styles=proud:1,old:0,depressed:0";

let page: Page;
let neutral: string;

beforeAll(async () => {
  const [opened, walks] = await Promise.all([openSite({ hash: STILL }), walksIn(["neutral"])]);
  [page, neutral] = [opened.page, walks.neutral];
  return opened.close;
});
beforeEach(() => dismissAll(page));

const alert = () => page.getByRole("alert").textContent();
const view = () => page.evaluate(() => window.strut.state.view);

describe("a view of a version that the host no longer has", () => {
  it("is said to be missing, what was shown stays, and Reload brings the page of now", async () => {
    await visit(page, STILL);
    const before = await settledPose(page);
    const code = /\/key_style_view-[^/]*\.js$/;
    await page.route(code, (route) => route.fulfill({ status: 404, body: "" }));
    await page.getByRole("link", { name: "Key-style", exact: true }).click();
    await eventually(alert).toMatch(/This view could not be loaded. Reload the page./);
    await eventually(view).toBe("play");
    expect(turnBetween(before, await settledPose(page))).toBeLessThan(0.2);
    await page.unroute(code);
    await page.getByRole("alert").getByRole("button", { name: "Reload" }).click();
    await eventually(alert).toBe("");
    await shown(page);
    expect(await page.evaluate(() => window.strut.state.styles[0])).toEqual({ name: "proud", weight: 1 });
    await page.getByRole("link", { name: "Key-style", exact: true }).click();
    await eventually(view).toBe("key-style");
  });
});

describe("an archive", () => {
  it("whose reader cannot be loaded gets a sentence, and what was shown stays", async () => {
    await visit(page, STILL);
    const before = await settledPose(page);
    const code = /\/models_of_archive-[^/]*\.js$/;
    await page.route(code, (route) => route.fulfill({ status: 404, body: "" }));
    await dropFile(page, "clips.zip", zipOf([{ name: "walk_old_1.bvh", content: neutral }]));
    await eventually(alert).toMatch(/A part of this page could not be loaded/);
    await page.unroute(code);
    expect(await inputName(page)).toBe("neutral walk");
    expect(turnBetween(before, await settledPose(page))).toBeLessThan(0.2);
  });
});

describe("the list of public data sets", () => {
  const note = () => page.locator(".catalogue [role=status].caption").textContent();

  it("that is damaged: a sentence, and all else of the view works", async () => {
    await page.route("**/catalog.json", (route) => route.fulfill({ body: '{"version":1,"sets":[{"id":"half' }));
    await visit(page, "view=data&play=0");
    await eventually(note).toMatch(/The list of public data sets/);
    await dropFile(page, "walk_old_1.bvh", neutral);
    await eventually(() => page.locator(".data-clips h1").textContent()).toBe("1 clip, 1 style");
    await page.unroute("**/catalog.json");
    await page.locator(".catalogue").getByRole("button", { name: "Try again" }).click();
    await page.locator(".catalogue").getByRole("button", { name: /^Get / }).first().waitFor();
  });
});

describe("a line that is as slow as can be", () => {
  it("a view that does not come keeps no one from the one that is shown, and another choice is not overtaken", async () => {
    await visit(page, STILL);
    const code = /\/compare_view-[^/]*\.js$/;
    let answer = () => {};
    await page.route(code, async (route) => {
      await new Promise<void>((resolve) => {
        answer = resolve;
      });
      await route.continue().catch(() => {});
    });
    await page.getByRole("link", { name: "Compare", exact: true }).click();
    await dropFile(page, "mine.bvh", neutral);
    await eventually(() => inputName(page)).toBe("mine");
    await page.getByRole("link", { name: "Play", exact: true }).click();
    answer();
    await page.unroute(code);
    await settledPose(page);
    await eventually(view).toBe("play");
    expect(await page.locator("#app").getAttribute("data-view")).toBe("play");
    expect(await alert()).toBe("");
  });
});
