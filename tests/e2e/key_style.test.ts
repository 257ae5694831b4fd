/** The Key-style view: the user drags a point over style variables and the body follows; keys make a motion. */
import type { Page } from "playwright-core";
import { beforeAll, describe, expect, it } from "vitest";
import type { StrutHook } from "../../web/app/shell/hook";
import { axeFaults } from "./axe";
import { drag, drawn, dropFile, eventually, middleOf, openSite, visit } from "./browser";
import { expectFitsNarrow } from "./narrow";
import { showTheme } from "./rest";

declare const window: { strut: StrutHook };

let page: Page;
let bvh: Buffer;

beforeAll(async () => {
  const opened = await openSite({ size: { width: 1440, height: 900 }, theme: "dark" });
  page = opened.page;
  return opened.close;
});

const state = () => page.evaluate(() => window.strut.state);
const trained = () => page.locator(".model-menu summary").textContent();
const secs = async () => Number(await page.locator(".key-style .clock").textContent());
const spoken = () => page.getByRole("slider", { name: "Style", exact: true }).getAttribute("aria-valuetext");
/** Returns the number of a measure from the handle's text. */
const measured = async (name: string) =>
  Number(new RegExp(`${name} (−?[\\d.]+)`).exec((await spoken())!)![1]!.replace("−", "-"));
const joint = (role: Parameters<StrutHook["jointScreenPosition"]>[0]) =>
  page.evaluate((role) => window.strut.jointScreenPosition(role), role);

/** Returns centre and radii of the circle of the keys on the pad, pixels. */
async function turn(): Promise<{ x: number; y: number; rx: number; ry: number }> {
  const at = await page.evaluate(() =>
    [...document.querySelectorAll(".pad-key")].map((key) => {
      const { x, y, width, height } = key.getBoundingClientRect();
      return [x + width / 2, y + height / 2] as const;
    }),
  );
  const [xs, ys] = [at.map(([x]) => x), at.map(([, y]) => y)];
  const mean = (values: number[]) => (Math.min(...values) + Math.max(...values)) / 2;
  const half = (values: number[]) => (Math.max(...values) - Math.min(...values)) / 2;
  return { x: mean(xs), y: mean(ys), rx: 0.85 * half(xs), ry: 0.8 * half(ys) };
}

const faults = () => axeFaults(page);

/** Waits until the model of the link is open. */
const learned = () => page.locator('.key-style[aria-busy="false"]').waitFor();

/** Waits until the body, which follows the handle with a delay, is at rest. */
async function resting(): Promise<void> {
  await page.evaluate(async () => {
    const feet = () => (["left_foot", "right_foot"] as const).map((foot) => window.strut.jointScreenPosition(foot).x);
    let [before, still] = [feet(), 0];
    while (still < 5) {
      await new Promise(requestAnimationFrame);
      const now = feet();
      still = now.every((x, i) => Math.abs(x - before[i]!) < 0.2) ? still + 1 : 0;
      before = now;
    }
  });
}

describe("opening the view", () => {
  it("learns the built-in walk, says what it took, and walks by keys", async () => {
    await page.getByRole("link", { name: "Key-style", exact: true }).click();
    await eventually(trained).toMatch(/^\d+ components · trained in \d\.\d\d s$/);
    await eventually(() => page.locator(".key-style .stage-title").textContent()).toBe("Walk");
    await eventually(() => page.locator(".pad-key").count()).toBe(9);
    const before = await secs();
    await eventually(secs, "it plays by itself").not.toBe(before);
    await eventually(() => page.url()).toContain("keys=");
    await eventually(faults).toEqual([]);
  });

  it("follows the keyboard: play, pause, keys", async () => {
    await page.locator("body").press("Space");
    await eventually(async () => (await state()).playing).toBe(false);
    await drawn(page, 2);
    const still = await secs();
    await drawn(page, 20);
    expect(await secs()).toBe(still);
    await page.locator("body").press("Home");
    await eventually(secs).toBe(0);
    await page.locator("body").press("ArrowRight");
    await eventually(async () => (await state()).keyChosen).toBe(1);
    await eventually(secs).toBeGreaterThan(0.05);
  });
});

