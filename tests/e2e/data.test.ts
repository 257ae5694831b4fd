/** Users' own data: clips are dropped, labelled, built, stored, opened and used for styling, in the page. */
import { mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, it } from "vitest";
import type { StrutHook } from "../../web/app/shell/hook";
import { everyNth, playedAt, walksIn } from "../clips";
import { recordings } from "../recordings";
import { zipOf } from "../zip";
import { axeFaults } from "./axe";
import {
  asksBeforeLeaving,
  closePage,
  dropFile,
  eventually,
  launchBrowser,
  openPage,
  screenshot,
  serveSite,
  shown,
} from "./browser";
import { showTheme, transitionsEnded } from "./rest";

declare const window: { strut: StrutHook };

let browser: Browser;
let site: Awaited<ReturnType<typeof serveSite>>;
let page: Page;
let folder: string;
let walks: Record<"neutral" | "old" | "proud", string>;

beforeAll(async () => {
  folder = mkdtempSync(join(tmpdir(), "strut-data-"));
  [browser, site, walks] = await Promise.all([launchBrowser(), serveSite(), walksIn(["neutral", "old", "proud"])]);
});
afterAll(async () => {
  rmSync(folder, { recursive: true, force: true });
  await browser.close();
  await site.close();
});
beforeEach(async () => {
  page = await openPage(browser, site.url, { hash: "view=data", size: { width: 1440, height: 900 } });
  await page.getByRole("heading", { name: "Your own styles" }).waitFor();
});
afterEach(() => closePage(page));

/** Writes a file into the tests' folder and returns its path. */
function written(name: string, content: string | Uint8Array): string {
  const path = join(folder, name);
  writeFileSync(path, content);
  return path;
}

const choose = (...paths: string[]) => page.locator("input[type=file][multiple]").last().setInputFiles(paths);
/** Waits until all clips have been read. */
const read = () => page.locator('.data[aria-busy="false"]').waitFor();
const heading = () => page.locator(".data-clips h1").textContent();
const alert = () => page.getByRole("alert").textContent();
const buildButton = () => page.getByRole("button", { name: "Build the database" });
/** Returns the names of the databases that can be opened. */
const databases = () =>
  page
    .locator("section")
    .filter({ has: page.getByRole("heading", { name: "Databases", exact: true }) })
    .getByRole("listitem")
    .filter({ has: page.getByRole("button", { name: /^Open/ }) })
    .locator("bdi")
    .allTextContents();

/**
 * Returns the name of the open database on this device, as in the link. It changes after the polygon, when the input is
 * open, too.
 */
const openDatabase = () => page.evaluate(() => window.strut.state.database);

/** Returns the page's messages about a built database. */
const saidReady = () => page.getByRole("status").filter({ hasText: "ready" });

/** Builds, and returns the page's message. */
async function build(): Promise<string> {
  // The message about the previous build stays until it is dismissed.
  await dismissNotes();
  await buildButton().click();
  await eventually(() => saidReady().count()).toBe(1);
  return (await saidReady().locator(".toast p").last().textContent())!;
}

/** Removes messages, so that the next one can be awaited. */
const dismissNotes = () =>
  page.locator('[role="status"] .toast').evaluateAll((notes) => {
    for (const note of notes) note.querySelector<HTMLButtonElement>("button:last-child")!.click();
  });

const faults = () => axeFaults(page);

/** Returns a small set of three styles. */
function smallSet() {
  return zipOf([
    { name: "walk_neutral_1.bvh", content: walks.neutral },
    { name: "walk_neutral_2.bvh", content: playedAt(walks.neutral, 66) },
    { name: "walk_old_1.bvh", content: walks.old },
    { name: "walk_old_2.bvh", content: everyNth(walks.old, 2) },
    { name: "walk_proud_1.bvh", content: walks.proud },
  ]);
}

