// The built site in Chromium with software rendering, for measurements of the page.
import { existsSync } from "node:fs";
import { createServer } from "node:net";
import { resolve } from "node:path";
import { chromium } from "playwright-core";
import { preview } from "vite";
import { root, Sentence } from "../scripts/steps.mjs";

/**
 * Flags of Chromium without a GPU: it draws text and panels without one, and only WebGL with SwiftShader.
 */
const NO_CARD = ["--no-sandbox", "--enable-unsafe-swiftshader", "--disable-background-networking"];

/** The same flags with SwiftShader in place of a GPU: it draws the whole page, and compiles its shaders first. */
export const FLAGS = [...NO_CARD, "--use-angle=swiftshader"];

/** Starts Chromium as on a machine without a GPU. */
export function launchWithoutCard() {
  return start(NO_CARD);
}

/** Starts Chromium with SwiftShader as its GPU, and with `flags`. */
export function launchChromium(flags = []) {
  return start([...FLAGS, ...flags]);
}

function start(args) {
  return chromium.launch({
    executablePath: process.env.CHROME_PATH ?? "/usr/bin/chromium",
    args,
  });
}

/** Returns an unused port. */
export function freePort() {
  return new Promise((resolve) => {
    const server = createServer().listen(0, "localhost", () => {
      const { port } = server.address();
      server.close(() => resolve(port));
    });
  });
}

/** Throws a message if `dist/` is not built. */
export function requireBuiltSite() {
  if (!existsSync(resolve(root, "dist/index.html"))) throw new Sentence("dist/ is missing; run 'npm run build' first.");
}

/** Serves `dist/` on a free port. Returns Vite's server. */
export function serveBuiltSite() {
  requireBuiltSite();
  return preview({
    root: resolve(root, "web/app"),
    configFile: resolve(root, "vite.config.ts"),
    preview: { port: 0, strictPort: false, open: false },
    logLevel: "error",
  });
}

/** Serves `dist/` and opens a browser for the duration of `use(browser, url)`. */
export async function onBuiltSite(use, launch = launchChromium) {
  const server = await serveBuiltSite();
  try {
    const browser = await launch();
    try {
      return await use(browser, server.resolvedUrls.local[0]);
    } finally {
      await browser.close();
    }
  } finally {
    await server.close();
  }
}
