/**
 * Workers that end at any stage, WebAssembly that is blocked, memory that runs out: a message is shown, nothing is
 * lost, and work can continue.
 */
import type { Page } from "playwright-core";
import { afterEach, beforeAll, describe, expect, it } from "vitest";
import type { StrutHook } from "../../../web/app/shell/hook";
import { walksIn } from "../../clips";
import {
  dropFile,
  eventually,
  inputName,
  openSite,
  saved,
  settledPose,
  shown,
  styledPose,
  turnBetween,
  visit,
} from "../browser";
import { consoleErrors, dismissAll, failNextCall, faultMet, hurryTimers } from "./inject";

declare const window: { strut: StrutHook };

let page: Page;
let errors: string[];
let neutral: string;

beforeAll(async () => {
  const [opened, walks] = await Promise.all([openSite(), walksIn(["neutral"], 300)]);
  page = opened.page;
  errors = consoleErrors(page);
  neutral = walks.neutral;
  return opened.close;
});
afterEach(() => expect(errors.splice(0)).toEqual([]));

const STILL = "play=0&frame=60&styles=proud:1,old:0,depressed:0";
const alert = () => page.getByRole("alert").textContent();
const notes = () => page.locator(".toasts [role=status]").textContent();
const RESTARTED = /The engine crashed and was restarted. Your settings are kept./;

/** Expects the former style, frame and pose, and that the character moves. */
async function expectGoesOn(before: number[]): Promise<void> {
  expect(turnBetween(before, await settledPose(page))).toBeLessThan(0.2);
  await page.keyboard.press("Space");
  await eventually(async () => turnBetween(before, await styledPose(page))).toBeGreaterThan(1);
  await page.keyboard.press("Space");
}

describe("the engine's worker ends", () => {
  it("while a dropped file is opened: the input stays, and the file opens when it is dropped again", async () => {
    await visit(page, STILL);
    const before = await settledPose(page);
    await failNextCall(page, "openMotion", "fails");
    await dropFile(page, "mine.bvh", neutral);
    await eventually(alert).toMatch(/The engine failed/);
    await eventually(notes).toMatch(RESTARTED);
    expect(await inputName(page)).toBe("neutral walk");
    await expectGoesOn(before);
    await dropFile(page, "mine.bvh", neutral);
    await eventually(() => inputName(page)).toBe("mine");
    expect(await alert(), "what has worked is no longer said to have failed").toBe("");
  });

  it("while the motion is analysed: it is analysed again by itself", async () => {
    await dismissAll(page);
    await failNextCall(page, "analyse", "fails");
    await visit(page, "play=0&frame=40&input=mine&styles=old:1,proud:0,depressed:0");
    await faultMet(page, "analyse");
    await eventually(notes).toMatch(RESTARTED);
    await page.waitForFunction(() => window.strut.analysed);
    expect(await inputName(page)).toBe("mine");
  });

  it("while a file is saved: it says so, and saves it the next time", async () => {
    await dismissAll(page);
    await failNextCall(page, "exportBvh", "fails");
    await page.getByRole("button", { name: "Export" }).click();
    await page.locator(".export-menu").getByRole("button", { name: /^BVH/ }).click();
    await eventually(alert).toMatch(/The engine failed/);
    await page.waitForFunction(() => window.strut.analysed);
    expect((await saved(page, "BVH")).name).toMatch(/^mine.*\.bvh$/);
  });

  it("without a word: it is missed, and another takes its place", async () => {
    await dismissAll(page);
    const before = await settledPose(page);
    await hurryTimers(page);
    await failNextCall(page, "step", "vanishes");
    await page.keyboard.press("Space");
    await faultMet(page, "step");
    await eventually(notes).toMatch(/Your settings are kept. The engine failed: its worker does not answer/);
    await eventually(async () => turnBetween(before, await styledPose(page))).toBeGreaterThan(1);
    await page.keyboard.press("Space");
  });
});