describe("the pad", () => {
  it("shows a pose in the frame of the screen in which the pointer moved", async () => {
    const { x, y, rx } = await turn();
    await page.mouse.move(x + rx, y);
    await page.mouse.down();
    // The pose of an event is displayed before the next frame is drawn.
    const late = await page.evaluate(async () => {
      const pad = document.querySelector(".pad-plot")!;
      const foot = () => window.strut.jointScreenPosition("left_foot").x;
      let late = 0;
      const box = pad.getBoundingClientRect();
      for (let i = 0; i < 20; i++) {
        await new Promise(requestAnimationFrame);
        const before = foot();
        const at = { clientX: box.x + box.width * (0.3 + 0.02 * i), clientY: box.y + box.height / 2, pointerId: 1 };
        pad.dispatchEvent(new PointerEvent("pointermove", { ...at, bubbles: true }));
        if (foot() === before) late++;
      }
      return late;
    });
    await page.mouse.up();
    expect(late, "events whose pose was not on the body at once").toBe(0);
    expect((await state()).keyTrail.length).toBeGreaterThan(1);
  });

  it("walks when the pointer turns", { timeout: 600_000 }, async () => {
    const { x, y, rx, ry } = await turn();
    const at = (share: number): [number, number] => [
      x + rx * Math.cos(2 * Math.PI * share),
      y + ry * Math.sin(2 * Math.PI * share),
    ];
    await page.mouse.move(...at(0));
    await page.mouse.down();
    const seen: { apart: number; left: number; right: number; head: number }[] = [];
    const frames = 16;
    for (let frame = 1; frame <= frames; frame++) {
      for (let i = 1; i <= 2; i++) {
        await page.mouse.move(...at((2 * (frame - 1 + i / 2)) / frames));
        await drawn(page, 2);
      }
      await resting();
      const [left, right, head] = await Promise.all([joint("left_foot"), joint("right_foot"), joint("head")]);
      seen.push({ apart: left.x - right.x, left: left.y, right: right.y, head: head.y });
    }
    await page.mouse.up();
    const swings = seen.map(({ apart }) => Math.sign(apart));
    const steps = swings.filter((side, i) => i > 0 && side !== swings[i - 1]).length;
    expect(steps, "feet pass each other twice a turn").toBeGreaterThanOrEqual(3);
    const widest = Math.max(...seen.map(({ apart }) => Math.abs(apart)));
    expect(widest, "pixels of a step").toBeGreaterThan(60);
    const heads = seen.map(({ head }) => head);
    expect(Math.max(...heads) - Math.min(...heads), "the head stays at its height").toBeLessThan(25);
    const floor = Math.max(...seen.flatMap(({ left, right }) => [left, right]));
    for (const { left, right } of seen) expect(floor - Math.max(left, right), "somebody stands").toBeLessThan(25);
  });

  it("keeps the drag, plays it again, and makes keys of it", async () => {
    const { x, y, rx, ry } = await turn();
    await page.mouse.move(x + rx, y);
    await page.mouse.down();
    for (let i = 1; i <= 12; i++) {
      await page.mouse.move(x + rx * Math.cos(0.4 * i), y + ry * Math.sin(0.4 * i));
      // The speed of a hand: a drag records its course over time.
      await page.waitForTimeout(60);
    }
    await page.mouse.up();
    const { keys, keyTrail, keyHandle } = await state();
    expect(keyTrail.length).toBeGreaterThan(5);
    await eventually(() => page.url()).toContain("drag=");
    // Spoken text during the replay may end before the test can read it.
    await page.getByRole("slider", { name: "Style", exact: true }).evaluate((handle) => {
      const before = handle.getAttribute("aria-valuetext");
      const observer = new MutationObserver(() => {
        if (handle.getAttribute("aria-valuetext") !== before) handle.setAttribute("data-replayed", "");
      });
      observer.observe(handle, { attributeFilter: ["aria-valuetext"] });
    });
    await page.locator("body").press("r");
    await page.locator("[data-replayed]").waitFor({ state: "attached" });
    await eventually(async () => (await state()).keyHandle, "it ends where the drag did").toEqual(keyHandle);
    await page.getByRole("button", { name: "Keys from the drag" }).click();
    await eventually(async () => (await state()).keys).not.toEqual(keys);
    await eventually(async () => (await state()).playing).toBe(true);
    await page.keyboard.press("Control+z");
    await eventually(async () => (await state()).keys).toEqual(keys);
  });

  it("moves by arrow keys and speaks of it", async () => {
    await visit(page, "view=key-style&play=0");
    await learned();
    await eventually(trained).toMatch(/trained/);
    await drawn(page, 2);
    await page.getByRole("slider", { name: "Style", exact: true }).focus();
    const before = await measured("foot separation");
    for (let i = 0; i < 5; i++) await page.keyboard.press("ArrowRight");
    await eventually(() => measured("foot separation")).toBeGreaterThan(before + 5);
    expect(await spoken()).toMatch(/^foot separation −?[\d.]+ cm, foot height difference −?[\d.]+ cm/);
  });

  it("takes numbers that are typed on its axes", async () => {
    const field = page.getByRole("spinbutton", { name: "foot separation, cm" });
    await field.fill("12.5");
    await field.press("Enter");
    await eventually(async () => (await state()).keyHandle[0]).toBe(12.5);
    await eventually(() => measured("foot separation")).toBe(12.5);
    await field.fill("100000");
    await field.press("Enter");
    await eventually(async () => (await state()).keyHandle[0]).toBeGreaterThan(12.5);
    expect((await state()).keyHandle[0], "within the pad").toBeLessThan(1000);
    const before = (await state()).keyHandle;
    await field.fill("");
    await field.press("Enter");
    expect((await state()).keyHandle, "nothing is no number").toEqual(before);
    await field.fill("3");
    await field.press("Escape");
    expect((await state()).keyHandle).toEqual(before);
    await eventually(async () => Number(await field.inputValue())).toBeCloseTo(before[0]!, 1);
    await eventually(faults).toEqual([]);
  });

  it("says where nothing is known, and stays with what is", async () => {
    const frame = (await page.locator(".pad-frame").boundingBox())!;
    await page.mouse.click(frame.x + frame.width - 4, frame.y + 4);
    await eventually(spoken).toMatch(/Beyond the data/);
    await eventually(() => page.locator(".pad-handle.beyond").count()).toBe(1);
    const [left, right] = await Promise.all([joint("left_foot"), joint("right_foot")]);
    expect(Math.abs(left.x - right.x)).toBeLessThan(400);
  });
});

