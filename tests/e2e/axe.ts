/** Accessibility faults that axe finds. */
import axe from "axe-core";
import type { Page } from "playwright-core";

declare const window: { axe?: typeof axe };

/** Returns one line per kind of fault of a page, with the elements. */
export async function axeFaults(page: Page, options: axe.RunOptions = {}): Promise<string[]> {
  // The page's policy forbids a script element.
  if (!(await page.evaluate(() => window.axe !== undefined))) await page.evaluate(axe.source);
  const { violations } = await page.evaluate((given) => window.axe!.run(given), options);
  return violations.map((v) => `${v.id}: ${v.nodes.map((node) => node.target.join(" ")).join(", ")}`);
}
