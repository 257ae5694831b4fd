/** What axe finds: faults that shut out who does not see the page, or has no pointer. */
import axe from "axe-core";
import type { Page } from "playwright-core";

declare const window: { axe?: typeof axe };

/** One line for each kind of fault of a page, with the places. */
export async function axeFaults(page: Page, options: axe.RunOptions = {}): Promise<string[]> {
  // A script element would be against the policy of the page.
  if (!(await page.evaluate(() => window.axe !== undefined))) await page.evaluate(axe.source);
  const { violations } = await page.evaluate((given) => window.axe!.run(given), options);
  return violations.map((v) => `${v.id}: ${v.nodes.map((node) => node.target.join(" ")).join(", ")}`);
}
