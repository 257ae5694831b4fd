/**
 * Browser storage: full, damaged, slow, refused, or used by another tab. What was open is kept, and a message gives the
 * reason.
 */
import type { Page } from "playwright-core";
import { afterEach, beforeAll, beforeEach, describe, expect, it } from "vitest";
import type { StrutHook } from "../../../web/app/shell/hook";
import { walksIn } from "../../clips";
import { databaseOf } from "../../database_of";
import { dropFile, eventually, launchSite, openPage, shown, visit } from "../browser";
import { consoleErrors, dismissAll, type KeptDatabase, keepDatabase, keptNames } from "./inject";

declare const window: { strut: StrutHook; releaseDisk?: () => void };

const DATA = "view=data&play=0";

let page: Page;
let errors: string[];
let mine: KeptDatabase;
let walks: Record<"neutral" | "old" | "proud", string>;

beforeAll(async () => {
  walks = await walksIn(["neutral", "old", "proud"]);
  const file = await databaseOf({ "walk_neutral_1.bvh": walks.neutral, "walk_old_1.bvh": walks.old });
  mine = { name: "mine", styles: ["neutral", "old"], bytes: file };
  const { browser, site, close } = await launchSite();
  page = await openPage(browser, site.url, { hash: DATA, notesStay: true });
  errors = consoleErrors(page);
  return close;
});
beforeEach(() => dismissAll(page));
afterEach(() => expect(errors.splice(0)).toEqual([]));

const alert = () => page.getByRole("alert").textContent();
const notes = () => page.locator(".toasts [role=status]").textContent();
const openName = () => page.evaluate(() => window.strut.state.database);
const openInput = () => page.evaluate(() => window.strut.state.input);
const styles = () =>
  page.locator(".panels .vertex").evaluateAll((all) => all.map((one) => one.getAttribute("data-style")));
const listed = () => page.locator(".stored li:not(.deleted) bdi").allTextContents();
const buildButton = () => page.getByRole("button", { name: "Build the database" });

/** Opens the Data view from Play, so that it lists the stored databases again. */
async function goToData(): Promise<void> {
  await visit(page, "play=0");
  await page.waitForFunction(() => document.getElementById("app")!.dataset.view === "play");
  await visit(page, DATA);
  await page.waitForFunction(() => document.getElementById("app")!.dataset.view === "data");
}

/** Chooses clips in the Data view and waits until they are read. */
async function choose(clips: Readonly<Record<string, string>>): Promise<void> {
  const clear = page.getByRole("button", { name: "Clear", exact: true });
  if (await clear.isVisible()) await clear.click();
  const files = Object.entries(clips).map(([name, text]) => ({
    name,
    mimeType: "text/plain",
    buffer: Buffer.from(text),
  }));
  await page.locator("input[type=file][multiple]").last().setInputFiles(files);
  await page.locator('.data[aria-busy="false"]').waitFor();
  await eventually(() => buildButton().isEnabled()).toBe(true);
}

/** Opens another tab of the same browser, without a view: it only uses the storage. */
async function otherTab(): Promise<Page> {
  const other = await page.context().newPage();
  await other.route("**/other-tab", (route) => route.fulfill({ contentType: "text/html", body: "<title>Tab</title>" }));
  await other.goto(new URL("other-tab", page.url()).href);
  return other;
}

