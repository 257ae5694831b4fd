/**
 * Project files: the open state is saved and opened in another browser; invalid files change nothing; a reload keeps
 * files.
 */
import { readFileSync } from "node:fs";
import type { Page } from "playwright-core";
import { afterAll, beforeAll, beforeEach, describe, expect, it } from "vitest";
import { type Project, readProject, writeProject } from "../../web/app/project/project_file";
import type { StrutHook } from "../../web/app/shell/hook";
import { walksIn } from "../clips";
import { databaseOf } from "../database_of";
import { FAMILIES } from "../rigs/families";
import { makeRig } from "../rigs/rig";
import { zipOf } from "../zip";
import { axeFaults } from "./axe";
import {
  asksBeforeLeaving,
  closePage,
  dropFile,
  eventually,
  inputName,
  launchSite,
  openPage,
  screenshot,
  settledPose,
  shown,
  turnBetween,
} from "./browser";

declare const window: { strut: StrutHook };

let opened: Awaited<ReturnType<typeof launchSite>>;
let page: Page;
let walks: Record<"neutral" | "old", string>;
let database: Uint8Array;
const rig = makeRig(FAMILIES.find(({ name }) => name === "chibi")!).glb;

beforeAll(async () => {
  opened = await launchSite();
  walks = await walksIn(["neutral", "old"]);
  database = await databaseOf({ "walk_neutral_1.bvh": walks.neutral, "walk_old_1.bvh": walks.old });
});
afterAll(() => opened.close());

/** Opens a page in a new browser. */
const fresh = (hash = "", size = { width: 1440, height: 900 }) =>
  openPage(opened.browser, opened.site.url, { hash, size, notesStay: true });

const alert = () => page.getByRole("alert").textContent();
const said = () => page.getByRole("status").allTextContents();
const performer = async () => ((await page.locator(".cast").isVisible()) ? page.locator(".cast-name").innerText() : "");
const state = () => page.evaluate(() => ({ ...window.strut.state }));
/** Returns the names of the open database's styles. */
const styles = () =>
  page.locator(".vertex").evaluateAll((corners) => corners.map((corner) => corner.getAttribute("data-style")).sort());

/** Saves the project with the keyboard. */
async function savedProject(name = "mine"): Promise<Uint8Array> {
  await page.keyboard.press("Control+s");
  await page.getByLabel("Name", { exact: true }).fill(name);
  const [download] = await Promise.all([page.waitForEvent("download"), page.keyboard.press("Enter")]);
  expect(download.suggestedFilename()).toBe(`${name}.strut`);
  return readFileSync(await download.path());
}

/** Creates a typical state: a user's clip, database and character, style keys, a paused frame. */
async function work(): Promise<void> {
  await dropFile(page, "own.strutdb", database);
  await eventually(said).toContainEqual(expect.stringContaining("2 styles ready"));
  await dropFile(page, "clip.bvh", walks.old);
  await eventually(() => inputName(page)).toBe("clip");
  await dropFile(page, "chibi.glb", rig);
  await eventually(performer).toBe("chibi");
  await page.getByRole("button", { name: "Pause" }).click();
  await page.keyboard.press("Home");
  await page.keyboard.press("k");
  for (let i = 0; i < 40; i++) await page.keyboard.press("ArrowRight");
  await page.keyboard.press("k");
  await page.keyboard.press("1");
  await eventually(async () => (await state()).track.length).toBe(2);
  for (let i = 0; i < 10; i++) await page.keyboard.press("ArrowLeft");
  await page.getByRole("radio", { name: "Side" }).check();
}

