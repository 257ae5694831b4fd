/** What the content security policy of a page blocked. */
import type { BrowserContext, Page } from "playwright-core";
import { expect } from "vitest";
import { eventually } from "./browser";

declare const window: { violations: string[] };

/** Records from now on what the policies of a context's pages block. */
export function recordViolations(context: BrowserContext): Promise<unknown> {
  return context.addInitScript(() => {
    const violations: string[] = [];
    Object.assign(window, { violations });
    document.addEventListener("securitypolicyviolation", (event) =>
      violations.push(`${event.violatedDirective} ${event.blockedURI} ${event.sourceFile}:${event.lineNumber}`),
    );
  });
}

/** Expects that a page has a policy, and that nothing was against it. */
export async function expectNoViolation(page: Page): Promise<void> {
  expect(await page.evaluate(() => window.violations)).toEqual([]);
  // A style attribute is against the policy: this shows that violations are recorded.
  await page.evaluate(() => document.body.setAttribute("style", "color: red"));
  await eventually(() => page.evaluate(() => window.violations.length)).toBe(1);
}