describe("a kept database", () => {
  it("that is damaged: what was open stays, and it can be deleted", async () => {
    await keepDatabase(page, { ...mine, name: "damaged", bytes: mine.bytes.subarray(0, mine.bytes.length / 2) });
    await goToData();
    await page.getByRole("button", { name: "Open damaged" }).click();
    await eventually(alert).toMatch(/\w.*\./);
    await eventually(styles).toContain("strutting");
    expect(await openName()).toBe("");
    await visit(page, DATA);
    await page.getByRole("button", { name: "Delete damaged" }).click();
    await eventually(listed).toEqual(["Built-in"]);
  });

  it("whose replacement the full disk refuses: both stay, and the new one can be exported", async () => {
    await keepDatabase(page, mine);
    await goToData();
    await eventually(listed).toEqual(["Built-in", "mine"]);
    await choose({ "walk_neutral_1.bvh": walks.neutral, "walk_proud_1.bvh": walks.proud });
    await page.getByLabel("Name of the database").fill("mine");
    await page.evaluate(() => {
      const { put } = IDBObjectStore.prototype;
      IDBObjectStore.prototype.put = function (this: IDBObjectStore, ...args: Parameters<typeof put>) {
        IDBObjectStore.prototype.put = put;
        const request = put.apply(this, args);
        // A partial write, followed by a full disk.
        request.addEventListener("success", () => this.transaction.abort());
        const full = new DOMException("full", "QuotaExceededError");
        Object.defineProperty(this.transaction, "error", { get: () => full });
        return request;
      };
    });
    await buildButton().click();
    await page.getByRole("button", { name: "Replace it" }).click();
    await eventually(alert).toMatch(
      /“mine 2” is ready, but it will not be here after a reload. The browser has no room/,
    );
    await eventually(listed).toEqual(["Built-in", "mine", "mine 2"]);
    expect(await keptNames(page)).toEqual(["mine"]);
    const [download] = await Promise.all([
      page.waitForEvent("download"),
      page.getByRole("button", { name: "Export mine 2" }).click(),
    ]);
    expect(download.suggestedFilename()).toBe("mine 2.strutdb");
    await page.getByRole("button", { name: "Delete mine 2" }).click();
    await eventually(listed).toEqual(["Built-in", "mine"]);
  });

  it("that the disk gives late: what was open goes on, and what is asked for next is not overtaken", async () => {
    await keepDatabase(page, mine);
    await visit(page, "play=1");
    await page.waitForFunction(() => window.strut.analysed);
    await page.evaluate(() => {
      const { get } = IDBObjectStore.prototype;
      IDBObjectStore.prototype.get = function (this: IDBObjectStore, ...args: Parameters<typeof get>) {
        IDBObjectStore.prototype.get = get;
        const request = get.apply(this, args);
        const { transaction } = this;
        // The answer waits for the disk, which the test releases.
        Object.defineProperty(transaction, "oncomplete", {
          set: (tell: () => void) => {
            window.releaseDisk = tell;
          },
        });
        return request;
      };
    });
    const before = await styles();
    await visit(page, "play=1&db=mine");
    await page.waitForFunction(() => window.releaseDisk !== undefined);
    const at = await page.evaluate(() => window.strut.frame!.inputFrame);
    await eventually(() => page.evaluate(() => window.strut.frame!.inputFrame)).not.toBe(at);
    expect(await styles()).toEqual(before);
    await visit(page, "play=0");
    await page.evaluate(() => window.releaseDisk!());
    // The engine answers in order: if the late database were opened, it would be there before the next answer.
    await visit(page, "play=0&frame=30");
    await page.waitForFunction(
      () => window.strut.analysed && window.strut.upToDate && window.strut.frame!.inputFrame === 30,
    );
    expect(await openName()).toBe("");
    expect(await styles()).toEqual(before);
    expect(await alert()).toBe("");
  });
});

describe("a motion that the disk gives late", () => {
  it("does not come after a link that is followed meanwhile, though the link names what is open", async () => {
    await visit(page, "play=0&frame=30&styles=proud:1,old:0,depressed:0");
    await page.waitForFunction(() => window.strut.upToDate && window.strut.frame!.inputFrame === 30);
    await page.evaluate(() => {
      delete window.releaseDisk;
      const { arrayBuffer } = Blob.prototype;
      Blob.prototype.arrayBuffer = async function () {
        Blob.prototype.arrayBuffer = arrayBuffer;
        await new Promise<void>((resolve) => {
          window.releaseDisk = resolve;
        });
        return arrayBuffer.call(this);
      };
    });
    await dropFile(page, "late.bvh", walks.neutral);
    await page.waitForFunction(() => window.releaseDisk !== undefined);
    await visit(page, "play=0&frame=60&styles=proud:1,old:0,depressed:0");
    await page.evaluate(() => window.releaseDisk!());
    await page.waitForFunction(() => window.strut.upToDate && window.strut.analysed);
    expect(await page.evaluate(() => window.strut.frame!.inputFrame)).toBe(60);
    expect(await openInput()).toBe("");
    expect(await alert()).toBe("");
    await dropFile(page, "late.bvh", walks.neutral);
    await eventually(openInput).toBe("late");
  });
});

