/** Public data sets: fetched from their host, which the test replaces, stored, and used. */
import { createHash } from "node:crypto";
import { basename } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { walksIn } from "../clips";
import { axeFaults } from "./axe";
import { closePage, eventually, inputName, launchBrowser, openPage, screenshot, serveSite } from "./browser";

const STYLES = ["neutral", "old", "proud"] as const;
/** A host from which the page may fetch; the network is not used. */
const BASE = "https://raw.githubusercontent.com/nobody/small-set/0000000000000000000000000000000000000000/";

let browser: Browser;
let site: Awaited<ReturnType<typeof serveSite>>;
/** The files of the set. */
let clips: Map<string, string>;
/** Whether the host can be reached, after how many files it stops answering, and which file it has changed. */
const host = { reachable: true, limit: Number.POSITIVE_INFINITY, asked: 0, changed: "" };

beforeAll(async () => {
  const [walks, ...opened] = await Promise.all([walksIn([...STYLES]), launchBrowser(), serveSite()]);
  clips = new Map(STYLES.flatMap((style) => [1, 2].map((take) => [`walk_${style}_${take}.bvh`, walks[style]])));
  [browser, site] = opened;
});
afterAll(async () => {
  await browser.close();
  await site.close();
});

/** Opens a view of a page whose catalogue has one set. */
async function open(view = "Data"): Promise<Page> {
  Object.assign(host, { reachable: true, limit: Number.POSITIVE_INFINITY, asked: 0, changed: "" });
  const page = await openPage(browser, site.url, { size: { width: 1440, height: 900 } });
  const set = {
    id: "small",
    name: "Small set",
    about: "walking in three styles",
    licence: { name: "CC BY-NC 4.0", url: "https://creativecommons.org/licenses/by-nc/4.0/", note: "Credit it." },
    citation: "Nobody, 2026",
    page: "https://example.org/set",
    bytes: 0,
    base: BASE,
    files: [...clips].map(([path, text]) => ({ path, sha256: createHash("sha256").update(text).digest("hex") })),
    pattern: "{action}_{style}_{take}.bvh",
  };
  await page.route("**/catalog.json", (route) => route.fulfill({ json: { version: 1, sets: [set] } }));
  await page.route(`${BASE}**`, async (route) => {
    host.asked += 1;
    // An unanswered request stays open.
    if (host.asked > host.limit) return;
    // A page cannot distinguish this from a host that refuses other pages.
    if (!host.reachable) return route.abort();
    const name = basename(new URL(route.request().url()).pathname);
    await route.fulfill({
      body: host.changed === name ? `${clips.get(name)} ` : clips.get(name)!,
      headers: { "Access-Control-Allow-Origin": "*" },
    });
  });
  await page.getByRole("link", { name: view, exact: true }).click();
  return page;
}

const note = (page: Page) => page.locator(".catalogue [role=status].caption").textContent();
const heading = (page: Page) => page.locator(".data-clips h1").textContent();

