/** Faults while databases are built or models are trained: clips and settings are kept. */
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Page } from "playwright-core";
import { afterEach, beforeAll, beforeEach, describe, expect, it } from "vitest";
import type { StrutHook } from "../../../web/app/shell/hook";
import { walksIn } from "../../clips";
import { eventually, openSite, styledPose, turnBetween, visit } from "../browser";
import { consoleErrors, dismissAll, failNextCall, faultMet, keptNames } from "./inject";

declare const window: { strut: StrutHook };

let page: Page;
let errors: string[];
let folder: string;
let walks: Record<"neutral" | "old" | "proud", string>;

beforeAll(async () => {
  folder = mkdtempSync(join(tmpdir(), "strut-faults-"));
  const [opened, made] = await Promise.all([
    openSite({ hash: "view=data&play=0", notesStay: true }),
    walksIn(["neutral", "old", "proud"]),
  ]);
  [page, walks] = [opened.page, made];
  errors = consoleErrors(page);
  return async () => {
    rmSync(folder, { recursive: true });
    await opened.close();
  };
});
beforeEach(() => dismissAll(page));
afterEach(() => expect(errors.splice(0)).toEqual([]));

const alert = () => page.getByRole("alert").textContent();
const notes = () => page.locator(".toasts [role=status]").textContent();
const heading = () => page.locator(".data-clips h1").textContent();
const buildButton = () => page.getByRole("button", { name: "Build the database" });
const goTo = (name: string) => page.getByRole("link", { name, exact: true }).click();
const isRead = () => page.locator('.data[aria-busy="false"]').waitFor();

/** Chooses files of the tests' folder as the first clips. */
async function choose(...paths: string[]): Promise<void> {
  const clear = page.getByRole("button", { name: "Clear", exact: true });
  if (await clear.isVisible()) await clear.click();
  await page.locator("input[type=file][multiple]").last().setInputFiles(paths);
}

/** Writes clips into the tests' folder: `walk_old_1.bvh` is a walk in the style “old”. */
function written(...names: string[]): string[] {
  return names.map((name) => {
    const path = join(folder, name);
    writeFileSync(path, walks[name.split("_")[1] as keyof typeof walks]);
    return path;
  });
}

const two = () => written("walk_neutral_1.bvh", "walk_old_1.bvh");

describe("the worker that builds ends", () => {
  it("while it looks for clips: a sentence, and the files are taken when they are dropped again", async () => {
    await failNextCall(page, "open", "fails");
    await choose(...two());
    await faultMet(page, "open");
    await eventually(alert).toMatch(/could not be started: ended for the test. Reload the page/);
    await dismissAll(page);
    await choose(...two());
    await eventually(heading).toBe("2 clips, 2 styles");
    await isRead();
  });

  it("while clips are read: they stay, and are built", async () => {
    await failNextCall(page, "readAll", "fails");
    await choose(...two());
    await faultMet(page, "readAll");
    await eventually(alert).toMatch(/The database builder failed: ended for the test/);
    await isRead();
    expect(await heading()).toBe("2 clips, 2 styles");
  });

  it("while it builds: the clips stay, and the same click builds again", async () => {
    await page.getByLabel("Name of the database").fill("mine");
    await failNextCall(page, "build", "fails");
    await buildButton().click();
    await faultMet(page, "build");
    await eventually(alert).toMatch(/ended for the test/);
    expect(await heading()).toBe("2 clips, 2 styles");
    await dismissAll(page);
    await buildButton().click();
    await eventually(notes).toMatch(/Two styles ready/);
    await eventually(() => keptNames(page)).toEqual(["mine"]);
  });
});

describe("a build that is cancelled", () => {
  /** Blocks a call, so that it can be cancelled however fast the machine is. */
  async function cancelled(method: string, root: string, act: () => Promise<unknown>): Promise<void> {
    await failNextCall(page, method, "never hears");
    await act();
    await faultMet(page, method);
    await page.locator(`${root} .progress`).getByRole("button", { name: "Cancel" }).click();
  }

  it("while files are looked for: nothing is left, and they are taken when they are chosen again", async () => {
    await cancelled("open", ".data-clips", () => choose(...two()));
    await isRead();
    expect(await alert()).toBe("");
    await choose(...two());
    await eventually(heading).toBe("2 clips, 2 styles");
    await isRead();
  });

  it("while clips are read: they stay in the list", async () => {
    await cancelled("readAll", ".data-clips", () => choose(...two()));
    await isRead();
    expect(await heading()).toBe("2 clips, 2 styles");
    expect(await alert()).toBe("");
  });

  it("while it is built: nothing is kept, and it can be built at once", async () => {
    await page.getByLabel("Name of the database").fill("other");
    await cancelled("build", ".build", () => buildButton().click());
    await eventually(() => buildButton().isEnabled()).toBe(true);
    expect(await keptNames(page)).toEqual(["mine"]);
    expect(await alert()).toBe("");
    await buildButton().click();
    await eventually(notes).toMatch(/Two styles ready/);
    await eventually(() => keptNames(page)).toEqual(["mine", "other"]);
  });
});

