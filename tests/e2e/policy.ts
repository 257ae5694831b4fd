/** Violations of a page's content security policy. */
import type { BrowserContext, Page } from "playwright-core";
import { expect } from "vitest";
import { eventually } from "./browser";

declare const window: { violations: string[] };

/** Records violations of the policies of a context's pages from now on. */
export function recordViolations(context: BrowserContext): Promise<unknown> {
  return context.addInitScript(() => {
    const violations: string[] = [];
    Object.assign(window, { violations });
    document.addEventListener("securitypolicyviolation", (event) =>
      violations.push(`${event.violatedDirective} ${event.blockedURI} ${event.sourceFile}:${event.lineNumber}`),
    );
  });
}

/** Expects that a page has a policy, and that it was not violated. */
export async function expectNoViolation(page: Page): Promise<void> {
  expect(await page.evaluate(() => window.violations)).toEqual([]);
  // A style attribute violates the policy: this shows that violations are recorded.
  await page.evaluate(() => document.body.setAttribute("style", "color: red"));
  await eventually(() => page.evaluate(() => window.violations.length)).toBe(1);
}