describe("a project", () => {
  it("opens to the same pose and picture in another browser, and can be left again", async () => {
    page = await fresh();
    await work();
    const pose = await settledPose(page);
    const before = await state();
    await screenshot(page, "project-before");
    const file = await savedProject();
    expect(await alert()).toBe("");
    await closePage(page);

    page = await fresh("play=0&frame=60&styles=proud:1");
    const elsewhere = await settledPose(page);
    await dropFile(page, "mine.strut", file);
    await eventually(said).toContainEqual(expect.stringContaining("Opened “mine.strut”"));
    await eventually(() => inputName(page)).toBe("clip");
    await eventually(performer).toBe("chibi");
    expect(await styles()).toEqual(["neutral", "old"]);
    const after = await state();
    expect(after).toEqual({ ...before, database: "own" });
    expect(after.track.length).toBe(2);
    expect(await settledPose(page), "the same pose, to the bit").toEqual(pose);
    expect(await alert()).toBe("");
    expect(await axeFaults(page)).toEqual([]);
    await screenshot(page, "project-after");

    // Undo restores database, input and styles; redo applies the project again.
    await page.keyboard.press("Control+z");
    await eventually(() => inputName(page)).toBe("neutral walk");
    await eventually(async () => (await styles()).length).toBe(8);
    await page.keyboard.press("Control+Shift+z");
    await eventually(() => inputName(page)).toBe("clip");
    await eventually(styles).toEqual(["neutral", "old"]);

    // The offer disappears with the first change; after a reload, it restores everything.
    await page.reload();
    await shown(page);
    await eventually(performer, "a reload keeps it").toBe("chibi");
    expect(await styles()).toEqual(["neutral", "old"]);
    await closePage(page);
    page = await fresh("play=0&frame=60&styles=proud:1");
    await dropFile(page, "mine.strut", file);
    await eventually(performer).toBe("chibi");
    await page.getByRole("button", { name: "Go back" }).click();
    await eventually(performer).toBe("");
    await eventually(() => inputName(page)).toBe("neutral walk");
    await eventually(async () => (await styles()).length).toBe(8);
    expect(turnBetween(elsewhere, await settledPose(page))).toBeLessThan(0.1);
    await closePage(page);
  });

  it("leaves the character out where that is wished, and asks for it", async () => {
    page = await fresh();
    await dropFile(page, "chibi.glb", rig);
    await eventually(performer).toBe("chibi");
    await page.keyboard.press("Control+s");
    const dialog = page.locator("dialog[open]");
    expect(await dialog.textContent()).toContain("Character “chibi.glb”");
    await dialog.getByLabel("Include the character").uncheck();
    expect(await axeFaults(page)).toEqual([]);
    await screenshot(page, "project-save");
    const save = dialog.getByRole("button", { name: "Save", exact: true });
    const [download] = await Promise.all([page.waitForEvent("download"), save.click()]);
    const file = readFileSync(await download.path());
    expect((await readProject(new Blob([file]))).character).toMatchObject({ name: "chibi.glb", size: rig.length });
    // The performing character is recognised.
    await dropFile(page, "again.strut", file);
    await eventually(said).toContainEqual(expect.stringContaining("Opened “again.strut”"));
    expect(await performer()).toBe("chibi");
    await closePage(page);
    page = await fresh();
    await dropFile(page, "again.strut", file);
    await eventually(said).toContainEqual(
      expect.stringContaining("“chibi.glb”, which is not in its file. Drop the character here."),
    );
    expect(await performer()).toBe("");
    await closePage(page);
  });

  it("is opened with the button and by keys, in any view, on a phone", async () => {
    page = await fresh("view=data", { width: 390, height: 844 });
    const file = await writeProject({
      state: "play=0&frame=20&styles=old:1&input=clip",
      inputs: [{ name: "clip", file: new Blob([walks.old]) }],
    });
    const payload = { name: "phone.strut", mimeType: "", buffer: Buffer.from(await file.arrayBuffer()) };
    await page.getByRole("button", { name: "Menu" }).click();
    const [chooser] = await Promise.all([
      page.waitForEvent("filechooser"),
      page.locator("#menu").getByRole("button", { name: "Open…" }).click(),
    ]);
    await chooser.setFiles(payload);
    await eventually(async () => [(await state()).view, (await state()).input]).toEqual(["play", "clip"]);
    await eventually(async () => (await said()).join()).toContain("Opened “phone.strut”");
    await page.getByRole("button", { name: "Dismiss" }).last().click();
    // The browser's own dialog with the same element was tested above.
    const input = page.locator(".drop-overlay input[multiple]");
    await input.evaluate((element) =>
      element.addEventListener("click", (event) => {
        event.preventDefault();
        element.dataset.asked = "yes";
      }),
    );
    await page.keyboard.press("Control+o");
    await eventually(() => input.getAttribute("data-asked")).toBe("yes");
    await closePage(page);
  });
});

describe("a file that is no project of this page", () => {
  it("gets a sentence and changes nothing", async () => {
    page = await fresh("play=0&frame=60&styles=proud:1");
    const pose = await settledPose(page);
    const before = await state();
    const file = new Blob([walks.old]);
    const project: Project = { state: "play=1&view=crowd&styles=old:1", inputs: [{ name: "clip", file }] };
    const packed = async (changes: Partial<Project>) =>
      new Uint8Array(await (await writeProject({ ...project, ...changes })).arrayBuffer());
    const good = await packed({});
    const manifest = (value: object) => zipOf([{ name: "project.json", content: JSON.stringify(value) }]);
    const text = (content: string) => new Blob([content]);
    const garbage = { name: "bot.glb", size: 4, sha256: "0".repeat(64) };
    const files: [what: string, content: string | Uint8Array, sentence: RegExp][] = [
      ["empty", "", /not a Strut project/],
      ["text", "Dear Sir or Madam", /not a Strut project/],
      ["cut off", good.subarray(0, good.length - 200), /not a Strut project/],
      ["damaged", good.map((byte, i) => (i === 900 ? byte ^ 255 : byte)), /It is damaged/],
      ["newer", manifest({ format: "strut-project", version: 2 }), /A newer version of Strut saved it/],
      ["older", manifest({ format: "strut-project", version: 0 }), /is too old for this page/],
      ["no motion", await packed({ inputs: [{ name: "clip", file: text("no") }] }), /motion “clip” in it/],
      ["no database", await packed({ database: { name: "bad", file: text("no") } }), /database “bad” in it/],
      ["no character", await packed({ character: { ...garbage, file: text("no") } }), /character “bot.glb” in it/],
    ];
    for (const [what, content, sentence] of files) {
      await dropFile(page, `${what}.strut`, content);
      await eventually(alert, what).toMatch(sentence);
      expect(await alert(), what).toMatch(new RegExp(`^“${what}.strut” was not opened\\. .*\\.`));
      await page.getByRole("alert").getByRole("button", { name: "Dismiss" }).click();
      expect(await state(), what).toEqual(before);
      expect(await settledPose(page), what).toEqual(pose);
      expect(await page.getByLabel("Input motion").locator("option", { hasText: "clip" }).count(), what).toBe(0);
    }
    // An unusable state is replaced by the initial one.
    const odd = await packed({
      state: "play=0&styles=%00:x&k=1e9&view=nowhere&frame=-5&db=gone&track=~~;;&input=../../x",
    });
    await dropFile(page, "odd.strut", odd);
    await eventually(said).toContainEqual(expect.stringContaining("Opened “odd.strut”"));
    await eventually(async () => (await state()).database).toBe("");
    expect((await settledPose(page)).every(Number.isFinite)).toBe(true);
    await closePage(page);
  });
});

