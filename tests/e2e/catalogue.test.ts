/** Public data sets: fetched from a local server that serves the recordings, kept, and used. */
import { readFileSync } from "node:fs";
import { createServer, type Server } from "node:http";
import type { AddressInfo } from "node:net";
import { basename, join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { recordings } from "../recordings";
import { closePage, eventually, launchBrowser, openPage, screenshot, serveSite } from "./browser";

const data = recordings();
const CLIPS = ["active", "elderly", "normal"].flatMap((style) =>
  [1, 2].map((take) => `dataset-2_walk_${style}_00${take}.bvh`),
);

let browser: Browser;
let site: Awaited<ReturnType<typeof serveSite>>;
let server: Server;
/** Whether the server lets other pages read, and after how many files it stops answering. */
const host = { open: true, most: Number.POSITIVE_INFINITY, asked: 0 };

beforeAll(async () => {
  if (!data) return;
  [browser, site] = await Promise.all([launchBrowser(), serveSite()]);
  server = createServer((request, response) => {
    host.asked += 1;
    if (host.open) response.setHeader("Access-Control-Allow-Origin", "*");
    if (host.asked > host.most) return;
    response.end(readFileSync(join(data, "bandai-namco-2", basename(request.url!))));
  });
  await new Promise<void>((resolve) => server.listen(0, "127.0.0.1", resolve));
});
afterAll(async () => {
  await browser?.close();
  await site?.close();
  server?.close();
});

/** A page whose catalogue names one set on the local server. */
async function open(): Promise<Page> {
  const page = await openPage(browser, site.url, { size: { width: 1440, height: 900 } });
  const { port } = server.address() as AddressInfo;
  const set = {
    id: "small",
    name: "Small set",
    about: "walking in three styles",
    licence: { name: "CC BY-NC 4.0", url: "https://creativecommons.org/licenses/by-nc/4.0/", note: "Credit it." },
    citation: "Nobody, 2026",
    page: "https://example.org/set",
    bytes: 0,
    base: `http://127.0.0.1:${port}/`,
    files: CLIPS,
    pattern: "{any}_{action}_{style}_{take}.bvh",
  };
  await page.route("**/catalog.json", (route) => route.fulfill({ json: { version: 1, sets: [set] } }));
  await page.getByRole("link", { name: "Data" }).click();
  return page;
}

const note = (page: Page) => page.locator(".catalogue [role=status].caption").textContent();

describe.skipIf(!data)("a public data set", () => {
  it("is fetched after its licence was shown, goes on where it was cancelled, and is kept", async () => {
    const page = await open();
    await page.getByRole("button", { name: "Get Small set" }).click();
    const licence = page.getByRole("dialog", { name: "Small set" });
    expect(await licence.textContent()).toContain("Licence: CC BY-NC 4.0. Credit it.");
    expect(host.asked, "nothing is fetched before").toBe(0);
    await screenshot(page, "catalogue-licence");
    host.most = 3;
    await licence.getByRole("button", { name: "Download" }).click();
    await eventually(() => page.locator(".catalogue .progress").textContent()).toContain("3 files of 6");
    await page.locator(".catalogue").getByRole("button", { name: "Cancel" }).click();
    host.most = Number.POSITIVE_INFINITY;
    await page.getByRole("button", { name: "Go on Small set" }).click();
    await licence.getByRole("button", { name: "Download" }).click();
    await eventually(() => page.locator(".data-clips h1").textContent()).toBe("6 clips, 3 styles");
    expect(await note(page)).toBe("Cite it as: Nobody, 2026.");
    await screenshot(page, "catalogue");

    await page.reload();
    host.most = 0;
    await page.getByRole("button", { name: "Use Small set" }).click();
    await eventually(() => page.locator(".data-clips h1").textContent()).toBe("6 clips, 3 styles");
    await page.getByRole("button", { name: "Delete Small set" }).click();
    await page.getByRole("button", { name: "Get Small set" }).waitFor();
    await closePage(page);
  });

  it("whose host refuses other pages is said to do so", async () => {
    host.open = false;
    host.most = Number.POSITIVE_INFINITY;
    const page = await open();
    await page.getByRole("button", { name: "Get Small set" }).click();
    await page.getByRole("button", { name: "Download" }).click();
    await eventually(() => note(page)).toMatch(
      /^127\.0\.0\.1:\d+ cannot be reached, or does not let other pages read its files\. Get the files from https:\/\/example\.org\/set and drop them here\.$/,
    );
    await closePage(page);
  });
});