describe("a file that was changed on the disk", () => {
  it("after it was read: it is left out with a sentence, the others are built, and it is taken again", async () => {
    const paths = written("walk_neutral_1.bvh", "walk_old_1.bvh", "walk_proud_1.bvh");
    await choose(...paths);
    await eventually(heading).toBe("3 clips, 3 styles");
    await isRead();
    // A file is identified by its time and its size.
    writeFileSync(paths[2]!, `${walks.proud}\n`);
    await page.getByLabel("Name of the database").fill("changed");
    await buildButton().click();
    await eventually(notes).toMatch(/Two styles ready.* 1 clip left out/);
    await page.getByRole("button", { name: "1 left out" }).click();
    await eventually(() => page.locator(".clip-note").allTextContents()).toEqual([
      "It could not be read. Drop it again.",
    ]);
    await page.locator("input[type=file][multiple]").last().setInputFiles([paths[2]!]);
    await eventually(heading).toBe("3 clips, 3 styles");
    await isRead();
  });
});

describe("a style that is renamed while it plays", () => {
  it("is shown under its new name when the database was built again, and the character walks on", async () => {
    await choose(...two());
    await isRead();
    await page.getByLabel("Name of the database").fill("renamed");
    await buildButton().click();
    await eventually(() => keptNames(page)).toContain("renamed");
    await page.getByRole("button", { name: "Open renamed" }).click();
    await eventually(() => page.evaluate(() => window.strut.state.database)).toBe("renamed");
    await visit(page, "db=renamed&play=1&styles=old:1,neutral:0");
    await goTo("Data");
    await page.getByLabel("Name of the style old").fill("ancient");
    await page.getByLabel("Name of the style old").press("Enter");
    await page.getByLabel("Name of the database").fill("renamed");
    await buildButton().click();
    await page.getByRole("button", { name: "Replace it" }).click();
    await eventually(notes).toMatch(/Two styles ready/);
    await goTo("Play");
    const vertices = () =>
      page.locator(".panels .vertex").evaluateAll((all) => all.map((one) => one.getAttribute("data-style")).sort());
    await eventually(vertices).toEqual(["ancient", "neutral"]);
    const names = () => page.evaluate(() => window.strut.state.styles.map(({ name }) => name).sort());
    await eventually(names).toEqual(["ancient", "neutral"]);
    expect(await page.evaluate(() => window.strut.state.styles.find((s) => s.name === "ancient")?.weight)).toBe(1);
    const before = await styledPose(page);
    await eventually(async () => turnBetween(before, await styledPose(page))).toBeGreaterThan(1);
    expect(await alert()).toBe("");
  });
});

describe("a view that is left while its model is trained", () => {
  it.for([
    { view: "Walk", method: "trainWalk", root: ".walk" },
    { view: "Key-style", method: "trainKeyStyle", root: ".key-style" },
    { view: "Crowd", method: "trainWalk", root: ".crowd" },
  ])("$view: it is trained when the view is shown again", async ({ view, method, root }) => {
    await visit(page, `play=0&db=renamed`);
    await failNextCall(page, method, "never hears");
    await goTo(view);
    await faultMet(page, method);
    await goTo("Play");
    await goTo(view);
    await page.locator(`${root} canvas`).first().waitFor();
    await eventually(() => page.locator(`${root} .progress`).first().isHidden()).toBe(true);
    await eventually(() => page.locator(`${root} .editor-empty`).isHidden()).toBe(true);
    await goTo("Play");
    expect(await alert()).toBe("");
  });
});

describe("a worker that ends while it trains on a database", () => {
  it("Walk: a sentence, and one click goes on", async () => {
    // The database is opened anew: a model is known for the one that was open.
    await visit(page, "play=0");
    await eventually(() => page.evaluate(() => window.strut.analysed)).toBe(true);
    await visit(page, "play=0&db=renamed");
    await eventually(() => page.evaluate(() => window.strut.analysed)).toBe(true);
    await failNextCall(page, "trainWalk", "fails");
    await goTo("Walk");
    await faultMet(page, "trainWalk");
    const empty = page.locator(".walk .editor-empty");
    await eventually(() => empty.textContent()).toMatch(/ended for the test/);
    await empty.getByRole("button", { name: "Train again" }).click();
    await eventually(() => empty.isHidden()).toBe(true);
    await page.locator(".walk canvas").first().waitFor();
    await goTo("Play");
  });
});
