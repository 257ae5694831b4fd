/**
 * The page in the cache of its service worker: offline, as another version, with a damaged cache, with opened files.
 */
import { cpSync, mkdtempSync, readdirSync, readFileSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { extname, join } from "node:path";
import type { Page } from "playwright-core";
import { beforeAll, describe, expect, it, onTestFinished } from "vitest";
import { writeServiceWorker } from "../../scripts/offline_plugin.mjs";
import { siteFiles } from "../../scripts/site_files.mjs";
import type { StrutHook } from "../../web/app/shell/hook";
import type { StrutFigure } from "../../web/figures/figure_element";
import { VIEW_NAMES, type ViewName } from "../../web/link/page";
import { walksIn } from "../clips";
import { serveFolder } from "../package/server";
import { root } from "../recordings";
import { closePage, eventually, inputName, launchBrowser, openPage, shown, visit } from "./browser";

declare const window: { strut: StrutHook };

let browser: Awaited<ReturnType<typeof launchBrowser>>;
beforeAll(async () => {
  browser = await launchBrowser({ whole: true });
  return () => browser.close();
});

/** Serves a copy of the built site, which a test may change. */
async function serveCopy(folder = "/") {
  const host = mkdtempSync(join(tmpdir(), "strut-offline-"));
  const dist = join(host, folder);
  cpSync(join(root, "dist"), dist, { recursive: true });
  const server = await serveFolder(host);
  const remove = async () => {
    await server.close();
    rmSync(host, { recursive: true });
  };
  return { dist, url: server.url + folder, close: server.close, remove };
}

/** Opens a page with its service worker, and waits until everything is cached. */
async function openKept({ dist, url }: { dist: string; url: string }): Promise<Page> {
  const page = await openPage(browser, url, { hash: "play=0", serviceWorker: true });
  const { first, rest } = siteFiles(dist);
  // The page and the catalogue are in no chunk's list.
  const files = first.length + rest.length + 2;
  await page.evaluate(async (files) => {
    const keys = async (name: string) => (await caches.open(name)).keys();
    while ((await Promise.all((await caches.keys()).map(keys))).flat().length < files)
      await new Promise((later) => setTimeout(later, 100));
  }, files);
  return page;
}

/** Returns the lengths of all cached files. */
function keptBytes(page: Page): Promise<number[]> {
  return page.evaluate(async () => {
    const lengths: number[] = [];
    for (const name of await caches.keys()) {
      const cache = await caches.open(name);
      for (const key of await cache.keys()) lengths.push((await (await cache.match(key))!.blob()).size);
    }
    return lengths.sort((a, b) => a - b);
  });
}

/** Truncates cached files. */
function damage(page: Page, ending: string): Promise<void> {
  return page.evaluate(async (ending) => {
    for (const name of await caches.keys()) {
      const cache = await caches.open(name);
      for (const key of await cache.keys()) {
        if (!new URL(key.url).pathname.endsWith(ending)) continue;
        const { headers, body } = (await cache.match(key))!;
        const whole = await new Response(body).blob();
        await cache.put(key, new Response(whole.slice(0, whole.size / 2), { headers }));
      }
    }
  }, ending);
}

/** Waits until everything that a view loads is visible. */
const LOADED: Record<ViewName, (page: Page) => Promise<unknown>> = {
  play: shown,
  learn: (page) =>
    page
      .locator("strut-figure")
      .first()
      .evaluate((figure) => (figure as StrutFigure).ready()),
  compare: (page) => page.locator('.compare-table[data-column="mar"]').getByText("cm/s").first().waitFor(),
  walk: (page) =>
    page
      .locator(".walk-figures")
      .getByText(/^0\.\d\d m$/)
      .first()
      .waitFor(),
  "key-style": (page) => page.locator('.key-style[aria-busy="false"]').waitFor(),
  crowd: (page) => page.locator(".crowd-foot .button:enabled").first().waitFor(),
  data: (page) => page.locator(".catalogue").getByRole("button", { name: /^Get / }).first().waitFor(),
};

/** Opens a view and waits until it is complete; no error may be shown. */
async function expectWorks(page: Page, view: ViewName): Promise<void> {
  await visit(page, `play=0&view=${view}`);
  await eventually(() => page.evaluate(() => window.strut.state.view)).toBe(view);
  await LOADED[view](page);
  expect(await page.getByRole("alert").textContent()).toBe("");
}

describe("after one visit", () => {
  it("every view opens without a network", async () => {
    const site = await serveCopy("/a/folder/");
    onTestFinished(site.remove);
    const page = await openKept(site);
    await site.close();
    await page.reload();
    await shown(page);
    for (const view of VIEW_NAMES) await expectWorks(page, view);
    await closePage(page);
  });
});

/** Turns the built site into a newer version: all its assets have other names. */
async function deployNewer(dist: string): Promise<void> {
  const assets = readdirSync(join(dist, "assets"));
  const newer = (name: string) => `newer-${name}`;
  const names = new RegExp(`(?<=["'/(])(${assets.map((name) => name.replace(/\W/g, "\\$&")).join("|")})`, "g");
  const texts = [...assets.map((name) => `assets/${name}`), "index.html", ".vite/manifest.json"];
  for (const path of texts.filter((path) => [".js", ".css", ".html", ".json"].includes(extname(path)))) {
    const text = readFileSync(join(dist, path), "utf8");
    writeFileSync(join(dist, path), text.replace(names, newer));
  }
  for (const name of assets) renameSync(join(dist, "assets", name), join(dist, "assets", newer(name)));
  await writeServiceWorker(dist);
}

/** Returns whether a page is of the version of {@link deployNewer}. */
const isNewer = (page: Page) =>
  page.evaluate(() => document.querySelector<HTMLScriptElement>("script[src]")!.src.includes("newer-"));
const updateOf = (page: Page) => page.getByRole("status").getByRole("button", { name: "Update" });

describe("a newer version", () => {
  it("is offered, and shown when a person says so; until then a page stays what it is", async () => {
    const site = await serveCopy();
    onTestFinished(site.remove);
    const page = await openKept(site);
    const other = await page.context().newPage();
    // Drawing a walk in software would leave the worker little time.
    await other.goto(`${site.url}#play=0`);
    await shown(other);

    await deployNewer(site.dist);
    await page.evaluate(async () => void (await navigator.serviceWorker.getRegistration())!.update());
    await updateOf(page).waitFor();
    // The server no longer has the files of this view.
    await expectWorks(page, "compare");
    await page.reload();
    await shown(page);
    expect(await isNewer(page)).toBe(false);

    await updateOf(page).click();
    await eventually(() => isNewer(page).catch(() => false)).toBe(true);
    await shown(page);
    expect(await page.evaluate(() => window.strut.state.view)).toBe("compare");
    await expectWorks(page, "data");

    await expectWorks(other, "data");
    expect(await isNewer(other)).toBe(false);
    await updateOf(other).click();
    await eventually(() => isNewer(other).catch(() => false)).toBe(true);
    await closePage(page);
  });
});

describe("a damaged cache", () => {
  it("is repaired from the network; without one, the page says what is missing", async () => {
    const site = await serveCopy();
    onTestFinished(site.remove);
    const page = await openKept(site);
    const whole = await keptBytes(page);
    await damage(page, "");
    expect(await keptBytes(page)).not.toEqual(whole);
    await page.reload();
    await shown(page);
    await eventually(() => keptBytes(page)).toEqual(whole);

    await site.close();
    await page.reload();
    await shown(page);
    await damage(page, ".wasm");
    await page.reload();
    await eventually(() => page.getByRole("alert").textContent()).toMatch(
      /The engine could not be loaded: the server cannot be reached .* Check the connection, then reload the page\./,
    );
    await closePage(page);
  });
});

describe("the installed page", () => {
  let site: Awaited<ReturnType<typeof serveCopy>>;
  let page: Page;
  beforeAll(async () => {
    site = await serveCopy("/a/folder/");
    page = await openKept(site);
    return async () => {
      await closePage(page);
      await site.remove();
    };
  });

  /** Returns the browser's report on the manifest. */
  async function manifest() {
    const session = await page.context().newCDPSession(page);
    const { data, errors } = await session.send("Page.getAppManifest");
    const { installabilityErrors } = await session.send("Page.getInstallabilityErrors");
    return { ...JSON.parse(data!), errors: [...errors, ...installabilityErrors.map(({ errorId }) => errorId)] };
  }

  it("can be installed", async () => {
    // A test's window is private.
    expect((await manifest()).errors).toEqual(["in-incognito"]);
  });

  it("asks before it opens a file in a tab, as a page of another site may have sent it", async () => {
    const { old } = await walksIn(["old"], 200);
    const { action } = (await manifest()).share_target;
    const other = await page.context().newPage();
    await other.setContent(`<form method="post" enctype="multipart/form-data" action="${site.url}${action}"></form>`);
    await other.locator("form").evaluate((form, bvh) => {
      const sent = new DataTransfer();
      sent.items.add(new File([bvh], "planted walk.bvh"));
      const { files } = sent;
      form.append(Object.assign(document.createElement("input"), { type: "file", name: "files", files }));
      (form as HTMLFormElement).submit();
    }, old);
    const question = other.locator(".toast.note").filter({ hasText: "sent “planted walk.bvh”" });
    await eventually(() => question.count()).toBe(1);
    await shown(other);
    expect(await inputName(other)).not.toBe("planted walk");
    await question.getByRole("button", { name: "Open" }).click();
    await eventually(() => inputName(other)).toBe("planted walk");
    await other.close();
  });

  it("opens files that another app shares, and those that the system launches it with", async () => {
    const { old } = await walksIn(["old"], 200);
    const { action, method, params } = (await manifest()).share_target;
    await page.evaluate(
      async ([bvh, field, action, method]) => {
        const form = new FormData();
        form.append(field!, new File([bvh!], "shared walk.bvh"));
        await fetch(action!, { method: method!, body: form, redirect: "manual" });
      },
      [old, params.files[0].name, action, method],
    );
    // The window of an installed page.
    await page.addInitScript(() => {
      const { matchMedia } = globalThis;
      const isInstalled = (query: string) => query.includes("display-mode: standalone");
      Object.assign(globalThis, {
        matchMedia: (query: string) => matchMedia(isInstalled(query) ? "all" : query),
      });
    });
    await page.goto(`${site.url}?shared#play=0`);
    await eventually(() => inputName(page)).toBe("shared walk");
    expect(new URL(page.url()).search).toBe("");

    await page.addInitScript((bvh) => {
      const files = [{ getFile: async () => new File([bvh], "launched walk.bvh") }];
      const setConsumer = (take: (launch: object) => void) => take({ files });
      Object.defineProperty(globalThis, "launchQueue", { value: { setConsumer } });
    }, old);
    await page.reload();
    await eventually(() => inputName(page)).toBe("launched walk");
  });

  it("leaves other pages of the site to the server", async () => {
    writeFileSync(join(site.dist, "embed.html"), "<title>Another</title>");
    await page.goto(`${site.url}embed.html`);
    expect(await page.title()).toBe("Another");
  });
});