describe("a zip of clips", () => {
  it("becomes a database that is kept, opened, exported and deleted", async () => {
    await choose(written("small.zip", smallSet()));
    await read();
    expect(await heading()).toBe("5 clips, 3 styles");
    expect(await page.getByLabel("Pattern of the file names").inputValue()).toBe("{action}_{style}_{take}.bvh");
    expect(await page.getByRole("radio", { name: "neutral is neutral" }).isChecked()).toBe(true);
    expect(await build()).toMatch(/^Three styles ready\. [\d\s]+ frames, [\d.]+ s\. It is now open\.$/);
    await eventually(databases).toEqual(["Built-in", "small"]);
    // It is opened immediately; a user who continues with the clips stays in the view.
    await eventually(openDatabase).toBe("small");
    expect(await page.evaluate(() => window.strut.state.view)).toBe("data");
    await page.getByRole("button", { name: "Play with it" }).click();
    await eventually(() => page.locator(".stage-heading .caption").textContent()).toMatch(/ styles of small · /);
    const inputs = page.getByLabel("Input motion");
    const clips = inputs.locator('optgroup[label="Clips of small"] option');
    await eventually(() => clips.count()).toBeGreaterThan(0);
    const name = (await clips.first().textContent())!;
    await inputs.selectOption({ label: name });
    await eventually(() => inputs.inputValue()).toMatch(/^[^:]*neutral[^:]*$/);
    await screenshot(page, "data-clip-as-input");
    // No input was chosen: the comparison uses a clip of the database, not a computed one.
    await page.evaluate(() => {
      location.hash = "db=small&view=compare";
    });
    await eventually(() => page.locator(".compare-choice select").first().inputValue()).toMatch(/walk.*neutral/);
    await page.getByRole("link", { name: "Data" }).click();

    const [download] = await Promise.all([
      page.waitForEvent("download"),
      page.getByRole("button", { name: "Export small" }).click(),
    ]);
    expect(download.suggestedFilename()).toBe("small.strutdb");
    expect(
      readFileSync(await download.path())
        .subarray(8, 9)
        .toString(),
    ).toBe("{");

    await page.getByRole("button", { name: "Open small" }).click();
    await eventually(openDatabase).toBe("small");
    const vertices = () =>
      page.locator(".vertex").evaluateAll((v) => v.map((e) => e.getAttribute("data-style")).sort());
    await eventually(vertices).toEqual(["neutral", "old", "proud"]);
    await eventually(() => page.locator(".stage-title").isVisible()).toBe(true);
    expect(await alert()).toBe("");

    await eventually(() => page.url()).toContain("db=small");
    await page.reload();
    await shown(page);
    await eventually(vertices).toEqual(["neutral", "old", "proud"]);

    await page.getByRole("link", { name: "Data" }).click();
    await page.getByRole("button", { name: "Delete small" }).click();
    await eventually(databases).toEqual(["Built-in"]);
    await page.getByRole("button", { name: "Undo deletion of small" }).click();
    await eventually(databases).toEqual(["Built-in", "small"]);
    await page.getByRole("button", { name: "Open small" }).click();
    await eventually(() => vertices()).toEqual(["neutral", "old", "proud"]);
    await eventually(openDatabase).toBe("small");
    await page.getByRole("link", { name: "Data" }).click();
    await page.getByRole("button", { name: "Delete small" }).click();
    await eventually(databases).toEqual(["Built-in"]);
    await screenshot(page, "data-deleted");
    await page.getByRole("button", { name: "Open" }).click();
    await eventually(() => vertices()).toContain("strutting");
    await eventually(openDatabase).toBe("");
  });

  it("may be dropped on the playground, where it brings its view", async () => {
    await page.getByRole("link", { name: "Play" }).click();
    await dropFile(page, "small.zip", smallSet());
    await page.getByRole("button", { name: /^Make a database/ }).click();
    await eventually(heading).toBe("5 clips, 3 styles");
    await read();
    await eventually(() => page.evaluate(() => window.strut.state.view)).toBe("data");
  });
});

