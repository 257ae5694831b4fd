/** Several motions that are dropped at once: the question about their use, and the batch that styles all of them. */
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import type { StrutHook } from "../../web/app/shell/hook";
import { Archive, readDirectory, readEntry } from "../../web/client/build/zip";
import { walksIn } from "../clips";
import { databaseOf } from "../database_of";
import { COMMAND } from "../programs";
import { zipOf } from "../zip";
import { axeFaults } from "./axe";
import {
  closePage,
  dropFile,
  dropFiles,
  eventually,
  inputName,
  openPage,
  openSite,
  screenshot,
  visit,
} from "./browser";

declare const window: { strut: StrutHook };

let opened: Awaited<ReturnType<typeof openSite>>;
let page: Page;
let walks: Record<"neutral" | "old" | "proud", string>;
let database: Uint8Array;
const folder = mkdtempSync(join(tmpdir(), "strut-batch-"));

beforeAll(async () => {
  opened = await openSite({ hash: "play=0&frame=10", notesStay: true });
  page = opened.page;
  walks = await walksIn(["neutral", "old", "proud"]);
  database = await databaseOf({ "walk_neutral_1.bvh": walks.neutral, "walk_old_1.bvh": walks.old });
});
afterAll(async () => {
  rmSync(folder, { recursive: true });
  await opened.close();
});

const CUT_OFF = "HIERARCHY\nROOT Hips\n{\n  OFFSET 0 0 0\n";
const card = () => page.locator(".batch-card");
const heading = () => card().locator("h2").textContent();
const choose = (name: string) => page.locator("dialog[open]").getByRole("button", { name, exact: false }).click();
const view = () => page.evaluate(() => window.strut.state.view);

/** Requests a zip in single styles. */
async function restyle(files: Record<string, string>, styles: readonly string[]): Promise<void> {
  await dropFiles(page, files);
  await choose("Restyle all");
  const dialog = page.locator("dialog.restyle");
  await dialog.getByLabel("Each of these styles alone").check();
  for (const box of await dialog.getByRole("checkbox").all()) {
    const name = (await box.evaluate((element) => element.parentElement!.textContent)) ?? "";
    await box.setChecked(styles.includes(name));
  }
  await dialog.getByRole("button", { name: "Restyle", exact: true }).click();
  await card().waitFor();
}

/** Saves the zip of the card, and returns its contents. */
async function savedZip(): Promise<Record<string, Buffer>> {
  const save = card().getByRole("button", { name: /^Save/ });
  const [download] = await Promise.all([page.waitForEvent("download"), save.click()]);
  expect(download.suggestedFilename()).toMatch(/^restyled-.*\.zip$/);
  const archive = new Archive(new Blob([readFileSync(await download.path())]));
  const files: Record<string, Buffer> = {};
  for (const entry of await readDirectory(archive))
    files[entry.name] = Buffer.from(await readEntry(archive, entry, 1 << 26));
  return files;
}

/** Returns the command's output for a clip with the same database, or undefined if the command was not built. */
function byCommand(text: string, style: string): Buffer | undefined {
  if (!existsSync(COMMAND)) {
    console.warn(`skipping the comparison with the command: ${COMMAND} is missing`);
    return undefined;
  }
  const [db, input, output] = ["own.strutdb", "in.bvh", "out.bvh"].map((name) => join(folder, name));
  writeFileSync(db!, database);
  writeFileSync(input!, text);
  execFileSync(COMMAND, ["stylize", "--db", db!, "--input", input!, "--style", style, "-o", output!], {
    stdio: "pipe",
  });
  return readFileSync(output!);
}

describe("several motions that are dropped", () => {
  it("are asked what they are for, and become inputs", async () => {
    await dropFiles(page, { "one.bvh": walks.neutral, "two.bvh": walks.old });
    await eventually(() => page.locator("dialog[open] h2").textContent()).toBe("2 motions");
    expect(await axeFaults(page)).toEqual([]);
    await page.keyboard.press("Escape");
    expect(await inputName(page), "nothing is chosen, nothing changes").toBe("neutral walk");
    await dropFiles(page, { "one.bvh": walks.neutral, "two.bvh": walks.old });
    await page.keyboard.press("Enter");
    await eventually(() => inputName(page)).toBe("one");
    await page.getByLabel("Input motion").selectOption("two");
    await eventually(() => inputName(page)).toBe("two");
    expect(await view()).toBe("play");
    await eventually(() => page.evaluate(() => window.strut.state.input)).toBe("two");
    await page.keyboard.press("Control+z");
    await eventually(() => inputName(page)).toBe("one");
  });

  it("are undone one at a time, also while one is still being opened", async () => {
    await page.getByLabel("Input motion").evaluate((select: HTMLSelectElement) => {
      select.value = "two";
      select.dispatchEvent(new Event("change"));
      document.body.dispatchEvent(new KeyboardEvent("keydown", { key: "z", ctrlKey: true, bubbles: true }));
    });
    await eventually(() => inputName(page)).toBe("one");
    expect(await page.evaluate(() => window.strut.state.input)).toBe("one");
  });

  it("become a database where they are to be one, and where a table of labels says so", async () => {
    await dropFile(
      page,
      "walks.zip",
      zipOf([
        { name: "walk_old_1.bvh", content: walks.old },
        { name: "walk_neutral_1.bvh", content: walks.neutral },
      ]),
    );
    await choose("Make a database");
    await eventually(view).toBe("data");
    await eventually(() => page.locator(".data h1, .data h2").first().isVisible()).toBe(true);
    await eventually(() => page.locator(".data").textContent()).toContain("2 clips, 2 styles");
    await visit(page, "play=0&frame=10");
    await eventually(view).toBe("play");
    await dropFiles(page, { "a.bvh": walks.old, "labels.csv": "file,action,style\na.bvh,walk,old\n" });
    await eventually(view).toBe("data");
    await visit(page, "play=0&frame=10");
  });
});

