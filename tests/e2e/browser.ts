/** Common functions of the end-to-end tests: the built site on a server, real Chromium, and a running page. */

import { existsSync, mkdirSync, readFileSync } from "node:fs";
import { resolve } from "node:path";
import { type Browser, chromium, type Locator, type Page } from "playwright-core";
import { preview } from "vite";
import { expect } from "vitest";
import type { StrutHook } from "../../web/app/shell/hook";
import { POSE_FLOATS } from "../../web/humanoid";
import { type Graphics, recordContexts, softwareGraphics } from "./graphics";
import { slowDown } from "./slow";

const ROOT = resolve(import.meta.dirname, "../..");
/** Folder of screenshots, which git ignores. */
const OUTPUT = resolve(ROOT, "tests/output");

/**
 * Features that Chromium does not need in a test: contact with its vendor, window frames, text rendering in software
 * WebGL. Its headless shell draws letters as the whole browser does.
 */
const FLAGS = [
  "--font-render-hinting=slight",
  "--no-sandbox",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
  "--disable-gpu-rasterization",
  "--disable-features=PreloadTopChromeWebUI,WebUIReloadButton,InitialWebUI,WebUIToolbar",
];

/** Timeout for software rendering on a busy machine; failures do not wait for it. Tests that must fail need less. */
const SLOW_MS = Number(process.env.STRUT_PATIENCE_MS ?? 240_000);

/** Polls a value until an expectation holds. */
export const eventually = <T>(ask: () => T | Promise<T>, message?: string) =>
  expect.poll(ask, { timeout: SLOW_MS / 2, ...(message ? { message } : {}) });

/** The type of the page's hook inside `evaluate`. */
declare const window: { strut?: StrutHook };

/** The built site on a free port, under a folder of the host. */
export async function serveSite(folder = "/"): Promise<{ url: string; close: () => Promise<void> }> {
  if (!existsSync(resolve(ROOT, "dist/index.html"))) throw new Error("dist/ is missing; run 'npm run build' first.");
  const server = await preview({
    root: resolve(ROOT, "web/app"),
    configFile: resolve(ROOT, "vite.config.ts"),
    base: folder,
    preview: { port: 0, strictPort: false, open: false },
    logLevel: "error",
  });
  return { url: server.resolvedUrls!.local[0]!, close: () => server.close() };
}

/** Options of Chromium's start. */
export interface LaunchOptions {
  graphics?: Graphics;
  /**
   * Whether the whole browser is required, which takes twice the CPU time to load a page: for features that the
   * headless shell lacks, such as installing a page.
   */
  whole?: boolean;
}

/** Returns the browser of CHROME_PATH, or Debian's: its headless shell if that is installed and sufficient. */
function browserPath(whole: boolean): string {
  const { CHROME_PATH, CHROME_SHELL_PATH } = process.env;
  const shell = CHROME_SHELL_PATH ?? (CHROME_PATH ? undefined : "/usr/bin/chromium-headless-shell");
  return !whole && shell && existsSync(shell) ? shell : (CHROME_PATH ?? "/usr/bin/chromium");
}

/** Starts Chromium. Pages have no service worker unless requested. */
export async function launchBrowser({
  graphics = softwareGraphics(),
  whole = false,
}: LaunchOptions = {}): Promise<Browser> {
  const browser = await chromium.launch({
    executablePath: browserPath(whole),
    args: [...FLAGS, ...graphics.args],
    env: { ...process.env, ...graphics.env },
  });
  browser.on("context", (context) => context.setDefaultTimeout(SLOW_MS));
  const newContext = browser.newContext.bind(browser);
  browser.newContext = (options) => newContext({ serviceWorkers: "block", ...options });
  slowDown(browser, Number(process.env.STRUT_SLOW ?? 1));
  return browser;
}