describe("a style of two manners", () => {
  it("is named with the clips of each, and made two styles", async () => {
    const alike = (style: string, first: number, bvh: string) =>
      [bvh, everyNth(bvh, 2)].map((content, i) => ({ name: `walk_${style}_${first + i}.bvh`, content }));
    const clips = [
      ...alike("neutral", 1, walks.neutral),
      ...alike("neutral", 3, everyNth(walks.neutral, 1, 120)),
      ...alike("old", 1, walks.old),
      ...alike("old", 3, walks.proud),
    ];
    await choose(written("manners.zip", zipOf(clips)));
    await read();
    const report = page.getByRole("region", { name: "Takes that differ" });
    expect(await report.count(), "nothing is known before a build").toBe(0);
    await build();
    await eventually(() => report.locator("li").allTextContents()).toEqual([
      expect.stringMatching(/^“old” in “walk”takes 1–2andtakes 3–4/),
    ]);
    await report.getByRole("button", { name: "Show: old in walk" }).click();
    await eventually(() => page.locator(".clip-file").count()).toBe(4);
    await report.scrollIntoViewIfNeeded();
    await eventually(faults).toEqual([]);
    await screenshot(page, "data-manners");
    await page.setViewportSize({ width: 390, height: 844 });
    await report.scrollIntoViewIfNeeded();
    await screenshot(page, "data-manners-mobile");
    await page.setViewportSize({ width: 1440, height: 900 });

    await report.getByRole("button", { name: "Split into two styles: old in walk" }).click();
    await eventually(heading).toBe("8 clips, 3 styles");
    await eventually(() => report.count()).toBe(0);
    await dismissNotes();
    await buildButton().click();
    await page.getByRole("button", { name: "Replace it" }).click();
    await eventually(() => saidReady().textContent()).toMatch(/^Three styles ready/);
    expect(await report.count(), "each has one manner now").toBe(0);
  });
});

describe("a database of a name that is taken", () => {
  it("is another one, unless the person wants it replaced", async () => {
    await choose(written("walk_neutral_1.bvh", walks.neutral), written("walk_old_1.bvh", walks.old));
    await read();
    const name = page.getByLabel("Name of the database");
    await eventually(() => name.inputValue()).toBe("My clips");
    await build();
    await page.getByRole("button", { name: "Clear", exact: true }).click();
    await choose(written("walk_neutral_1.bvh", walks.neutral), written("walk_proud_1.bvh", walks.proud));
    await read();
    await eventually(() => name.inputValue(), "a free name is proposed").toBe("My clips 2");
    const files = () => page.locator(".clip-file").allTextContents();
    await eventually(files).toEqual(["walk_neutral_1.bvh", "walk_proud_1.bvh"]);

    await name.fill("My clips");
    await buildButton().click();
    const question = page.getByRole("dialog", { name: "A database “My clips” exists" });
    expect(await question.textContent()).toContain("It has 2 clips, 2 styles.");
    await eventually(faults).toEqual([]);
    await screenshot(page, "data-replace");
    await question.getByRole("button", { name: "Cancel" }).click();
    await eventually(() => question.count()).toBe(0);
    await eventually(() => buildButton().isEnabled()).toBe(true);
    expect(await databases()).toEqual(["Built-in", "My clips"]);

    await buildButton().click();
    await question.getByRole("button", { name: "Keep both" }).click();
    await eventually(databases).toEqual(["Built-in", "My clips", "My clips 2"]);
    await eventually(() => name.inputValue()).toBe("My clips 2");
    await name.fill("My clips");
    await eventually(() => buildButton().isEnabled()).toBe(true);
    await buildButton().click();
    await dismissNotes();
    await question.getByRole("button", { name: "Replace it" }).click();
    await eventually(() => saidReady().count()).toBe(1);
    await eventually(() => buildButton().isEnabled()).toBe(true);
    await eventually(databases).toEqual(["Built-in", "My clips", "My clips 2"]);
    await page.getByRole("button", { name: "Open My clips", exact: true }).click();
    await eventually(() => page.locator(".vertex[data-style=proud]").count(), "the new one").toBe(1);
    await eventually(openDatabase).toBe("My clips");
  });

  it("is shown as it is now where it was open", async () => {
    await choose(written("walk_neutral_1.bvh", walks.neutral), written("walk_old_1.bvh", walks.old));
    await read();
    const name = page.getByLabel("Name of the database");
    await build();
    const mine = await name.inputValue();
    await page.getByRole("button", { name: `Open ${mine}`, exact: true }).click();
    await eventually(openDatabase).toBe(mine);
    await page.getByRole("link", { name: "Data" }).click();
    await page.getByRole("button", { name: "Clear", exact: true }).click();
    await choose(written("walk_neutral_1.bvh", walks.neutral), written("walk_proud_1.bvh", walks.proud));
    await read();
    await name.fill(mine);
    await buildButton().click();
    await page.getByRole("button", { name: "Replace it" }).click();
    await page.getByRole("link", { name: "Play" }).click();
    await eventually(() =>
      page.locator(".vertex").evaluateAll((v) => v.map((e) => e.getAttribute("data-style")).sort()),
    ).toEqual(["neutral", "proud"]);
  });
});

