/** Driving in Play: with the keyboard, a gamepad, the touch stick and lines on the ground. */
import type { CDPSession, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import type { StrutHook } from "../../web/app/shell/hook";
import { BuildClient } from "../../web/client/build/client";
import type { DriveFrame } from "../../web/client/drive/protocol";
import { walksIn } from "../clips";
import { InlineBuildWorker } from "../inline_build_worker";
import { axeFaults } from "./axe";
import {
  closePage,
  dropFile,
  eventually,
  launchSite,
  openPage,
  type Place,
  saved,
  screenshot,
  shown,
  visit,
} from "./browser";
import { expectFitsNarrow } from "./narrow";
import { atRest, showTheme } from "./rest";

declare const window: {
  strut: StrutHook & { frame: DriveFrame };
  /** The simulated gamepad; undefined while it is disconnected. */
  pad: { axes: number[]; pressed: number[] } | undefined;
};

/** The camera does not follow, so that points in the picture show where the character is. */
const STILL_CAMERA = "input=drive&follow=0";

let site: Awaited<ReturnType<typeof launchSite>>;
let page: Page;

beforeAll(async () => {
  site = await launchSite({ whole: true });
  page = await openPage(site.browser, site.site.url, { hash: STILL_CAMERA, size: { width: 1440, height: 900 } });
  await driving(page);
});
afterAll(async () => {
  await closePage(page).finally(site.close);
});

/** Waits until a page drives. */
async function driving(of: Page): Promise<void> {
  await of.locator(".drive-bar").waitFor();
  await of.waitForFunction(() => window.strut.frame?.root !== undefined);
}

const frame = (of = page) =>
  of.evaluate(() => {
    const { root, speed, progress, inputFrame, clip, move } = window.strut.frame;
    return { root, speed, progress, inputFrame, clip, move };
  });
const speed = async (of = page) => (await frame(of)).speed;
const heading = async (of = page) => (await frame(of)).root[2];
const hips = (of = page): Promise<Place> => of.evaluate(() => window.strut.jointScreenPosition("hips"));
const alerts = () => page.getByRole("alert").textContent();
const stopped = (of = page) => eventually(() => speed(of), "stands").toBeLessThan(0.15);

/** Restarts at the camera. */
async function anew(hash = STILL_CAMERA): Promise<void> {
  await visit(page, "input=");
  await eventually(() => page.locator(".drive-panel").count()).toBe(0);
  await visit(page, hash);
  await driving(page);
  await eventually(() => page.locator(".drive-panel").count()).toBe(1);
  await page.waitForTimeout(600);
}

/** Holds keys until a condition holds. */
async function holding(keys: readonly string[], seen: () => Promise<void>): Promise<void> {
  for (const key of keys) await page.keyboard.down(key);
  await seen();
  for (const key of keys) await page.keyboard.up(key);
}

describe("a link", () => {
  it("opens it, and says so", async () => {
    await eventually(() => page.locator(".stage-title").first().textContent()).toMatch(/^Driving, mostly proud/);
    expect(await page.getByLabel("Input motion").locator("option").first().textContent()).toBe("Drive it yourself");
    expect(await page.getByLabel("Input motion").inputValue()).toBe("drive");
    expect(await page.evaluate(() => window.strut.state.input)).toBe("drive");
    expect(await alerts()).toBe("");
    expect(await page.locator(".drive-help").textContent()).toMatch(/go.*run.*turn/);
    expect(await page.locator(".timeline").isVisible()).toBe(false);
  });

  it("is accessible in both themes, and holds everything without scrolling", async () => {
    for (const theme of ["light", "dark"] as const) {
      await showTheme(page, theme);
      await eventually(() => axeFaults(page), theme).toEqual([]);
      await screenshot(page, `drive-${theme}`);
    }
    const overflow = (selector: string) =>
      page.locator(selector).evaluate((e) => Math.max(e.scrollHeight - e.clientHeight, e.scrollWidth - e.clientWidth));
    for (const selector of [".panels", ".transport"])
      await eventually(() => overflow(selector), selector).toBeLessThanOrEqual(0);
  });
});

describe("keys", () => {
  it("go away from the viewer and to the right, and stop when they are let go", async () => {
    await anew();
    const from = await hips();
    await holding(["KeyW"], async () => {
      await eventually(async () => from.y - (await hips()).y, "away").toBeGreaterThan(40);
    });
    // The line about the keys stays until ? hides it.
    expect(await page.locator(".drive-help").isVisible()).toBe(true);
    await page.keyboard.press("?");
    await eventually(() => page.locator(".drive-help").isVisible()).toBe(false);
    await stopped();
    const then = await hips();
    await holding(["ArrowRight"], async () => {
      await eventually(async () => (await hips()).x - then.x, "right").toBeGreaterThan(60);
    });
    await stopped();
  });

  it("run with Shift", async () => {
    await anew();
    await holding(["ShiftLeft", "KeyW"], async () => {
      await eventually(speed).toBeGreaterThan(1.9);
    });
  });

  it("turn on the spot", async () => {
    await anew();
    await stopped();
    const before = await heading();
    for (let press = 0; press < 2; press++) await page.keyboard.press("KeyQ");
    await eventually(async () => Math.abs((await heading()) - before)).toBeGreaterThan(1.2);
    await eventually(async () => Math.abs((await heading()) - before - Math.PI / 2)).toBeLessThan(0.3);
  });

  it("are not needed: the arrow before the feet is dragged", async () => {
    await stopped();
    const before = await heading();
    const { arrow, feet } = await page.evaluate(() => {
      const { pose, root } = window.strut.frame;
      const [x, z, heading] = [pose[0]!, pose[2]!, root[2]];
      const at = (ahead: number) =>
        window.strut.groundScreenPosition(x + ahead * Math.sin(heading), z + ahead * Math.cos(heading));
      return { arrow: at(0.68), feet: at(0) };
    });
    await page.mouse.move(arrow.x, arrow.y);
    await page.mouse.down();
    // To the other side of the feet.
    await page.mouse.move(2 * feet.x - arrow.x, 2 * feet.y - arrow.y, { steps: 5 });
    await page.mouse.up();
    await eventually(async () => Math.abs((await heading()) - before)).toBeGreaterThan(2.5);
    expect((await frame()).progress).toBeUndefined();
  });

  it("make moves that there are", async () => {
    await stopped();
    await page.keyboard.press("KeyC");
    await eventually(async () => (await frame()).move).toBe("punch");
    await eventually(() => page.locator(".visually-hidden[role=status]").textContent()).toBe("punch");
    await eventually(async () => (await frame()).move).toBeUndefined();
  });

  it("are the control's that has the focus", async () => {
    await stopped();
    const slider = page.locator(".polygon-handle");
    await slider.focus();
    const before = await page.evaluate(() => JSON.stringify(window.strut.state.styles));
    await page.keyboard.press("ArrowLeft");
    await eventually(() => page.evaluate(() => JSON.stringify(window.strut.state.styles))).not.toBe(before);
    expect(await speed()).toBeLessThan(0.3);
    await page.evaluate(() => (document.activeElement as HTMLElement).blur());
  });

  it("choose styles, pause, and are let go where the window loses the focus", async () => {
    await page.keyboard.press("1");
    await eventually(() => page.locator(".stage-title").first().textContent()).toBe("Driving, proud");
    await page.keyboard.down("KeyW");
    await eventually(speed).toBeGreaterThan(0.5);
    await page.evaluate(() => dispatchEvent(new Event("blur")));
    await stopped();
    await page.keyboard.up("KeyW");
    await page.keyboard.press("KeyP");
    await eventually(() => page.evaluate(() => window.strut.state.playing)).toBe(false);
    // The frame that was requested before the pause may still arrive.
    let inputFrame = Number.NaN;
    await eventually(async () => {
      ({ inputFrame } = await frame());
      await page.waitForTimeout(400);
      return (await frame()).inputFrame - inputFrame;
    }).toBe(0);
    await page.keyboard.down("KeyW");
    await page.waitForTimeout(400);
    await page.keyboard.up("KeyW");
    expect((await frame()).inputFrame).toBe(inputFrame);
    await page.keyboard.press("KeyP");
    await eventually(async () => (await frame()).inputFrame).toBeGreaterThan(inputFrame);
  });

  it("are kept where that is asked for", async () => {
    await page.getByRole("switch", { name: "Keep going" }).click();
    await page.keyboard.press("KeyW");
    await eventually(speed).toBeGreaterThan(0.5);
    await page.keyboard.press("KeyW");
    await stopped();
    await page.getByRole("switch", { name: "Keep going" }).click();
  });
});

describe("a pad", () => {
  let padPage: Page;
  beforeAll(async () => {
    padPage = await openPage(site.browser, site.site.url, { hash: STILL_CAMERA });
    await padPage.evaluate(() => {
      window.pad = { axes: [0, 0, 0, 0], pressed: [] };
      navigator.getGamepads = () => {
        if (!window.pad) return [null];
        const { axes, pressed } = window.pad;
        const buttons = Array.from({ length: 17 }, (_, i) => ({
          pressed: pressed.includes(i),
          touched: false,
          value: pressed.includes(i) ? 1 : 0,
        }));
        return [{ id: "054c", index: 0, connected: true, mapping: "standard", axes, buttons, timestamp: 0 }] as never;
      };
    });
    await driving(padPage);
    return () => closePage(padPage);
  });

  const hold = (axes: number[], pressed: number[] = []) =>
    padPage.evaluate(
      (pad) => {
        window.pad = pad;
      },
      { axes, pressed },
    );

  it("goes, runs, and stands where it is unplugged while running", async () => {
    const from = await hips(padPage);
    await hold([0, -1]);
    await eventually(async () => from.y - (await hips(padPage)).y).toBeGreaterThan(20);
    await hold([0, -1], [7]);
    await eventually(() => speed(padPage)).toBeGreaterThan(1.8);
    await padPage.evaluate(() => {
      window.pad = undefined;
    });
    await stopped(padPage);
  });

  it("has its own marks, and buttons for moves", async () => {
    await hold([0, 0], [2]);
    await eventually(async () => (await frame(padPage)).move).toBe("punch");
    await hold([0, 0]);
    await padPage.keyboard.press("?");
    await eventually(() => padPage.locator(".drive-help").textContent()).toMatch(/Left stick.*R2.*□.*punch/);
  });

  it("pauses", async () => {
    await hold([0, 0], [9]);
    await eventually(() => padPage.evaluate(() => window.strut.state.playing)).toBe(false);
    await hold([0, 0]);
  });
});

describe("a thumb", () => {
  it("goes where its stick is pushed, on the left half of the picture", async () => {
    const context = await site.browser.newContext({
      viewport: { width: 390, height: 844 },
      hasTouch: true,
      isMobile: true,
      colorScheme: "dark",
    });
    const narrow = await context.newPage();
    await narrow.goto(`${site.site.url}#${STILL_CAMERA}`);
    await shown(narrow);
    await driving(narrow);
    // While the camera moves to the driven character, the arrow at its feet passes the touch point.
    await narrow.waitForFunction(() => window.strut.frame.inputFrame > 40);
    await atRest(narrow, () => narrow.evaluate(() => window.strut.groundScreenPosition(0, 0)));
    const cdp: CDPSession = await context.newCDPSession(narrow);
    const touch = (type: "touchStart" | "touchMove" | "touchEnd", places: Place[]) =>
      cdp.send("Input.dispatchTouchEvent", { type, touchPoints: places });
    const box = (await narrow.locator(".stage-view").boundingBox())!;
    // Next to the arrow.
    const at = { x: box.x + 40, y: box.y + box.height - 180 };
    const from = await hips(narrow);
    await touch("touchStart", [at]);
    await touch("touchMove", [{ x: at.x, y: at.y - 54 }]);
    await eventually(() => narrow.locator(".drive-stick.runs:not([hidden])").count()).toBe(1);
    await eventually(async () => from.y - (await hips(narrow)).y).toBeGreaterThan(10);
    await eventually(() => speed(narrow)).toBeGreaterThan(1.5);
    await touch("touchEnd", []);
    await stopped(narrow);
    await narrow.getByRole("button", { name: "punch" }).tap();
    await eventually(async () => (await frame(narrow)).move).toBe("punch");
    await expectFitsNarrow(narrow, ".drive-bar button, .drive-move, .stage-controls button");
    await context.close();
  });
});

describe("a line on the ground", () => {
  /** Draws through points of the picture, as shares of its size. */
  async function draw(places: readonly (readonly [number, number])[]): Promise<void> {
    const box = (await page.locator(".stage-view").boundingBox())!;
    const at = ([x, y]: readonly [number, number]) => [box.x + x * box.width, box.y + y * box.height] as const;
    await page.getByRole("button", { name: "Draw path" }).click();
    await page.mouse.move(...at(places[0]!));
    await page.mouse.down();
    for (const place of places.slice(1)) await page.mouse.move(...at(place), { steps: 4 });
    await page.mouse.up();
  }

  it("is followed within 10 cm", async () => {
    await anew();
    await stopped();
    const box = (await page.locator(".stage-view").boundingBox())!;
    const foot = await page.evaluate(() => window.strut.jointScreenPosition("left_toes"));
    const [x, y] = [(foot.x - box.x) / box.width, (foot.y - box.y) / box.height];
    await draw(Array.from({ length: 31 }, (_, i) => [x + 0.08 * Math.sin(i / 12), y - 0.017 * i] as const));
    // The first two seconds are not measured.
    const begin = (await frame()).inputFrame;
    await eventually(async () => (await frame()).inputFrame - begin).toBeGreaterThan(120);
    const off: number[] = [];
    const panel = page.locator(".drive-row").filter({ hasText: "Off course" }).locator("b");
    while ((await frame()).progress !== undefined) {
      off.push(Number(await panel.textContent()));
      await page.waitForTimeout(60);
    }
    expect(off.length).toBeGreaterThan(5);
    expect(off.reduce((sum, cm) => sum + cm, 0) / off.length).toBeLessThan(10);
    await eventually(() => page.locator(".visually-hidden[role=status]").textContent()).toBe("At the end of the path.");
    await stopped();
  });

  it("is a click: the character walks there", async () => {
    await anew();
    await stopped();
    const box = (await page.locator(".stage-view").boundingBox())!;
    const to = { x: box.x + 0.25 * box.width, y: box.y + 0.75 * box.height };
    await page.mouse.click(to.x, to.y);
    await eventually(async () => (await frame()).progress).toBeDefined();
    await eventually(async () => (await frame()).progress).toBeUndefined();
    await stopped();
    const toes = await page.evaluate(() => window.strut.jointScreenPosition("right_toes"));
    // The character stops 0.3 m before the end.
    expect(Math.hypot(toes.x - to.x, toes.y - to.y)).toBeLessThan(110);
  });

  it("ends where keys take over", async () => {
    const box = (await page.locator(".stage-view").boundingBox())!;
    await page.mouse.click(box.x + 0.7 * box.width, box.y + 0.6 * box.height);
    await eventually(async () => (await frame()).progress).toBeDefined();
    await holding(["KeyS"], async () => {
      await eventually(async () => (await frame()).progress).toBeUndefined();
    });
  });
});

describe("what was driven", () => {
  it("is kept as an input with its styles, plays in Play and can be exported", async () => {
    await anew();
    await holding(["KeyW"], async () => {
      await eventually(async () => (await frame()).inputFrame).toBeGreaterThan(150);
      await page.keyboard.press("1");
      await eventually(async () => (await frame()).inputFrame).toBeGreaterThan(300);
    });
    await page.keyboard.press("KeyM");
    await eventually(() => page.evaluate(() => window.strut.state.input)).toBe("driven 1");
    await eventually(() => page.locator(".drive-panel").count()).toBe(0);
    expect(await page.getByLabel("Input motion").inputValue()).toBe("driven 1");
    const track = await page.evaluate(() => window.strut.state.track);
    expect(track.length).toBeGreaterThan(1);
    expect(track.at(-1)!.styles).toEqual([{ name: "proud", weight: 1 }]);
    await eventually(() => page.evaluate(() => window.strut.analysed)).toBe(true);
    expect(await page.locator(".timeline").isVisible()).toBe(true);
    const { name, bytes } = await saved(page, "BVH");
    expect(name).toMatch(/^driven-1-.*\.bvh$/);
    expect(bytes.toString("utf8")).toMatch(/^HIERARCHY[\s\S]*Frames: [3-9]\d\d\n/);
    await page.getByRole("button", { name: "Continue driving" }).click();
    await driving(page);
  });

  it("is kept where it is exported", async () => {
    await holding(["KeyW"], async () => {
      await eventually(async () => (await frame()).inputFrame).toBeGreaterThan(60);
    });
    const { name } = await saved(page, "BVH");
    expect(name).toMatch(/^driven-2-/);
    expect(await page.evaluate(() => window.strut.state.input)).toBe("driven 2");
  });
});

describe("a database without neutral walking", () => {
  it("is driven with built-in clips, and the panel says so", async () => {
    const walks = await walksIn(["neutral", "old"]);
    const builds = new BuildClient(() => new InlineBuildWorker());
    const paths = ["walk_neutral_1.bvh", "walk_old_1.bvh"];
    await builds.open(
      [walks.neutral, walks.old].map((text, i) => ({ path: paths[i]!, file: new File([text], paths[i]!) })),
    );
    const labels = await builds.label("{action}_{style}_{take}.bvh", undefined);
    const files = labels.map((label, index) => {
      if ("reason" in label) throw new Error(label.reason);
      return { index, path: paths[index]!, ...label, source: "", licence: "", roles: undefined };
    });
    const file = new Uint8Array(await (await builds.build(files, "neutral")).file.arrayBuffer());
    builds.dispose();
    await dropFile(page, "short.strutdb", file);
    await eventually(() => page.locator(".panels .vertex").count()).toBe(2);
    await page.getByLabel("Input motion").selectOption("drive");
    await eventually(() => page.locator(".drive-note").textContent()).toMatch(
      /^The neutral clips have .* s of walking; driving needs 5 s\. Built-in clips do the walking\.$/,
    );
    expect(await alerts()).toBe("");
    await holding(["KeyW"], async () => {
      await eventually(speed).toBeGreaterThan(0.7);
    });
  });
});
