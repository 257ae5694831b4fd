/**
 * Common requirements of the Walk and Key-style views: they show the model of the currently open database, whatever
 * happens during training, and release their resources when they are hidden.
 */
import type { Page } from "playwright-core";
import { beforeAll, describe, it } from "vitest";
import type { StrutHook } from "../../web/app/shell/hook";
import { walksIn } from "../clips";
import { databaseOf } from "../database_of";
import { dropFile, eventually, openSite, visit } from "./browser";

declare const window: {
  strut: StrutHook;
  /** WebGL contexts made since {@link watchResources}, and active size observers. */
  contexts: WebGL2RenderingContext[];
  observers: Set<ResizeObserver>;
};

let page: Page;
let walks: Record<"neutral" | "old" | "proud", string>;

beforeAll(async () => {
  const [opened, made] = await Promise.all([
    openSite({ size: { width: 1440, height: 900 } }),
    walksIn(["neutral", "old", "proud"]),
  ]);
  [page, walks] = [opened.page, made];
  return opened.close;
});

const vertices = (root: string) =>
  page.locator(`${root} .vertex`).evaluateAll((all) => all.map((one) => one.getAttribute("data-style")).sort());
const goTo = (name: string) => page.getByRole("link", { name, exact: true }).click();
const input = () => page.evaluate(() => window.strut.state.input);

/** Drops a database and waits until Play shows its styles. */
async function open(name: string, file: Uint8Array, styles: readonly string[]): Promise<void> {
  await dropFile(page, name, file);
  await eventually(() => vertices(".panels")).toEqual(styles);
  await eventually(() => page.evaluate(() => window.strut.analysed)).toBe(true);
}

/** Prevents training workers from starting until the result is called. */
async function holdTraining(): Promise<() => void> {
  let release = () => {};
  const released = new Promise<void>((resolve) => {
    release = resolve;
  });
  await page.route("**/build_worker-*.js", async (route) => {
    await released;
    // The page may have discarded the worker meanwhile.
    await route.continue().catch(() => {});
  });
  return release;
}

/** Number of walk models that are kept on this device. */
const modelsKept = () =>
  page.evaluate(
    () =>
      new Promise<number>((resolve, reject) => {
        const opening = indexedDB.open("strut-walks", 1);
        opening.onerror = () => reject(opening.error);
        opening.onsuccess = () => {
          const counting = opening.result.transaction("models").objectStore("models").count();
          counting.onsuccess = () => resolve(counting.result);
          opening.result.close();
        };
      }),
  );

describe("the Walk view", () => {
  it("shows the model of the open database, though a motion is opened while it is trained", async () => {
    await goTo("Walk");
    await eventually(() => vertices(".walk-panel")).toHaveLength(8);
    const file = await databaseOf({ "walk_neutral_1.bvh": walks.neutral, "walk_old_1.bvh": walks.old });
    await open("two.strutdb", file, ["neutral", "old"]);
    const release = await holdTraining();
    await goTo("Walk");
    await eventually(() => page.locator(".walk .stage-title").textContent()).toBe("Training the walk model.");
    await dropFile(page, "other.bvh", walks.proud);
    await eventually(input).toBe("other");
    release();
    await eventually(() => vertices(".walk-panel")).toEqual(["neutral", "old"]);
    await eventually(() => page.locator(".walk .stage-title").textContent()).toMatch(/ steps, /);
    await eventually(() => page.locator(".toasts").textContent()).toMatch(/Trained 2 styles from 2 clips in/);
    await eventually(modelsKept).toBe(1);
  });

  it("shows the database that was opened last, though the one before is still being trained on", async () => {
    const release = await holdTraining();
    const three = { "walk_neutral_1.bvh": walks.neutral, "walk_old_1.bvh": walks.old, "walk_proud_1.bvh": walks.proud };
    await open("three.strutdb", await databaseOf(three), ["neutral", "old", "proud"]);
    await goTo("Walk");
    await eventually(() => page.locator(".walk .stage-title").textContent()).toBe("Training the walk model.");
    const file = await databaseOf({ "walk_neutral_1.bvh": walks.neutral, "walk_proud_1.bvh": walks.proud });
    await open("other.strutdb", file, ["neutral", "proud"]);
    await goTo("Walk");
    release();
    await eventually(() => vertices(".walk-panel")).toEqual(["neutral", "proud"]);
  });
});

