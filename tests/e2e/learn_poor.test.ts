/** The Learn view in browsers with missing features. */
import type { Page } from "playwright-core";
import { expect, it } from "vitest";
import { LESSONS } from "../../web/lessons/lessons";
import { eventually, openSite, visit } from "./browser";

/** Reloads the page, after a script that removes a feature of the browser. */
async function without(take: () => void, hash: string, use: (page: Page) => Promise<void>): Promise<void> {
  const { page, close } = await openSite({ hash: "view=data&play=0", size: { width: 1440, height: 900 } });
  await page.addInitScript(take);
  await page.evaluate((link) => {
    location.hash = link;
  }, hash);
  await page.reload();
  try {
    await use(page);
  } finally {
    await close();
  }
}

const verdict = (page: Page, exercise: string) => page.locator(`[data-exercise="${exercise}"] .verdict`).textContent();

const noWebGl = () => {
  const { getContext } = HTMLCanvasElement.prototype;
  HTMLCanvasElement.prototype.getContext = function (this: HTMLCanvasElement, kind: string, ...rest: unknown[]) {
    return kind.startsWith("webgl") ? null : Reflect.apply(getContext, this, [kind, ...rest]);
  } as typeof getContext;
};

it("needs no WebGL: text, tables and exercises are there, and other views lead to it", async () => {
  await without(noWebGl, "view=play&play=0", async (page) => {
    await eventually(() => page.locator("h1.learn-title").textContent()).toBe("Tell content from style");
    await eventually(() => page.getByText("The lessons still work, without 3D.").count()).toBeGreaterThan(0);
    await visit(page, "view=learn&lesson=style&beat=4&task=C&joint=head");
    await eventually(() => verdict(page, "C")).toMatch(/^✓ ?Yes: head, by 32\.01 cm/);
    const stage = page.locator('strut-figure[data-name="stage"]');
    await eventually(() => stage.locator(".picture .message").textContent()).toMatch(/^This browser cannot draw in 3D/);
    await stage.locator("summary").click();
    await eventually(() => stage.locator("td").count()).toBeGreaterThan(20);
    await visit(page, "view=walk");
    await eventually(() => page.evaluate(() => location.hash)).toContain("view=learn");
  });
});

it("explains every lesson without WebGL: its symbols have values, and each figure says what it would show", async () => {
  await without(noWebGl, "view=learn&lesson=style", async (page) => {
    for (const { id } of LESSONS) {
      await visit(page, `view=learn&lesson=${id}&beat=2`);
      await eventually(() => page.locator(".lessons select").inputValue()).toBe(id);
      const skip = page.locator(".lock:not([hidden])").getByRole("button", { name: "Skip the bet" });
      if (await skip.isVisible()) await skip.click();
      const unsaid = () =>
        page
          .locator("strut-figure:not([hidden]) [role=status]")
          .evaluateAll((all) => all.filter((said) => said.textContent!.length < 10).length);
      await eventually(unsaid, id).toBe(0);
      const values = () => page.locator(".learn-symbols .symbol .value").allTextContents();
      await eventually(async () => (await values()).filter((value) => value.trim() === ""), id).toEqual([]);
      await eventually(() => page.locator(".learn-text .katex").count(), id).toBeGreaterThan(0);
    }
    expect(await page.locator(".toast.error").count()).toBe(0);
  });
});

it("needs no storage: it says so, and progress lasts until the page is closed", async () => {
  const take = () => {
    Object.defineProperty(window, "localStorage", {
      get: () => {
        throw new DOMException("The operation is insecure.", "SecurityError");
      },
    });
  };
  await without(take, "view=learn&lesson=style&beat=4&task=C&joint=head", async (page) => {
    await eventually(() => verdict(page, "C")).toMatch(/^✓ ?Yes: head/);
    await visit(page, "view=learn&lesson=style&beat=3");
    await eventually(() => page.locator(".learn-text").textContent()).toContain(
      "This browser does not store data for the page",
    );
  });
});