describe("a browser that keeps nothing", () => {
  it("says so, and what was built can be opened until the page is closed", async () => {
    await page.evaluate(() => {
      IDBFactory.prototype.open = () => {
        throw new DOMException("refused", "SecurityError");
      };
    });
    await choose(written("small.zip", smallSet()));
    await read();
    await build();
    await eventually(alert).toContain(
      "“small” is ready, but it will not be here after a reload. The browser does not let this page keep files",
    );
    expect(await heading(), "the clips stay").toBe("5 clips, 3 styles");
    await eventually(databases).toEqual(["Built-in", "small"]);
    await eventually(() => page.locator(".stored li").nth(1).textContent()).toContain("not kept · 3 styles");
    await page.getByRole("button", { name: "Open small" }).click();
    await eventually(() => page.locator(".vertex").count()).toBe(3);
    await eventually(() => page.locator(".stage-title").isVisible()).toBe(true);
    // It is completely open: its input has been analysed.
    await eventually(() => page.evaluate(() => window.strut.analysed)).toBe(true);
    expect(await openDatabase(), "no link could bring it back").toBe("");
    await page.getByRole("link", { name: "Data" }).click();
    await eventually(() => page.locator(".stored [aria-current]").textContent()).toContain("open · not kept");
    await eventually(() => asksBeforeLeaving(page), "what it does not keep would be lost").toBe(true);
  });
});

describe("clips of which no database is built", () => {
  it("stay where the page goes home, and are asked about before it is left", async () => {
    expect(await asksBeforeLeaving(page)).toBe(false);
    await choose(written("small.zip", smallSet()));
    await read();
    await eventually(heading).toBe("5 clips, 3 styles");
    expect(await asksBeforeLeaving(page)).toBe(true);
    await page.evaluate(() => Object.assign(window, { same: true }));
    await page.getByRole("link", { name: "Strut home" }).click();
    await eventually(() => page.title()).toContain("Play");
    expect(await page.evaluate(() => "same" in window), "the page was not loaded anew").toBe(true);
    expect(await asksBeforeLeaving(page), "out of sight").toBe(true);
    await page.getByRole("link", { name: "Data" }).click();
    await eventually(heading).toBe("5 clips, 3 styles");
    await build();
    await eventually(() => asksBeforeLeaving(page), "the database is kept").toBe(false);
  });
});