describe("a public data set", () => {
  it("is fetched after its licence was shown, goes on where it was cancelled, and is kept", async () => {
    const page = await open();
    await page.getByRole("button", { name: "Get Small set" }).click();
    const licence = page.getByRole("dialog", { name: "Small set" });
    expect(await licence.textContent()).toContain("Licence: CC BY-NC 4.0. Credit it.");
    expect(host.asked, "nothing is fetched before").toBe(0);
    await screenshot(page, "catalogue-licence");
    host.limit = 3;
    await licence.getByRole("button", { name: "Download" }).click();
    await eventually(() => page.locator(".catalogue .progress").textContent()).toContain("3 files of 6");
    await page.locator(".catalogue").getByRole("button", { name: "Cancel" }).click();
    host.limit = Number.POSITIVE_INFINITY;
    await page.getByRole("button", { name: "Resume Small set" }).click();
    await licence.getByRole("button", { name: "Download" }).click();
    await eventually(() => heading(page)).toBe("6 clips, 3 styles");
    await eventually(() => note(page)).toBe("Cite it as: Nobody, 2026.");
    await eventually(() => page.getByLabel("Name of the database").inputValue()).toBe("Small set");
    await screenshot(page, "catalogue");

    await page.reload();
    host.limit = 0;
    await page.getByRole("button", { name: "Use Small set" }).click();
    await eventually(() => heading(page)).toBe("6 clips, 3 styles");
    await page.getByRole("button", { name: "Delete Small set" }).click();
    await page.getByRole("button", { name: "Get Small set" }).waitFor();
    await closePage(page);
  });

  it("of which a file was changed is refused, and the file is not kept", async () => {
    const page = await open();
    host.changed = "walk_old_2.bvh";
    await page.getByRole("button", { name: "Get Small set" }).click();
    await page.getByRole("button", { name: "Download" }).click();
    await eventually(() => note(page)).toBe(
      "walk_old_2.bvh differs from the file in the list of public data sets, and was discarded. Get the files from https://example.org/set and drop them here.",
    );
    host.changed = "";
    await page
      .getByRole("button", { name: /Small set$/ })
      .last()
      .click();
    await page.getByRole("button", { name: "Download" }).click();
    await eventually(() => heading(page)).toBe("6 clips, 3 styles");
    await closePage(page);
  });

  it("whose host cannot be reached is said to be out of reach", async () => {
    const page = await open();
    host.reachable = false;
    await page.getByRole("button", { name: "Get Small set" }).click();
    await page.getByRole("button", { name: "Download" }).click();
    await eventually(() => note(page)).toBe(
      "raw.githubusercontent.com cannot be reached, or does not allow other pages to read its files. Get the files from https://example.org/set and drop them here.",
    );
    await closePage(page);
  });
});

describe("a recorded motion", () => {
  const dialog = (page: Page) => page.getByRole("dialog", { name: "Try recorded motion" });
  const offer = (page: Page) => page.getByRole("button", { name: "Try recorded motion…" }).click();
  const status = (page: Page) => dialog(page).locator(".recorded-status").textContent();

  it("is one clip of a set, with its licence beside it, and becomes the input", async () => {
    const page = await open("Play");
    await offer(page);
    await eventually(() => dialog(page).locator("li").textContent()).toContain("CC BY-NC 4.0. Credit it.");
    expect(host.asked, "nothing is fetched before").toBe(0);
    const clip = dialog(page).getByLabel("Clip of Small set");
    await eventually(() => clip.locator("option:checked").textContent()).toBe("walk, neutral 1");
    expect(await axeFaults(page)).toEqual([]);
    await clip.selectOption({ label: "walk, old 2" });
    await dialog(page).getByRole("button", { name: "Try: Small set" }).click();
    await eventually(() => inputName(page)).toBe("walk_old_2");
    expect(host.asked, "the clip alone").toBe(1);
    await eventually(() => page.locator(".toast").textContent()).toContain("Cite it as: Nobody, 2026.");
    await eventually(() => page.locator(".file-bar .file-name").textContent()).toBe("walk_old_2");
    // It is on this device now.
    host.reachable = false;
    await page.getByLabel("Input motion").selectOption({ label: "neutral run" });
    await offer(page);
    await clip.selectOption({ label: "walk, old 2" });
    await dialog(page).getByRole("button", { name: "Try: Small set" }).click();
    await eventually(() => inputName(page)).toBe("walk_old_2");
    await closePage(page);
  });

  it("can be cancelled, and says why it cannot be had", async () => {
    const page = await open("Play");
    host.limit = 0;
    await offer(page);
    await dialog(page).getByRole("button", { name: "Try: Small set" }).click();
    await eventually(() => dialog(page).locator(".progress").textContent()).toContain(
      "Downloading walk_neutral_1.bvh.",
    );
    await dialog(page).locator(".progress").getByRole("button", { name: "Cancel" }).click();
    await eventually(() => dialog(page).locator(".progress").isVisible()).toBe(false);
    expect(await status(page)).toBe("");
    Object.assign(host, { limit: Number.POSITIVE_INFINITY, reachable: false });
    await dialog(page).getByRole("button", { name: "Try: Small set" }).click();
    await eventually(() => status(page)).toContain("raw.githubusercontent.com cannot be reached");
    await page.context().setOffline(true);
    await dialog(page).getByRole("button", { name: "Try: Small set" }).click();
    await eventually(() => status(page)).toContain("There is no network connection.");
    await page.keyboard.press("Escape");
    await eventually(() => dialog(page).count()).toBe(0);
    await closePage(page);
  });
});
