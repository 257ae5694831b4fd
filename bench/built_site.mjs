// The built site in Chromium, which draws in software: what measurements of the page begin with.
import { existsSync } from "node:fs";
import { resolve } from "node:path";
import { chromium } from "playwright-core";
import { preview } from "vite";
import { root, Sentence } from "../scripts/steps.mjs";

const FLAGS = [
  "--no-sandbox",
  "--use-angle=swiftshader",
  "--enable-unsafe-swiftshader",
  "--disable-background-networking",
];

/** Serves `dist/` and opens a browser for as long as `use(browser, url)` takes. */
export async function onBuiltSite(use) {
  if (!existsSync(resolve(root, "dist/index.html"))) throw new Sentence("dist/ is missing; run 'npm run build' first.");
  const server = await preview({
    root: resolve(root, "web/app"),
    configFile: resolve(root, "vite.config.ts"),
    preview: { port: 0, strictPort: false, open: false },
    logLevel: "error",
  });
  try {
    const browser = await chromium.launch({
      executablePath: process.env.CHROME_PATH ?? "/usr/bin/chromium",
      args: FLAGS,
    });
    try {
      return await use(browser, server.resolvedUrls.local[0]);
    } finally {
      await browser.close();
    }
  } finally {
    await server.close();
  }
}
