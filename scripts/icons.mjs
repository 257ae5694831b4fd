// npm run icons: draws the icons of the installed page, public/icons/*.png, from icon.svg there with headless Chromium.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { chromium } from "playwright-core";
import { setupBrowser } from "./setup.mjs";
import { main, root, step } from "./steps.mjs";

const FOLDER = join(root, "public", "icons");

/**
 * Width of the picture and of the mark on it, pixels, and the background. Systems crop a maskable icon to their own
 * shape, of which only a circle of 4/5 of the width is guaranteed.
 */
const ICONS = [
  { name: "icon-192", size: 192, mark: 176, ground: "transparent" },
  { name: "icon-512", size: 512, mark: 468, ground: "transparent" },
  { name: "maskable-512", size: 512, mark: 340, ground: "#131416" },
];

await main(async () => {
  const { CHROME_PATH } = await setupBrowser();
  const svg = readFileSync(join(FOLDER, "icon.svg"), "utf8");
  const browser = await chromium.launch({ executablePath: CHROME_PATH ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
  try {
    for (const { name, size, mark, ground } of ICONS)
      await step(name, async () => {
        const page = await browser.newPage({ viewport: { width: size, height: size } });
        await page.setContent(
          `<body style="margin:0;height:100vh;display:grid;place-items:center;background:${ground}">${svg}</body>
           <style>svg { width: ${mark}px }</style>`,
        );
        await page.screenshot({ path: join(FOLDER, `${name}.png`), omitBackground: true });
      });
  } finally {
    await browser.close();
  }
});
