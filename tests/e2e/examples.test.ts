/** The examples as users run them: a copied folder with its packages installed. */
import { cpSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { build as esbuild } from "esbuild";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import type { StrutPlayer } from "../../web/element";
import { type Consumer, installPackage, styledByNode } from "../package/consumer";
import { serveFolder } from "../package/server";
import { root } from "../recordings";
import { drawn, eventually, launchBrowser, screenshot } from "./browser";

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

/** The notebook page's view of Python's object. */
interface FakeModel {
  traits: Record<string, unknown>;
  set(name: string, value: unknown): void;
}

declare const window: { model: FakeModel; saved: string[]; cleanUp: () => void };

/** Copies an example next to its packages. */
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

/** Opens a folder's page, and records its logged and thrown errors. */
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

/** Returns the styles of the page's player. */
const stylesOf = (page: Page) =>
  page.locator("strut-player").evaluate(async (found) => {
    const player = found as StrutPlayer;
    await player.ready;
    return player.styles;
  });

test("plain: an article's figure walks, and takes the styles of its buttons", async () => {
  const { page, errors, close } = await openExample(copyExample("plain"));
  try {
    expect(await stylesOf(page)).toEqual({ proud: 0.6, old: 0.15, childlike: 0.25 });
    await page.getByRole("button", { name: "childlike", exact: true }).first().click();
    await eventually(() => stylesOf(page)).toEqual({ childlike: 1 });
    await page.getByRole("slider", { name: "Style" }).press("ArrowUp");
    await screenshot(page, "example-plain");
    await eventually(() => page.locator("#manner").textContent()).toBe("mostly childlike");
    expect(errors.filter((line) => !line.includes("KHR_parallel"))).toEqual([]);
  } finally {
    await close();
  }
});

test("react: the player follows React's state, and React the visitor", async () => {
  const folder = copyExample("react");
  for (const name of ["react", "react-dom", "scheduler"])
    cpSync(join(root, "node_modules", name), join(folder, "node_modules", name), { recursive: true });
  await esbuild({
    entryPoints: [join(folder, "main.jsx")],
    outfile: join(folder, "bundle.js"),
    bundle: true,
    format: "esm",
    jsx: "automatic",
    logLevel: "error",
  });
  cpSync(join(folder, "node_modules", "strut-motion", "assets"), join(folder, "assets"), { recursive: true });
  const { page, errors, close } = await openExample(folder);
  try {
    expect(await stylesOf(page)).toEqual({ proud: 1 });
    await page.getByRole("button", { name: "half of each" }).click();
    await eventually(() => stylesOf(page)).toEqual({ proud: 0.5, old: 0.5 });
    await page.getByRole("slider", { name: "Style" }).press("ArrowDown");
    await eventually(async () => (await stylesOf(page)).old).toBeGreaterThan(0.5);
    const { old } = await stylesOf(page);
    await eventually(() => page.locator("output").textContent()).toContain(`old ${old!.toFixed(2)}`);
    await screenshot(page, "example-react");
    expect(errors.filter((line) => !line.includes("KHR_parallel"))).toEqual([]);
  } finally {
    await close();
  }
});

test("three-scene: a figure of its own walks, in a style and then in another", async () => {
  const { page, errors, close } = await openExample(copyExample("three-scene"));
  try {
    await page.getByRole("radio", { name: "proud" }).waitFor({ state: "attached" });
    await drawn(page, 20);
    await screenshot(page, "example-three-scene");
    // The camera follows the figure, and nothing moves behind its head and arms.
    const upperBody = () => page.screenshot({ clip: { x: 250, y: 20, width: 300, height: 200 } });
    const before = await upperBody();
    await eventually(async () => before.equals(await upperBody())).toBe(false);
    await page.getByText("old", { exact: true }).click();
    await drawn(page, 40);
    await screenshot(page, "example-three-scene-old");
    await eventually(() => page.locator("#message").textContent()).toBe("");
    expect(errors).toEqual([]);
  } finally {
    await close();
  }
});

/** anywidget's part of a widget: it imports the module from a blob, and passes it a model and an element. */
const NOTEBOOK = `<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,"><body style="font: 14px sans-serif"><script type="module">
const listeners = [];
window.saved = [];
window.model = {
  traits: { source: await (await fetch("/walk.bvh")).text(), styles: { proud: 1 }, frame: 5, bvh: new DataView(new ArrayBuffer(0)) },
  get: (name) => window.model.traits[name],
  set(name, value) {
    window.model.traits[name] = value;
    for (const [names, listener] of listeners) if (names.split(" ").includes("change:" + name)) listener();
  },
  on: (names, listener) => listeners.push([names, listener]),
  off: (names, listener) => listeners.splice(listeners.findIndex(([, other]) => other === listener), 1),
  save_changes: () => window.saved.push(new TextDecoder().decode(window.model.traits.bvh)),
};
const text = await (await fetch("/strut_widget.js")).text();
const module = await import(URL.createObjectURL(new Blob([text], { type: "text/javascript" })));
const el = document.body.appendChild(document.createElement("div"));
window.cleanUp = await module.default.render({ model: window.model, el });
</script>`;

test("jupyter: the widget shows a walk, styles it anew as Python asks, and gives its BVH", async () => {
  const folder = copyExample("jupyter");
  await esbuild({
    entryPoints: [join(folder, "index.js")],
    outfile: join(folder, "strut_widget.js"),
    bundle: true,
    format: "esm",
    loader: { ".bin": "binary" },
    logLevel: "error",
  });
  writeFileSync(join(folder, "index.html"), NOTEBOOK);
  cpSync(join(consumer.folder, "walk.bvh"), join(folder, "walk.bvh"));
  const { page, errors, close } = await openExample(folder);
  try {
    await page.waitForFunction(() => window.cleanUp !== undefined);
    const saved = () => page.evaluate(() => window.saved);
    const byNode = styledByNode(consumer);
    await eventually(async () => (await saved()).map((text) => text === byNode)).toEqual([true]);
    await screenshot(page, "example-jupyter");

    const before = await page.screenshot();
    await page.evaluate(() => window.model.set("frame", 20));
    await eventually(async () => before.equals(await page.screenshot())).toBe(false);
    await eventually(() => page.getByRole("slider").inputValue()).toBe("20");

    // Two changes at once: only the last one is styled completely.
    await page.evaluate(() => {
      window.model.set("styles", { angry: 1 });
      window.model.set("styles", { old: 1 });
    });
    await page.waitForFunction(() => window.saved.length === 2);
    await screenshot(page, "example-jupyter-old");
    const [proud, old] = await saved();
    expect(old === proud).toBe(false);

    await page.evaluate(() => window.model.set("styles", { nobody: 1 }));
    await page.getByText("nobody").waitFor();
    await page.evaluate(() => window.cleanUp());
    await page.evaluate(() => window.model.set("styles", { proud: 1 }));
    expect(await saved()).toHaveLength(2);
    expect(errors).toEqual([]);
  } finally {
    await close();
  }
});