/** Options of a page. */
export interface PageOptions {
  /** State in the URL, without `#`. */
  hash?: string;
  size?: { width: number; height: number };
  theme?: "dark" | "light";
  /** Screen pixels per CSS pixel along a side, by default half, since software draws every pixel. */
  screenPixels?: number;
  /** Whether the page has its service worker, which caches the site while a test runs. */
  serviceWorker?: boolean;
  /** Whether notes stay for minutes: on a slow machine they could otherwise disappear before the page is shown. */
  notesStay?: boolean;
}

/** Opens a page with a visible character. A script error fails the test that caused it. */
export async function openPage(browser: Browser, url: string, options: PageOptions = {}): Promise<Page> {
  const context = await browser.newContext({
    viewport: options.size ?? { width: 960, height: 640 },
    deviceScaleFactor: options.screenPixels ?? 0.5,
    colorScheme: options.theme ?? "dark",
    acceptDownloads: true,
    serviceWorkers: options.serviceWorker ? "allow" : "block",
    permissions: ["clipboard-read", "clipboard-write"],
  });
  const page = await context.newPage();
  if (options.notesStay)
    await page.addInitScript(() => {
      const later = globalThis.setTimeout;
      Object.assign(globalThis, { setTimeout: (act: () => void, ms = 0) => later(act, ms === 6000 ? 600_000 : ms) });
    });
  const errors: string[] = [];
  page.on("pageerror", (error) => errors.push(error.message));
  // Violations of the page's content security policy fail every test, too.
  await page.addInitScript(() =>
    document.addEventListener("securitypolicyviolation", ({ violatedDirective, blockedURI, sourceFile, lineNumber }) =>
      console.error(`[policy] ${violatedDirective} ${blockedURI} ${sourceFile}:${lineNumber}`),
    ),
  );
  page.on("console", (message) => {
    if (message.text().startsWith("[policy]")) errors.push(message.text());
  });
  faults.set(page, errors);
  await recordContexts(page);
  await page.goto(`${url}${options.hash ? `#${options.hash}` : ""}`);
  await shown(page);
  return page;
}

/** Waits until a loaded page shows its view, which then accepts keys, and the first frame. */
export async function shown(page: Page): Promise<void> {
  await page.waitForFunction(() => {
    const view = document.getElementById("app")?.dataset.view;
    return window.strut?.frame !== undefined && view === window.strut.state.view;
  });
}

/** Folder of the site, and the browser that shows it. */
export interface SiteOptions extends Pick<LaunchOptions, "whole"> {
  /** Folder of the host. */
  folder?: string;
}

/** Starts the browser, and serves the site below a folder of its host, for all tests of a file. `close` stops both. */
export async function launchSite({ folder = "/", whole = false }: SiteOptions = {}) {
  const [browser, site] = await Promise.all([launchBrowser({ whole }), serveSite(folder)]);
  const close = async () => {
    await browser.close();
    await site.close();
  };
  return { browser, site, close };
}

/** {@link launchSite}, and a page of it. `close` fails if a script of the page threw. */
export async function openSite({ folder = "/", whole = false, ...options }: PageOptions & SiteOptions = {}) {
  const { browser, site, close } = await launchSite({ folder, whole });
  const page = await openPage(browser, site.url, options);
  return { browser, site, page, close: () => closePage(page).finally(close) };
}

let visits = 0;

/** Puts a page into the state of a link without reloading it. */
export async function visit(page: Page, hash: string): Promise<void> {
  visits += 1;
  // The address must differ from the one before, or the browser sees no change; unknown keys are ignored.
  await page.evaluate((link) => {
    location.hash = link;
  }, `${hash}&visit=${visits}`);
  await page.waitForFunction((n) => !location.hash.includes(`visit=${n}`), visits);
}

const faults = new WeakMap<Page, string[]>();

/** Closes a page and fails if a script of it threw meanwhile. */
export async function closePage(page: Page): Promise<void> {
  await page.context().close();
  const errors = faults.get(page) ?? [];
  if (errors.length > 0) throw new Error(`The page threw: ${errors.join("; ")}`);
}

/** A point on the page, pixels. */
export interface Place {
  x: number;
  y: number;
}

/** Returns the middle of an element on the page. */
export async function middleOf(thing: Locator): Promise<Place> {
  const box = (await thing.boundingBox())!;
  return { x: box.x + box.width / 2, y: box.y + box.height / 2 };
}

/** Presses the pointer at a point and moves it to another, where it stays pressed. */
export async function dragHolding(page: Page, from: Place, to: Place): Promise<void> {
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(to.x, to.y, { steps: 10 });
}

/** {@link dragHolding}, then releases the pointer. */
export async function drag(page: Page, from: Place, to: Place): Promise<void> {
  await dragHolding(page, from, to);
  await page.mouse.up();
}

/** Returns the displayed styled pose. */
export async function styledPose(page: Page): Promise<number[]> {
  return page.evaluate(() => [...window.strut!.frame!.pose]);
}

/** Returns the mean joint angle between two poses, degrees. */
export function turnBetween(a: readonly number[], b: readonly number[]): number {
  const turns: number[] = [];
  for (let i = 3; i < POSE_FLOATS; i += 4) {
    const dot = [0, 1, 2, 3].reduce((sum, k) => sum + a[i + k]! * b[i + k]!, 0);
    turns.push((2 * Math.acos(Math.min(1, Math.abs(dot))) * 180) / Math.PI);
  }
  return turns.reduce((x, y) => x + y, 0) / turns.length;
}

/** Returns the displayed pose while paused, once the requested style and frame have arrived. */
export async function settledPose(page: Page): Promise<number[]> {
  await page.waitForFunction(() => window.strut!.upToDate);
  return styledPose(page);
}

/** Drops a file on the page, at a point of it. */
export function dropFile(
  page: Page,
  name: string,
  content: string | Uint8Array,
  at: { clientX: number; clientY: number } = { clientX: 5, clientY: 5 },
): Promise<void> {
  return dropFiles(page, { [name]: content }, at);
}

/** Drops files on the page at once. */
export async function dropFiles(
  page: Page,
  files: Readonly<Record<string, string | Uint8Array>>,
  at: { clientX: number; clientY: number } = { clientX: 5, clientY: 5 },
): Promise<void> {
  const packed = Object.entries(files).map(([name, content]) => ({
    name,
    bytes: Buffer.from(content).toString("base64"),
  }));
  const transfer = await page.evaluateHandle((packed) => {
    const transfer = new DataTransfer();
    for (const { name, bytes } of packed)
      transfer.items.add(new File([Uint8Array.from(atob(bytes), (c) => c.charCodeAt(0))], name));
    return transfer;
  }, packed);
  for (const type of ["dragenter", "dragover", "drop"])
    await page.dispatchEvent("body", type, { dataTransfer: transfer, ...at });
}

/** Exports in a format of the menu and returns the file. */
export async function saved(page: Page, format: string): Promise<{ name: string; bytes: Buffer }> {
  await page.getByRole("button", { name: "Export" }).click();
  const item = page.locator(".export-menu").getByRole("button", { name: new RegExp(`^${format}`) });
  const [download] = await Promise.all([page.waitForEvent("download"), item.click()]);
  return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
}

/** Returns whether the browser would ask before the page is left. */
export function asksBeforeLeaving(page: Page): Promise<boolean> {
  return page.evaluate(() => !dispatchEvent(new Event("beforeunload", { cancelable: true })));
}

/** Returns the name of the open input on the page. */
export function inputName(page: Page): Promise<string> {
  return page.getByLabel("Input motion").inputValue();
}

/** Waits until the page has drawn a number of frames. */
export function drawn(page: Page, pictures: number): Promise<void> {
  return page.evaluate(async (pictures) => {
    for (let i = 0; i < pictures; i++) await new Promise(requestAnimationFrame);
  }, pictures);
}

/** Saves a screenshot to tests/output. */
export async function screenshot(page: Page, name: string): Promise<void> {
  mkdirSync(OUTPUT, { recursive: true });
  await page.screenshot({ path: resolve(OUTPUT, `${name}.png`) });
}