describe("a batch", () => {
  it("makes the bytes of the command, names a clip that cannot be used and does the others", async () => {
    await dropFile(page, "own.strutdb", database);
    await eventually(() => page.getByRole("status").allTextContents()).toContainEqual(
      expect.stringContaining("2 styles ready"),
    );
    await restyle({ "a.bvh": walks.proud, "cut_off.bvh": CUT_OFF, "b.bvh": walks.neutral }, ["old", "neutral"]);
    await eventually(heading).toBe("4 files are done");
    await card().locator("summary").click();
    expect(await card().locator("li").allTextContents()).toEqual([expect.stringMatching(/^“cut_off.bvh”: .*\.$/)]);
    expect(await axeFaults(page)).toEqual([]);
    await screenshot(page, "batch-done");
    const { "report.csv": report, ...files } = await savedZip();
    expect(Object.keys(files).sort()).toEqual(["neutral/a.bvh", "neutral/b.bvh", "old/a.bvh", "old/b.bvh"]);
    expect(report!.toString()).toContain("old/cut_off.bvh,cut_off.bvh,old,left out,");
    for (const style of ["old", "neutral"]) {
      const expected = byCommand(walks.proud, style);
      if (expected) expect(Buffer.compare(files[`${style}/a.bvh`]!, expected), style).toBe(0);
    }
    await card().getByRole("button", { name: "Close" }).click();
    expect(await card().count()).toBe(0);
  });

  it("loses nothing that is done when it is stopped, and goes on from there", async () => {
    const files = Object.fromEntries(["a", "b", "c", "d"].map((name) => [`${name}.bvh`, walks.proud]));
    // Clicked by the page itself: eight short files may be done before a click from outside arrives.
    await page.evaluate(() => {
      const observer = new MutationObserver(() => {
        const card = document.querySelector(".batch-card");
        if (!/[1-7] of 8 files/.test(card?.textContent ?? "")) return;
        observer.disconnect();
        card!.querySelector<HTMLButtonElement>("button[title=Cancel]")!.click();
      });
      observer.observe(document.body, { subtree: true, childList: true, characterData: true });
    });
    await restyle(files, ["old", "neutral"]);
    await eventually(heading).toMatch(/^Stopped: [1-7] of 8 files$/);
    const done = Number(/\d/.exec((await heading())!)![0]);
    expect(Object.keys(await savedZip())).toHaveLength(done + 1);
    await card().getByRole("button", { name: "Continue" }).click();
    await eventually(heading).toBe("8 files are done");
    // Another batch waits until this one is saved.
    await dropFiles(page, { "a.bvh": walks.old, "b.bvh": walks.old });
    await choose("Restyle all");
    await eventually(() => page.getByRole("alert").textContent()).toContain("Another batch is not finished");
    await page.getByRole("alert").getByRole("button", { name: "Dismiss" }).click();
    await card().getByRole("button", { name: "Close" }).click();
    await page.getByRole("button", { name: "Undo" }).last().click();
    const { "report.csv": _, ...made } = await savedZip();
    expect(Object.keys(made)).toHaveLength(8);
    for (const name of ["a", "b", "c", "d"])
      expect(Buffer.compare(made[`old/${name}.bvh`]!, made["old/a.bvh"]!), name).toBe(0);
  });

  it("has the styles of Play, and a card that leaves the picture in sight on a phone", async () => {
    const phone = await openPage(opened.browser, opened.site.url, {
      hash: "play=0&styles=proud:0.5,old:0.25,neutral:0.25",
      size: { width: 390, height: 844 },
    });
    page = phone;
    await dropFiles(page, { "a.bvh": walks.old, "b.bvh": walks.neutral });
    await choose("Restyle all");
    await page.locator("dialog.restyle").getByRole("button", { name: "Restyle", exact: true }).click();
    await eventually(heading).toBe("2 files are done");
    const stage = (await page.locator(".stage").first().boundingBox())!;
    expect((await card().boundingBox())!.y).toBeGreaterThan(stage.y + stage.height);
    const files = await savedZip();
    expect(Object.keys(files).sort()).toEqual(["proud=0.5+old=0.25/a.bvh", "proud=0.5+old=0.25/b.bvh", "report.csv"]);
    await closePage(phone);
    page = opened.page;
  });
});