describe("the Key-style view", () => {
  const recorded = () => page.locator(".recordings-clip option").allTextContents();

  it("learns a database anew that was built again under its name", async () => {
    await open("mine.strutdb", await databaseOf({ "walk_neutral_1.bvh": walks.neutral, "walk_old_1.bvh": walks.old }), [
      "neutral",
      "old",
    ]);
    await goTo("Key-style");
    await page.getByLabel("Training motions").selectOption("open/walk");
    await eventually(recorded).toEqual(["walk neutral 1"]);
    const file = await databaseOf({ "walk_neutral_7.bvh": walks.neutral, "walk_proud_1.bvh": walks.proud });
    await open("mine.strutdb", file, ["neutral", "proud"]);
    await goTo("Key-style");
    await eventually(recorded).toEqual(["walk neutral 7"]);
  });

  it("learns files anew that are dropped again under their name", async () => {
    const last = () => page.getByRole("slider", { name: "Time in the recording" }).getAttribute("aria-valuemax");
    await page.locator('.key-style [aria-label="Below the pad"] label').filter({ hasText: "Recordings" }).click();
    await dropFile(page, "mine.bvh", walks.old);
    await eventually(recorded).toEqual(["mine"]);
    await eventually(last).toBe("74");
    const [longer] = Object.values(await walksIn(["old"], 240));
    await dropFile(page, "mine.bvh", longer!);
    await eventually(last).toBe("119");
  });
});

describe("a view that is hidden", () => {
  /** Records the WebGL contexts and the size observers that the page creates from now on. */
  const watchResources = () =>
    page.evaluate(() => {
      window.contexts = [];
      window.observers = new Set();
      const { getContext } = HTMLCanvasElement.prototype;
      HTMLCanvasElement.prototype.getContext = function (this: HTMLCanvasElement, ...args: unknown[]) {
        const context = (getContext as (...args: unknown[]) => unknown).apply(this, args);
        if (context instanceof WebGL2RenderingContext) window.contexts.push(context);
        return context;
      } as typeof getContext;
      const { observe, disconnect } = ResizeObserver.prototype;
      ResizeObserver.prototype.observe = function (...args) {
        window.observers.add(this);
        observe.apply(this, args);
      };
      ResizeObserver.prototype.disconnect = function () {
        window.observers.delete(this);
        disconnect.apply(this);
      };
    });
  const liveContexts = () =>
    page.evaluate(() => new Set(window.contexts.filter((context) => !context.isContextLost())).size);
  const liveObservers = () => page.evaluate(() => window.observers.size);

  it.for([
    { view: "walk", hash: "view=walk&strip=1&play=0", canvas: ".walk-strip canvas" },
    { view: "key-style", hash: "view=key-style&between=all&play=0", canvas: ".comparison canvas" },
    { view: "crowd", hash: "view=crowd&crowd=10_1&play=0", canvas: ".crowd .editor-stage canvas" },
  ])("$view: releases its WebGL context and its observers, and shows them again", async ({ hash, canvas }) => {
    await watchResources();
    for (let visits = 0; visits < 2; visits++) {
      await visit(page, hash);
      await eventually(() => page.locator(canvas).count()).toBe(1);
      await eventually(liveContexts).toBe(1);
      await eventually(liveObservers).toBeGreaterThan(0);
      await goTo("Play");
      await eventually(liveContexts).toBe(0);
      await eventually(liveObservers).toBe(0);
    }
  });
});
