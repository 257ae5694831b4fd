/** The examples, as somebody would run them who copied a folder and installed its packages. */
import { cpSync } from "node:fs";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import { type Consumer, installPackage } from "../package/consumer";
import { serveFolder } from "../package/server";
import { root } from "../recordings";
import { drawn, launchBrowser, screenshot } from "./browser";

let browser: Browser;
let consumer: Consumer;
beforeAll(async () => {
  consumer = installPackage();
  browser = await launchBrowser();
}, 900_000);
afterAll(async () => {
  await browser.close();
  consumer.remove();
});

/** A copy of an example beside its packages. */
function copyExample(name: string): string {
  const folder = join(consumer.folder, name);
  cpSync(join(root, "examples", name), folder, { recursive: true });
  for (const name of ["strut-motion", "three"])
    cpSync(join(consumer.folder, "node_modules", name), join(folder, "node_modules", name), {
      recursive: true,
      dereference: true,
    });
  return folder;
}

/** Opens a folder's page; what it logs as an error, and what it throws, is kept. */
async function openExample(folder: string): Promise<{ page: Page; errors: string[]; close: () => Promise<void> }> {
  const server = await serveFolder(folder);
  const page = await browser.newPage({ viewport: { width: 800, height: 560 } });
  const errors: string[] = [];
  page.on("pageerror", (error) => errors.push(error.message));
  page.on("console", (line) => {
    if (["error", "warning"].includes(line.type())) errors.push(`${line.text()} (${line.location().url})`);
  });
  await page.goto(server.url);
  return { page, errors, close: () => page.close().finally(server.close) };
}

test("three-scene: a figure of its own walks, in a style and then in another", async () => {
  const { page, errors, close } = await openExample(copyExample("three-scene"));
  try {
    await page.getByRole("radio", { name: "proud" }).waitFor({ state: "attached" });
    await drawn(page, 20);
    await screenshot(page, "example-three-scene");
    // The camera goes with the figure: nothing on the page changes but by its pose.
    const before = await page.screenshot();
    await drawn(page, 5);
    expect(before.equals(await page.screenshot())).toBe(false);
    await page.getByText("old", { exact: true }).click();
    await drawn(page, 40);
    await screenshot(page, "example-three-scene-old");
    expect(await page.locator("#message").textContent()).toBe("");
    expect(errors).toEqual([]);
  } finally {
    await close();
  }
});