describe("keys", () => {
  it("are set where the handle is, dragged in time and value, removed, and undone", async () => {
    await visit(page, "view=key-style&play=0");
    await learned();
    await eventually(() => page.locator(".keys-key").count()).toBe(18);
    const seek = (await page.locator(".key-style-pane > .keys .timeline-seek").boundingBox())!;
    await page.mouse.click(seek.x + seek.width * 0.44, seek.y + 8);
    await page.getByRole("slider", { name: "Style", exact: true }).focus();
    for (let i = 0; i < 3; i++) await page.keyboard.press("ArrowUp");
    await page.keyboard.press("k");
    await eventually(() => page.locator(".keys-key").count()).toBe(20);
    const { keys, keyChosen } = await state();
    const place = `[data-place="${keyChosen}-0"]`;
    const { x, y } = await middleOf(page.locator(place));
    await drag(page, { x, y }, { x: x + 24, y: y - 12 });
    await eventually(async () => (await state()).keys[keyChosen]!.secs).toBeGreaterThan(keys[keyChosen]!.secs + 0.01);
    const moved = (await state()).keys[keyChosen]!;
    expect(moved.values[0]).toBeGreaterThan(keys[keyChosen]!.values[0]!);
    expect(moved.values[1], "the other variable stays").toBe(keys[keyChosen]!.values[1]);
    await page.locator(place).focus();
    await page.keyboard.press("ArrowRight");
    await eventually(async () => (await state()).keys[keyChosen]!.secs).toBeGreaterThan(moved.secs);
    await eventually(() => page.evaluate(() => document.activeElement?.getAttribute("data-place"))).toBe(
      `${keyChosen}-0`,
    );
    await page.keyboard.press("Delete");
    await eventually(() => page.locator(".keys-key").count()).toBe(18);
    await page.keyboard.press("Control+z");
    await eventually(() => page.locator(".keys-key").count()).toBe(20);
  });

  it("are performed three ways side by side", async () => {
    await page.locator(".key-style-method label").filter({ hasText: "All three" }).click();
    await eventually(() => page.locator(".comparison canvas").count()).toBe(1);
    const captions = () => page.locator(".comparison-captions").textContent();
    await eventually(captions).toMatch(/Key-style.*Hybrid.*Key-frame/);
    await page.locator(".key-style-method label").filter({ hasText: "Key-style" }).click();
  });

  it("become a file as soon as there is a button for it, before they have been drawn", async () => {
    const other = await page.context().newPage();
    await other.addInitScript(() => {
      new MutationObserver((_, observer) => {
        const buttons = document.querySelectorAll<HTMLButtonElement>(
          ".key-style .editor-actions button:not(:disabled)",
        );
        const bvh = [...buttons].find(({ textContent }) => textContent === "BVH");
        if (!bvh) return;
        observer.disconnect();
        bvh.click();
      }).observe(document, { subtree: true, childList: true, attributes: true });
    });
    const download = other.waitForEvent("download");
    await other.goto(`${page.url().split("#")[0]}#view=key-style&play=0`);
    expect((await download).suggestedFilename()).toMatch(/\.bvh$/);
    await other.close();
  });

  it("become files", async () => {
    await page.getByLabel("Length, seconds").fill("2.5");
    await page.getByLabel("Length, seconds").press("Tab");
    await eventually(async () => (await state()).keyLength).toBe(2.5);
    for (const [name, file] of [
      ["BVH", "key-style.bvh"],
      ["GLB", "key-style.glb"],
    ] as const) {
      const downloading = page.waitForEvent("download");
      await page.locator(".key-style .editor-actions").getByRole("button", { name, exact: true }).click();
      const download = await downloading;
      expect(download.suggestedFilename()).toBe(file);
      if (name === "BVH") {
        const chunks: Buffer[] = [];
        for await (const chunk of await download.createReadStream()) chunks.push(chunk as Buffer);
        bvh = Buffer.concat(chunks);
      }
    }
  });
});

