/** Requirements of a view on a narrow screen. */
import type { Page } from "playwright-core";
import { expect } from "vitest";
import { axeFaults } from "./axe";
import { eventually } from "./browser";

/** Makes the screen narrow and expects that everything fits, is accessible, and that fingers hit the controls. */
export async function expectFitsNarrow(page: Page, controls: string): Promise<void> {
  await page.setViewportSize({ width: 390, height: 844 });
  await eventually(() => page.evaluate(() => document.documentElement.scrollWidth)).toBe(390);
  await eventually(() => axeFaults(page)).toEqual([]);
  const boxes = await Promise.all((await page.locator(controls).all()).map((control) => control.boundingBox()));
  const shown = boxes.filter((box) => box !== null);
  expect(shown.length).toBeGreaterThan(0);
  for (const { width, height } of shown) expect(Math.min(width, height)).toBeGreaterThanOrEqual(44);
}
