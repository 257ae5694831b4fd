// npm run posters: draws the pictures of the presets, web/embed/posters/, from the built site in headless Chromium.
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { chromium } from "playwright-core";
import { preview } from "vite";
import { presets } from "./embed_page.mjs";
import { setupBrowser } from "./setup.mjs";
import { main, root, step } from "./steps.mjs";

/** CSS pixels. */
const SIZE = { width: 688, height: 300 };
/** The displayed input frame: one foot is planted, the other swings. */
const FRAME = "95";

await main(async () => {
  const { CHROME_PATH } = await setupBrowser();
  const folder = join(root, "web", "embed", "posters");
  mkdirSync(folder, { recursive: true });
  const server = await preview({
    root: join(root, "web", "app"),
    configFile: join(root, "vite.config.ts"),
    preview: { port: 0 },
  });
  const browser = await chromium.launch({ executablePath: CHROME_PATH ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
  try {
    const page = await browser.newPage({ viewport: SIZE, colorScheme: "light" });
    for (const { name, parameters } of presets())
      await step(`Picture of ${name}`, async () => {
        const { controls, autoplay, ...shown } = parameters;
        const query = new URLSearchParams({ ...shown, frame: FRAME });
        await page.goto(`${server.resolvedUrls.local[0]}embed.html?${query}`);
        await page.evaluate(async () => {
          await customElements.whenDefined("strut-player");
          await document.querySelector("strut-player").ready;
        });
        // A paused picture is refined after a moment.
        await page.waitForTimeout(3000);
        await page.screenshot({ path: join(folder, `${name}.png`) });
      });
  } finally {
    await browser.close();
    await server.close();
  }
});