describe("what is learned", () => {
  it("is another motion with a click, and undo brings the former one back", async () => {
    await page.getByLabel("Training motions").selectOption("punch");
    await eventually(() => page.locator(".key-style .stage-title").textContent()).toMatch(/^Punch/);
    await eventually(() => page.locator(".pad-axis").allTextContents()).toEqual(["left reach, cm", "hips height, cm"]);
    await eventually(async () => (await state()).keys.length).toBeGreaterThan(3);
    await page.keyboard.press("Control+z");
    await eventually(() => page.locator(".key-style .stage-title").textContent()).toMatch(/^Walk/);
  });

  it("leaves the handle in the hand, which moves nothing until the new model is there", async () => {
    const axes = () => page.locator(".pad-axis").allTextContents();
    await eventually(axes).toEqual(["foot separation, cm", "foot height difference, cm"]);
    const box = (await page.locator(".pad-plot").boundingBox())!;
    const goTo = (share: number) => page.mouse.move(box.x + box.width * share, box.y + box.height * 0.4);
    await goTo(0.3);
    await page.mouse.down();
    // Read at one moment: training takes an unknown time.
    const handle = await page.getByLabel("Training motions").evaluate((select: HTMLSelectElement) => {
      select.value = "punch";
      select.dispatchEvent(new Event("change", { bubbles: true }));
      const pad = document.querySelector(".pad-plot")!;
      const { x, y } = pad.getBoundingClientRect();
      const at = { clientX: x + 200, clientY: y + 200, bubbles: true, pointerId: 1 };
      pad.dispatchEvent(new PointerEvent("pointermove", at));
      return window.strut.state.keyHandle;
    });
    expect(handle, "a place among walks means nothing to punches").toEqual([]);
    await eventually(axes).toEqual(["left reach, cm", "hips height, cm"]);
    await goTo(0.5);
    await eventually(async () => (await state()).keyTrail.length).toBeGreaterThan(0);
    await page.mouse.up();
    await visit(page, "view=key-style&play=0");
    await eventually(axes).toEqual(["foot separation, cm", "foot height difference, cm"]);
  });

  it("is any style variable, one to three, or an expression whose error points at the character", async () => {
    await page.getByLabel("Third style variable").selectOption("torso_lean");
    await eventually(() => page.locator(".key-style-sliders input").count()).toBe(1);
    await page.getByLabel("Second style variable").selectOption("");
    await eventually(() => page.locator(".pad-axis").allTextContents()).toEqual([
      "foot separation, cm",
      "time in the recordings",
    ]);
    await page.getByLabel("Second style variable").selectOption("=");
    const input = page.getByLabel("Second style variable, as an expression");
    await input.fill("hand_l.y - sholder_l.y");
    await eventually(() => page.locator(".axis-fault mark").textContent()).toBe("s");
    const fault = () => page.locator(".axis-fault").textContent();
    await eventually(fault).toMatch(/There is no joint, measure or function 'sholder_l'\./);
    await input.fill("hand_l.y - shoulder_l.y");
    await input.press("Enter");
    await eventually(() => page.locator(".pad-axis").allTextContents()).toContain("hand_l.y - shoulder_l.y, cm");
    const link = () => decodeURIComponent(page.url());
    await eventually(link).toContain("axes=foot_separation~hand_l.y - shoulder_l.y");
  });

  it("says what cannot be learned, and takes that back", async () => {
    await page.getByLabel("First style variable").selectOption("=");
    const input = page.getByLabel("First style variable, as an expression");
    await input.fill("1 + 1");
    await input.press("Enter");
    await eventually(() => page.locator(".key-style .editor-empty").textContent()).toMatch(/is 2\.0 .*in every frame/);
    await page.locator(".key-style .editor-empty").getByRole("button", { name: "Undo" }).click();
    await eventually(() => page.locator(".pad-axis").allTextContents()).toContain("hand_l.y - shoulder_l.y, cm");
  });

  it("is a BVH file that is dropped", async () => {
    await dropFile(page, "mine.bvh", bvh);
    await eventually(() => page.locator(".key-style .stage-title").textContent()).toBe("Mine");
    await eventually(async () => (await state()).view).toBe("key-style");
    await eventually(async () => (await state()).keySet).toBe("files");
  });

  it("is shown over time, and a click there puts the handle on that pose", async () => {
    await visit(page, "view=key-style&play=0&pane=recordings");
    await learned();
    await drawn(page, 2);
    await eventually(() => page.locator(".recordings-plot .keys-recorded").count()).toBe(2);
    const before = await spoken();
    const box = (await page.locator(".recordings-plot").boundingBox())!;
    await page.mouse.click(box.x + box.width * 0.6, box.y + box.height * 0.6);
    await eventually(spoken).not.toBe(before);
    const place = page.getByRole("slider", { name: "Time in the recording" });
    await eventually(() => place.getAttribute("aria-valuetext")).toMatch(/s$/);
    await eventually(faults).toEqual([]);
  });
});