describe("a worker of a view ends", () => {
  it.for([
    { view: "Key-style", method: "trainKeyStyle", root: ".key-style", again: "Train again" },
    { view: "Crowd", method: "tick", root: ".crowd", again: "Start again" },
  ])("$view: a sentence, and one click goes on", async ({ view, method, root, again }) => {
    await failNextCall(page, method, "fails");
    await page.getByRole("link", { name: view, exact: true }).click();
    await faultMet(page, method);
    const empty = page.locator(`${root} .editor-empty`);
    await eventually(() => empty.textContent()).toMatch(/ended for the test/);
    await empty.getByRole("button", { name: again }).click();
    await eventually(() => empty.isHidden()).toBe(true);
    await page.locator(`${root} canvas`).first().waitFor();
  });

  it("Compare: the columns are made by another one", async () => {
    await failNextCall(page, "stylize", "fails");
    await page.getByRole("link", { name: "Compare", exact: true }).click();
    await faultMet(page, "stylize");
    await page.locator('.compare-table[data-column="mar"]').getByText("cm/s").first().waitFor();
  });
});

describe("at the start", () => {
  /** Reloads the page in a state that needs the whole engine. */
  async function open(): Promise<void> {
    await page.goto("about:blank");
    await page.goto(`${site}#${STILL}`);
    await page.waitForFunction(() => window.strut !== undefined);
  }
  let site: string;
  beforeAll(() => {
    site = page.url().replace(/#.*/, "");
  });

  it("the engine's worker cannot be had: a sentence, and Reload brings the page with all that the link says", async () => {
    await page.route(/\/worker-[^/]*\.js$/, (route) => route.abort());
    await open();
    await eventually(alert).toMatch(/The engine could not be started. Reload the page/);
    await page.unroute(/\/worker-[^/]*\.js$/);
    await page.getByRole("alert").getByRole("button", { name: "Reload" }).click();
    await shown(page);
    expect(await page.evaluate(() => window.strut.state.styles[0])).toEqual({ name: "proud", weight: 1 });
  });

  it("WebAssembly is forbidden: a sentence that blames no file, and Reload", async () => {
    await page.route(/\/worker-[^/]*\.js$/, async (route) => {
      const response = await route.fetch();
      const headers = { ...response.headers(), "content-security-policy": "script-src 'self'" };
      await route.fulfill({ response, headers });
    });
    await open();
    await eventually(alert).toMatch(
      /The engine could not be started, because the browser blocked its code. Reload the page;/,
    );
    expect(await alert()).not.toContain("bug in Strut");
    await page.unroute(/\/worker-[^/]*\.js$/);
    await page.getByRole("alert").getByRole("button", { name: "Reload" }).click();
    await shown(page);
  });

  it("memory runs out with a large file: the one before stays, and a smaller one opens", async () => {
    // The module's whole address space is allocated when the file arrives; none of it is used.
    const spend = () => {
      const memories: WebAssembly.Memory[] = [];
      const Made = WebAssembly.Instance;
      WebAssembly.Instance = class extends Made {
        constructor(...given: ConstructorParameters<typeof Made>) {
          super(...given);
          memories.push(this.exports.memory as WebAssembly.Memory);
        }
      };
      addEventListener("message", ({ data }) => {
        if (data.method !== "openMotion") return;
        for (const memory of memories)
          for (let pages = 65_536; pages >= 1; pages = Math.floor(pages / 2))
            for (;;)
              try {
                memory.grow(pages);
              } catch {
                break;
              }
      });
    };
    await page.route(/\/worker-[^/]*\.js$/, async (route) => {
      const response = await route.fetch();
      await route.fulfill({ response, body: `(${spend})();${await response.text()}` });
    });
    await open();
    await shown(page);
    const before = await settledPose(page);
    await page.unroute(/\/worker-[^/]*\.js$/);
    const [head, lines] = neutral.split(/(?<=Frame Time:.*\n)/) as [string, string];
    await dropFile(page, "long.bvh", head.replace(/Frames: \d+/, "Frames: 60000") + lines.repeat(200));
    await eventually(alert).toMatch(/The engine ran out of memory/);
    await eventually(notes).toMatch(RESTARTED);
    expect(await inputName(page)).toBe("neutral walk");
    await expectGoesOn(before);
    await dropFile(page, "mine.bvh", neutral);
    await eventually(() => inputName(page)).toBe("mine");
  });
});
