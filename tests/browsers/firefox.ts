/** Firefox, driven over WebDriver BiDi. */
import { existsSync } from "node:fs";
import puppeteer, { type KeyInput } from "puppeteer-core";
import { type BrowserPage, DRAG_STEPS, SIZE } from "./page";

/** Path in Debian's package `firefox-esr`. */
const DEBIAN = "/usr/bin/firefox-esr";

/** Path of the browser; `undefined` if it is missing. */
export const firefoxPath = [process.env.FIREFOX_PATH, DEBIAN].find((path) => path && existsSync(path));

export async function launchFirefox(): Promise<BrowserPage> {
  const browser = await puppeteer.launch({
    browser: "firefox",
    executablePath: firefoxPath!,
    // Without a window Firefox has no WebGL on a machine without a GPU.
    headless: false,
    protocolTimeout: 240_000,
    env: { ...process.env, LIBGL_ALWAYS_SOFTWARE: "1" },
  });
  const page = await browser.newPage();
  await page.setViewport(SIZE);
  return {
    browser: await browser.version(),
    open: async (url) => {
      await page.goto(url);
    },
    evaluate: (work, ...args) => page.evaluate(work as (...args: unknown[]) => never, ...args),
    click: ({ x, y }, times = 1) => page.mouse.click(x, y, { count: times }),
    drag: async ({ from, to }) => {
      await page.mouse.move(from.x, from.y);
      await page.mouse.down();
      await page.mouse.move(to.x, to.y, { steps: DRAG_STEPS });
      await page.mouse.up();
    },
    press: (key) => page.keyboard.press(key as KeyInput),
    picture: () => page.screenshot(),
    close: () => browser.close(),
  };
}