describe("labels", () => {
  it("are corrected by pattern, by hand and by a table", async () => {
    mkdirSync(join(folder, "takes"), { recursive: true });
    for (const [name, text] of [
      ["a-walk (old).bvh", walks.old],
      ["a-walk (plain).bvh", walks.neutral],
      ["odd.bvh", walks.proud],
    ] as const)
      writeFileSync(join(folder, "takes", name), text);
    await page.locator("input[webkitdirectory]").setInputFiles(join(folder, "takes"));
    await read();
    const pattern = page.getByLabel("Pattern of the file names");
    await pattern.fill("{any}-{action} ({style}).bvh");
    await pattern.press("Enter");
    await eventually(heading).toBe("2 clips, 2 styles");
    await page.getByRole("button", { name: "1 left out" }).click();
    const unmatched = page.locator(".clip-note").filter({ hasText: /^Its name does not match/ });
    await eventually(() => unmatched.count()).toBe(1);
    await eventually(faults).toEqual([]);

    await page.getByLabel("action of takes/odd.bvh").fill("walk");
    await page.getByLabel("action of takes/odd.bvh").press("Tab");
    await page.getByLabel("style of takes/odd.bvh").fill("proud");
    await page.getByLabel("style of takes/odd.bvh").press("Tab");
    await eventually(heading).toBe("3 clips, 3 styles");
    await page.getByRole("button", { name: "Undo", exact: true }).first().click();
    await eventually(heading).toBe("2 clips, 2 styles");
    await page.getByRole("button", { name: "Redo", exact: true }).first().click();
    await eventually(heading).toBe("3 clips, 3 styles");
    await eventually(() => page.getByRole("radio", { name: "plain is neutral" }).isChecked()).toBe(true);
    // A style is renamed everywhere.
    await page.getByLabel("Name of the style plain").fill("calm");
    await page.getByLabel("Name of the style plain").press("Enter");
    await eventually(() => page.getByRole("radio", { name: "calm is neutral" }).isChecked()).toBe(true);
    await screenshot(page, "data-rename");

    await page.getByRole("button", { name: "Clear", exact: true }).click();
    await eventually(() => page.locator(".clip-file").count()).toBe(0);
    await page.keyboard.press("Control+z");
    await eventually(() => page.locator(".clip-file").count(), "what was cleared comes back").toBe(3);
    await eventually(() => page.getByRole("radio", { name: "calm is neutral" }).isChecked()).toBe(true);
    expect(await page.getByLabel("style of takes/odd.bvh").inputValue()).toBe("proud");

    await choose(written("labels.csv", "file,action,style\na-walk (old).bvh,stroll,ancient\n"));
    await eventually(() => page.getByRole("radio", { name: "ancient is neutral" }).count()).toBe(1);
    await choose(written("labels.csv", "file,action\na,b\n"));
    await eventually(() => page.locator(".data-names .caption").textContent()).toMatch(/^Line 1 is 'file,action'; /);
  });

  it("keep clips of unknown skeletons out until a person has chosen the joints", async () => {
    const nameless = (bvh: string) => {
      let joint = 0;
      return bvh.replace(/(ROOT|JOINT) \S+/g, (_, kind) => `${kind} J${joint++}`);
    };
    await choose(
      written("walk_neutral_1.bvh", nameless(walks.neutral)),
      written("walk_old_1.bvh", nameless(walks.old)),
    );
    await read();
    const joints = page.getByRole("button", { name: "Joints of skeleton 1" });
    await eventually(() => joints.textContent()).toBe("Check joints");
    await joints.click();
    const dialog = page.getByRole("dialog");
    await eventually(() => dialog.getByRole("combobox").count()).toBe(21);
    await eventually(faults).toEqual([]);
    await screenshot(page, "data-joints");
    await dialog.getByRole("button", { name: "Use these joints" }).click();
    await eventually(() => joints.textContent()).toBe("Joints");
    expect(await build()).toMatch(/^Two styles ready/);
  });
});

describe("hostile input", () => {
  it("gets a sentence, and what is good in it is built", async () => {
    const style = `<img src=x onerror=document.title="bad"> "it's" 怒り`;
    await choose(
      written(
        "hostile.zip",
        zipOf([
          { name: "../../walk_evil_1.bvh", content: walks.old },
          { name: "walk_bomb_1.bvh", content: new Uint8Array(40 << 20), claimedBytes: 7 },
          { name: "walk_empty_1.bvh", content: "" },
          { name: "walk_neutral_1.bvh", content: walks.neutral },
          { name: "walk_neutral_2.bvh", content: playedAt(walks.neutral, 120) },
          { name: `walk_${style}_1.bvh`, content: playedAt(walks.old, 24) },
          { name: "歩く_neutral_1.bvh", content: walks.proud.replaceAll("Hips", "Pelvis") },
        ]),
      ),
    );
    await read();
    await eventually(alert).toContain("leads out of the archive and was left out.");
    await eventually(heading).toBe("4 clips, 2 styles");
    const names = () =>
      page
        .locator(".matrix tbody .class-name")
        .evaluateAll((inputs) => inputs.map((input) => (input as HTMLInputElement).value));
    await eventually(names).toContain(style);
    expect(await page.locator("main img").count()).toBe(0);
    await page.getByRole("button", { name: "2 left out" }).click();
    await eventually(() => page.locator(".clip-note").allTextContents()).toEqual([
      "It unpacks to more than 200 times its size, so it cannot be a motion.",
      "The file is empty; a BVH file begins with HIERARCHY.",
    ]);
    await screenshot(page, "data-hostile");
    const concerns = () => page.locator(".concerns").textContent();
    await eventually(concerns).toContain("has only one clip");
    await eventually(concerns).toContain("has no “歩く”");
    expect(await build()).toMatch(/^Two styles ready/);
    expect(await page.title()).not.toBe("bad");
  });

  it("of ten thousand empty files is listed and refused without a stall", async () => {
    const many = Array.from({ length: 10_000 }, (_, i) => ({ name: `walk_old_${i}.bvh`, content: "" }));
    await choose(written("many.zip", zipOf(many)));
    await read();
    await eventually(heading).toBe("0 clips, 0 styles");
    await eventually(() => page.getByRole("button", { name: "10\u202f000 left out" }).count()).toBe(1);
    expect(await page.locator(".clip-row").count()).toBeLessThan(60);
    await eventually(() => buildButton().isDisabled()).toBe(true);
  });

  it("that is no archive, or holds no clip, gets a sentence", async () => {
    await choose(written("broken.zip", "not a zip"));
    await eventually(alert).toContain("This is not a zip archive, or it is incomplete.");
    await choose(written("letters.zip", zipOf([{ name: "a.txt", content: "x" }])));
    await eventually(alert).toContain("There is no BVH among these files.");
  });
});

