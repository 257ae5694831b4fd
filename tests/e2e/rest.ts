/** Waits until the page has settled, instead of pauses of a fixed length. */
import type { Page } from "playwright-core";
import { drawn, eventually, type Place } from "./browser";

/** Waits until an animated element has stopped: its position is the same over five display frames. */
export async function atRest(page: Page, place: () => Promise<Place>): Promise<void> {
  let before = await place();
  await eventually(async () => {
    await drawn(page, 5);
    const now = await place();
    const moved = Math.hypot(now.x - before.x, now.y - before.y);
    before = now;
    return moved;
  }).toBeLessThan(0.1);
}

/** Sets the system's theme, and waits until the page has it. */
export async function showTheme(page: Page, theme: "dark" | "light"): Promise<void> {
  await page.emulateMedia({ colorScheme: theme });
  await page.waitForFunction((theme) => document.documentElement.dataset.theme === theme, theme);
  await transitionsEnded(page);
}

/** Waits until all CSS transitions have ended, such as those between the themes. */
export async function transitionsEnded(page: Page): Promise<void> {
  await page.evaluate(() => {
    const transitions = document.getAnimations().filter((animation) => animation instanceof CSSTransition);
    return Promise.allSettled(transitions.map(({ finished }) => finished)).then(() => undefined);
  });
}
