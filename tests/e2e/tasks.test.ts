/** Five tasks of a first-time user, with their steps counted. */
import { readFileSync } from "node:fs";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { beforeAll, describe, expect, it } from "vitest";
import type { StrutHook } from "../../web/app/shell/hook";
import { recordings } from "../recordings";
import {
  closePage,
  drag,
  dropFile,
  eventually,
  inputName,
  launchSite,
  middleOf,
  openPage,
  settledPose,
  turnBetween,
} from "./browser";

declare const window: { strut: StrutHook };

let browser: Browser;
let site: Awaited<ReturnType<typeof launchSite>>["site"];
beforeAll(async () => {
  const launched = await launchSite();
  ({ browser, site } = launched);
  return launched.close;
});

const state = (page: Page) => page.evaluate(() => window.strut.state);
const corner = (page: Page, style: string) => page.locator(`.vertex[data-style="${style}"] .vertex-dot`);

/** Does a task on a new page. `step` is one user action. */
async function task(
  max: number,
  work: (page: Page, step: <T>(action: Promise<T>) => Promise<T>) => Promise<void>,
): Promise<void> {
  const page = await openPage(browser, site.url, { size: { width: 1440, height: 900 } });
  let steps = 0;
  await work(page, (action) => {
    steps += 1;
    return action;
  });
  expect(steps).toBeLessThanOrEqual(max);
  await closePage(page);
}

/** Drags the point of the polygon to a position between two corners. */
async function dragBetween(page: Page, a: string, b: string): Promise<void> {
  const handle = page.getByRole("slider", { name: "Style", exact: true });
  const [from, to] = [await middleOf(corner(page, a)), await middleOf(corner(page, b))];
  await drag(page, await middleOf(handle), { x: (from.x + to.x) / 2, y: (from.y + to.y) / 2 });
}

const data = recordings();

describe("a first visitor", () => {
  it.skipIf(!data)("styles a BVH of their own in two steps", () =>
    task(2, async (page, step) => {
      const bvh = readFileSync(join(data!, "bandai-namco-2/dataset-2_walk_normal_001.bvh"));
      await step(dropFile(page, "mine.bvh", bvh));
      await eventually(() => inputName(page)).toBe("mine");
      await step(corner(page, "old").dblclick());
      // The same instant, in that style and in the one before.
      await page.keyboard.press("Space");
      const old = await settledPose(page);
      await page.keyboard.press("Control+z");
      expect(turnBetween(old, await settledPose(page))).toBeGreaterThan(3);
    }),
  );

  it("mixes two styles in one step", () =>
    task(1, async (page, step) => {
      await step(dragBetween(page, "proud", "childlike"));
      const weight = async (name: string) => (await state(page)).styles.find((s) => s.name === name)?.weight;
      await eventually(() => weight("proud")).toBeCloseTo(0.5, 1);
      await eventually(() => weight("childlike")).toBeCloseTo(0.5, 1);
    }));

  it("makes only the legs old in two steps", () =>
    task(2, async (page, step) => {
      const knee = () => page.evaluate(() => window.strut.jointScreenPosition("left_lower_leg"));
      // A walking leg moves between a query and a click.
      const tryClick = async () => {
        const at = await knee();
        await page.mouse.click(at.x, at.y);
        return (await state(page)).part;
      };
      await step(eventually(tryClick).toBe("legs"));
      await step(corner(page, "old").dblclick());
      const legs = async () => (await state(page)).parts.legs;
      await eventually(async () => (await legs())?.find((s) => s.name === "old")?.weight).toBe(1);
      const { styles } = await state(page);
      expect(styles.find((s) => s.name === "old")?.weight).toBeLessThan(0.5);
    }));

  it("exports to their tool in two steps", () =>
    task(2, async (page, step) => {
      await page.waitForFunction(() => window.strut.analysed);
      await step(page.getByRole("button", { name: "Export" }).click());
      const item = page.locator(".export-menu").getByRole("button", { name: /^BVH/ });
      const [download] = await step(Promise.all([page.waitForEvent("download"), item.click()]));
      expect(download.suggestedFilename()).toMatch(/\.bvh$/);
      expect(readFileSync(await download.path(), "utf8")).toMatch(/^HIERARCHY/);
    }));

  it("shares what they see in one step", () =>
    task(1, async (page, step) => {
      await corner(page, "old").dblclick();
      await page.keyboard.press("Space");
      const pose = await settledPose(page);
      await step(page.getByRole("button", { name: "Share" }).click());
      const copied = () => page.evaluate(() => navigator.clipboard.readText());
      // The address bar has the instant of the pause after a moment.
      await eventually(async () => (await copied()) === page.url()).toBe(true);
      const link = await copied();
      const other = await openPage(browser, link);
      // A paused walk is between two frames, and so is the one in the link.
      expect(turnBetween(pose, await settledPose(other))).toBeLessThan(0.2);
      await closePage(other);
    }));
});