describe("building", () => {
  it("can be cancelled, and done again", async () => {
    const styles = ["neutral", "old", "proud"] as const;
    const takes = styles.flatMap((style) =>
      Array.from({ length: 20 }, (_, i) => ({
        name: `walk_${style}_${i}.bvh`,
        content: playedAt(walks[style], 60 + i),
      })),
    );
    await choose(written("takes.zip", zipOf(takes)));
    await read();
    // A fast machine may finish the build before a pointer gets there, and before progress is shown after 300 ms.
    const cancelled = page.evaluate(
      () =>
        new Promise<void>((resolve) => {
          const progress = document.querySelector<HTMLElement>(".build .progress")!;
          const observer = new MutationObserver(() => {
            if (progress.querySelector("[role=progressbar]")!.getAttribute("aria-valuenow") === "0") return;
            observer.disconnect();
            progress.querySelector("button")!.click();
            resolve();
          });
          observer.observe(progress, { subtree: true, attributes: true });
        }),
    );
    await buildButton().click();
    await cancelled;
    await eventually(() => buildButton().isEnabled()).toBe(true);
    expect(await databases()).toEqual(["Built-in"]);
    expect(await alert()).toBe("");
    expect(await build()).toMatch(/^Three styles ready/);
  });
});

const data = recordings();

describe.skipIf(!data)("recordings", () => {
  it("of another skeleton and rate are built and styled with", async () => {
    const names = readdirSync(join(data!, "bandai-namco-2")).filter((n) =>
      /_walk_(normal|elderly)_00[123]|LICENSE/.test(n),
    );
    const packed = names.map((name) => ({ name, content: readFileSync(join(data!, "bandai-namco-2", name)) }));
    await choose(written("bandai.zip", zipOf(packed)));
    await read();
    expect(await page.getByLabel("Pattern of the file names").inputValue()).toBe(
      "dataset-2_{action}_{style}_{take}.bvh",
    );
    expect(await build()).toMatch(/^Two styles ready/);
    await page.getByRole("button", { name: "Open bandai" }).click();
    await eventually(openDatabase).toBe("bandai");
    await eventually(() => page.locator(".stage-title").textContent()).toMatch(/^Walk, /);
  });
});

describe("the view", () => {
  for (const theme of ["dark", "light"] as const)
    for (const [name, width, height] of [
      ["wide", 1440, 900],
      ["narrow", 390, 844],
    ] as const)
      it(`fits and is for everybody (${name}, ${theme})`, async () => {
        await page.setViewportSize({ width, height });
        await showTheme(page, theme);
        await screenshot(page, `data-${name}-${theme}-empty`);
        await eventually(faults).toEqual([]);
        await choose(written("small.zip", smallSet()));
        await read();
        await transitionsEnded(page);
        const overflow = () =>
          page.evaluate(() => {
            const { scrollWidth, scrollHeight, clientWidth, clientHeight } = document.documentElement;
            return [scrollWidth - clientWidth, scrollHeight - clientHeight];
          });
        await eventually(overflow).toEqual([0, 0]);
        await eventually(faults).toEqual([]);
        await screenshot(page, `data-${name}-${theme}`);
      });
});