describe("a dropped file", () => {
  beforeEach(async () => {
    page = await fresh("play=0&frame=20&styles=old:1,neutral:0");
  });

  it("is there after a reload, with what was said of it, and not in another tab", async () => {
    await dropFile(page, "clip.bvh", walks.old);
    await eventually(() => inputName(page)).toBe("clip");
    await dropFile(page, "other.bvh", walks.neutral);
    await eventually(() => inputName(page)).toBe("other");
    await dropFile(page, "own.strutdb", database);
    await eventually(said).toContainEqual(expect.stringContaining("2 styles ready"));
    const pose = await settledPose(page);
    await page.getByRole("button", { name: "Project" }).click();
    await eventually(() => page.locator(".project-kept").textContent()).toContain("3 dropped files");
    await page.waitForTimeout(500);
    await page.reload();
    await shown(page);
    await eventually(() => inputName(page)).toBe("other");
    expect(await styles()).toEqual(["neutral", "old"]);
    expect(turnBetween(pose, await settledPose(page))).toBeLessThan(0.1);
    await page.getByLabel("Input motion").selectOption("clip");
    await eventually(() => inputName(page)).toBe("clip");
    const tab = await page.context().newPage();
    await tab.goto(opened.site.url);
    await shown(tab);
    expect(await tab.getByLabel("Input motion").locator("option", { hasText: "clip" }).count()).toBe(0);
    await closePage(page);
  });

  it("is asked about before the page is left only where the browser does not keep it", async () => {
    await dropFile(page, "clip.bvh", walks.old);
    await eventually(() => inputName(page)).toBe("clip");
    await eventually(() => asksBeforeLeaving(page)).toBe(false);
    await page.evaluate(() => {
      IDBFactory.prototype.open = () => {
        throw new DOMException("refused", "SecurityError");
      };
    });
    await dropFile(page, "other.bvh", walks.neutral);
    await eventually(said).toContainEqual(expect.stringContaining("will not be here after a reload"));
    expect(await asksBeforeLeaving(page)).toBe(true);
    await closePage(page);
  });

  it("is forgotten where a person says so, and comes back with undo", async () => {
    await dropFile(page, "clip.bvh", walks.old);
    await eventually(() => inputName(page)).toBe("clip");
    await page.getByRole("button", { name: "Project" }).click();
    await eventually(() => page.locator(".project-kept").isVisible()).toBe(true);
    expect(await axeFaults(page)).toEqual([]);
    await page.locator(".project-kept").getByRole("button", { name: "Forget" }).click();
    await eventually(() => inputName(page)).toBe("neutral walk");
    const options = () => page.getByLabel("Input motion").locator("option", { hasText: "clip" }).count();
    await eventually(options).toBe(0);
    await page.locator(".toast").getByRole("button", { name: "Undo" }).click();
    await eventually(() => inputName(page)).toBe("clip");
    await page.getByRole("button", { name: "Project" }).click();
    await page.locator(".project-kept").getByRole("button", { name: "Forget" }).click();
    await eventually(options).toBe(0);
    await eventually(() => page.evaluate(() => sessionStorage.getItem("strut session"))).toBe(null);
    await page.reload();
    await shown(page);
    expect(await inputName(page)).toBe("neutral walk");
    expect(await options()).toBe(0);
    await closePage(page);
  });

  it("that is too large for a link leads to a project", async () => {
    await dropFile(page, "clip.bvh", walks.old.repeat(1));
    await eventually(() => inputName(page)).toBe("clip");
    await page.getByRole("button", { name: "Share" }).click();
    await eventually(said).toContainEqual(expect.stringContaining("too large for a link"));
    await page.getByRole("button", { name: "Save project…" }).last().click();
    await eventually(() => page.locator("dialog[open] h2").textContent()).toBe("Save project");
    await page.keyboard.press("Escape");
    await closePage(page);
  });
});
