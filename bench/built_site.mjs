// The built site in Chromium, which draws in software: what measurements of the page begin with.
import { existsSync } from "node:fs";
import { createServer } from "node:net";
import { resolve } from "node:path";
import { chromium } from "playwright-core";
import { preview } from "vite";
import { root, Sentence } from "../scripts/steps.mjs";

/** What every measurement of the page starts Chromium with. */
export const FLAGS = [
  "--no-sandbox",
  "--use-angle=swiftshader",
  "--enable-unsafe-swiftshader",
  "--disable-background-networking",
];

/** Starts Chromium, with `flags` beside those that every measurement needs. */
export function launchChromium(flags = []) {
  return chromium.launch({
    executablePath: process.env.CHROME_PATH ?? "/usr/bin/chromium",
    args: [...FLAGS, ...flags],
  });
}

/** A port that nothing listens on. */
export function freePort() {
  return new Promise((resolve) => {
    const server = createServer().listen(0, "localhost", () => {
      const { port } = server.address();
      server.close(() => resolve(port));
    });
  });
}

/** Says so where `dist/` is not built. */
export function requireBuiltSite() {
  if (!existsSync(resolve(root, "dist/index.html"))) throw new Sentence("dist/ is missing; run 'npm run build' first.");
}

/** Serves `dist/` on a free port; Vite's server. */
export function serveBuiltSite() {
  requireBuiltSite();
  return preview({
    root: resolve(root, "web/app"),
    configFile: resolve(root, "vite.config.ts"),
    preview: { port: 0, strictPort: false, open: false },
    logLevel: "error",
  });
}

/** Serves `dist/` and opens a browser for as long as `use(browser, url)` takes. */
export async function onBuiltSite(use) {
  const server = await serveBuiltSite();
  try {
    const browser = await launchChromium();
    try {
      return await use(browser, server.resolvedUrls.local[0]);
    } finally {
      await browser.close();
    }
  } finally {
    await server.close();
  }
}