describe("the picture", () => {
  it("has no faults of access in the light theme", async () => {
    await visit(page, "view=key-style&play=0&set=punch");
    await learned();
    await eventually(() => page.locator(".key-style .stage-title").textContent()).toMatch(/^Punch/);
    await showTheme(page, "light");
    await eventually(faults).toEqual([]);
  });

  it("has everything on a narrow screen as well, by touch", async () => {
    await expectFitsNarrow(page, ".key-style .editor-foot button, .axis-select, .set-select");
    const session = await page.context().newCDPSession(page);
    const frame = (await page.locator(".pad-frame").boundingBox())!;
    const touch = (type: "touchStart" | "touchMove" | "touchEnd", share: number) =>
      session.send("Input.dispatchTouchEvent", {
        type,
        touchPoints:
          type === "touchEnd"
            ? []
            : [{ x: frame.x + frame.width * share, y: frame.y + frame.height * (0.2 + 0.5 * share) }],
      });
    const before = await spoken();
    const scrolled = () => page.locator(".key-style").evaluate((view) => view.scrollTop);
    const from = await scrolled();
    await touch("touchStart", 0.3);
    for (let i = 1; i <= 8; i++) await touch("touchMove", 0.3 + 0.05 * i);
    await touch("touchEnd", 0.7);
    await eventually(spoken).not.toBe(before);
    expect(await scrolled(), "the page stays where it is").toBe(from);
  });
});