describe("a question of the browser, whether the page may keep files, that nobody answers", () => {
  it("keeps no build waiting", async () => {
    await visit(page, DATA);
    await page.evaluate(() => {
      StorageManager.prototype.persist = () => new Promise(() => {});
    });
    await choose({ "walk_neutral_1.bvh": walks.neutral, "walk_old_1.bvh": walks.old });
    await page.getByLabel("Name of the database").fill("asked");
    await buildButton().click();
    await eventually(notes).toMatch(/Two styles ready/);
    await eventually(() => keptNames(page)).toEqual(["asked", "mine"]);
  });
});

describe("two tabs over one storage", () => {
  it("a database that the other one deletes plays on; a link to it says that it is not here", async () => {
    await visit(page, "play=0&db=mine");
    await eventually(styles).toEqual(expect.arrayContaining(["neutral", "old"]));
    await eventually(styles).toHaveLength(2);
    const other = await otherTab();
    await other.evaluate(
      () =>
        new Promise<void>((resolve) => {
          const opening = indexedDB.open("strut");
          opening.onsuccess = () => {
            const transaction = opening.result.transaction("databases", "readwrite");
            transaction.objectStore("databases").clear();
            transaction.oncomplete = () => resolve(opening.result.close());
          };
        }),
    );
    await visit(page, "play=0&db=mine&styles=old:1,neutral:0&frame=30");
    await eventually(() => page.evaluate(() => window.strut.frame!.inputFrame)).toBe(30);
    expect(await styles()).toHaveLength(2);
    await page.reload();
    await shown(page);
    await eventually(notes).toMatch(/the database “mine”, which is not on this device/);
    await eventually(openName).toBe("");
    await other.close();
  });

  it("of which one is newer: it is not kept waiting, and the older one asks to be loaded anew", async () => {
    await visit(page, DATA);
    await choose({ "walk_neutral_1.bvh": walks.neutral, "walk_old_1.bvh": walks.old });
    const other = await otherTab();
    const upgraded = await other.evaluate(
      () =>
        new Promise((resolve) => {
          const opening = indexedDB.open("strut", 2);
          opening.onblocked = () => resolve("blocked");
          opening.onsuccess = () => resolve(opening.result.close());
        }),
    );
    expect(upgraded).toBeUndefined();
    await page.getByLabel("Name of the database").fill("late");
    await buildButton().click();
    await eventually(alert).toMatch(
      /“late” is ready, but .* A newer version of Strut has upgraded the databases of this device/,
    );
    const panel = page
      .locator("section")
      .filter({ has: page.getByRole("heading", { name: "Databases", exact: true }) });
    await panel.getByRole("button", { name: "Reload" }).waitFor();
    await page.getByRole("button", { name: "Open late" }).click();
    await eventually(styles).toHaveLength(2);
    await other.evaluate(() => indexedDB.deleteDatabase("strut"));
    await other.close();
  });
});

describe("a browser that remembers nothing", () => {
  it("shows the page all the same, and what it keeps for a visit", async () => {
    await page.addInitScript(() => {
      const refuse = () => {
        throw new DOMException("refused", "SecurityError");
      };
      Object.defineProperty(globalThis, "localStorage", { get: refuse });
      Object.defineProperty(globalThis, "indexedDB", { get: refuse });
      Object.defineProperty(globalThis, "caches", { get: refuse });
    });
    await page.goto(new URL("?nothing#play=0", page.url()).href);
    await shown(page);
    await page.waitForFunction(() => window.strut.analysed);
    await visit(page, DATA);
    const note = page.getByText("The browser does not let this page keep files, as in a private window.");
    await note.first().waitFor();
    await visit(page, "view=learn");
    await page.locator(".learn h1").first().waitFor();
    await visit(page, "play=0");
    expect(await alert()).toBe("");
  });
});
