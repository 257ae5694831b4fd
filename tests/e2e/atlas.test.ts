/** The atlas: every distance between the input and the database, drawn by the GPU or the CPU. */
import type { Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import type { StrutHook } from "../../web/app/shell/hook";
import { walksIn } from "../clips";
import { axeFaults } from "./axe";
import {
  dropFile,
  eventually,
  inputName,
  launchBrowser,
  openPage,
  openSite,
  screenshot,
  serveSite,
  settledPose,
  visit,
} from "./browser";
import { SWIFTSHADER } from "./graphics";
import { expectFitsNarrow } from "./narrow";

declare const window: { strut: StrutHook };

/** The first input, paused. */
const INPUT = "play=0&frame=40";
const BY_PROCESSOR = /^Drawn by the CPU in [\d.]+ m?s\./;

const state = (page: Page) => page.evaluate(() => window.strut.state);
const words = (page: Page, of: "by" | "reading") => page.locator(`.atlas-${of}`).textContent();
/** Waits until a picture is complete, and returns what drew it. */
async function drawn(page: Page): Promise<string> {
  await page.locator(".atlas[data-drawn]").waitFor();
  return (await page.locator(".atlas").getAttribute("data-drawn"))!;
}

/** Returns the picture's pixels, red, green, blue and alpha each. */
async function pixels(page: Page): Promise<{ width: number; height: number; data: number[] }> {
  await drawn(page);
  return page.locator(".atlas-picture").evaluate(async (canvas: HTMLCanvasElement) => {
    await new Promise(requestAnimationFrame);
    await new Promise(requestAnimationFrame);
    const { width, height } = canvas;
    return { width, height, data: [...canvas.getContext("2d")!.getImageData(0, 0, width, height).data] };
  });
}

/** Returns pixels with more than a few colours: the picture is not empty. */
const coloursOf = ({ data }: { data: number[] }) =>
  new Set(data.flatMap((v, i) => (i % 4 === 0 ? [(v << 16) | (data[i + 1]! << 8) | data[i + 2]!] : []))).size;

describe("without a graphics processor", () => {
  let page: Page;
  const loaded: string[] = [];

  beforeAll(async () => {
    const opened = await openSite({ size: { width: 1440, height: 900 }, theme: "dark", hash: INPUT });
    page = opened.page;
    page.on("request", (request) => loaded.push(request.url()));
    return opened.close;
  });

  it("is opened and closed by its key and its button, and in the link", async () => {
    await page.keyboard.press("a");
    await eventually(() => page.url()).toContain("atlas=whole");
    expect(await drawn(page)).toBe("processor");
    await page.keyboard.press("a");
    await eventually(() => page.locator(".atlas").isVisible()).toBe(false);
    await page.getByRole("button", { name: "atlas" }).click();
    await eventually(() => page.locator(".atlas").isVisible()).toBe(true);
    await page.getByRole("button", { name: "Close the atlas" }).click();
    await eventually(async () => (await state(page)).atlas).toBe("");
  });

  it("is drawn by the processor, which says so; nothing of the other is loaded", async () => {
    await visit(page, `${INPUT}&atlas=whole`);
    expect(await drawn(page)).toBe("processor");
    expect(await words(page, "by")).toMatch(BY_PROCESSOR);
    expect(await words(page, "by")).toContain("In a browser with WebGPU it updates while you drag.");
    expect(coloursOf(await pixels(page))).toBeGreaterThan(50);
    expect(loaded.filter((url) => url.includes("gpu") || url.includes("graphics_worker"))).toEqual([]);
    await screenshot(page, "atlas");
    expect(await axeFaults(page)).toEqual([]);
  });

  it("is another picture by another part of the body", async () => {
    const whole = await pixels(page);
    await page.locator(".atlas-parts").getByRole("button", { name: "arms" }).click();
    await eventually(async () => (await state(page)).atlas).toBe("arms");
    await eventually(async () => (await pixels(page)).data.join()).not.toBe(whole.data.join());
    expect(await drawn(page)).toBe("processor");
  });

  it("comes closer under the pointer, reads a window and shows it as a ghost", async () => {
    await visit(page, `${INPUT}&atlas=whole`);
    await drawn(page);
    const stage = (await page.locator(".atlas-stage").boundingBox())!;
    const at = { x: stage.x + 0.4 * stage.width, y: stage.y + 0.8 * stage.height };
    await page.mouse.move(at.x, at.y);
    await eventually(() => words(page, "reading")).toMatch(/^.+, frame \d+: [\d.]+ cm$/);
    const read = await words(page, "reading");
    for (let notch = 0; notch < 12; notch++) await page.mouse.wheel(0, -100);
    await page.mouse.move(at.x, at.y + 1);
    await eventually(() => words(page, "reading")).not.toBe(read);
    expect(await drawn(page)).toBe("processor");
    const before = (await state(page)).frame;
    const picture = () => page.locator(".stage canvas").first().screenshot();
    const without = await picture();
    await page.mouse.click(at.x, at.y + 1);
    await eventually(async () => (await state(page)).frame).not.toBe(before);
    await settledPose(page);
    await eventually(async () => (await picture()).equals(without)).toBe(false);
    await screenshot(page, "atlas-ghost");
  });

  it("shows the windows of the link, and keeps those that are shown in it", async () => {
    await visit(page, `${INPUT}&atlas=whole&windows=1000_1080`);
    // One line per window.
    await eventually(async () => (await pixels(page)).height).toBe(80);
    await page.locator(".atlas-stage").focus();
    await page.keyboard.press("-");
    await eventually(() => page.url()).toContain("windows=960_1120");
    await eventually(async () => (await pixels(page)).height).toBeGreaterThan(80);
    await page.locator(".atlas-stage").dblclick();
    await eventually(() => page.url()).not.toContain("windows=");
    // The database has fewer windows.
    await visit(page, `${INPUT}&atlas=whole&windows=1000_999999999`);
    await page.keyboard.press("+");
    await eventually(() => page.url()).toMatch(/windows=\d+_\d+/);
  });

  it("is chosen from by the keyboard", async () => {
    await page.locator(".atlas-stage").focus();
    await page.keyboard.press("Enter");
    await eventually(() => words(page, "reading")).toMatch(/cm$/);
    await page.keyboard.press("+");
    await page.keyboard.press("ArrowDown");
    expect(await drawn(page)).toBe("processor");
  });

  it("fits a narrow screen", async () => {
    await page.setViewportSize({ width: 390, height: 844 });
    await visit(page, `${INPUT}&atlas=whole&tab=curves`);
    await drawn(page);
    await expectFitsNarrow(page, ".atlas button");
    await screenshot(page, "atlas-narrow");
  });
});

describe("with a graphics processor", () => {
  let site: Awaited<ReturnType<typeof serveSite>>;
  let browser: Awaited<ReturnType<typeof launchBrowser>>;
  let expected: Awaited<ReturnType<typeof pixels>>;
  let walk: string;
  const size = { width: 1000, height: 700 };
  /** Opens a page with a short, paused input, for which software draws every distance in seconds. */
  async function open(search: string): Promise<Page> {
    const page = await openPage(browser, `${site.url}${search}`, { size, hash: "play=0", theme: "dark" });
    await dropFile(page, "short.bvh", walk);
    await eventually(() => inputName(page)).toBe("short");
    return page;
  }

  beforeAll(async () => {
    walk = (await walksIn(["proud"], 60)).proud;
    site = await serveSite();
    const args = [...SWIFTSHADER.args, "--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader"];
    browser = await launchBrowser({ graphics: { ...SWIFTSHADER, args } });
  });
  afterAll(async () => {
    await browser.close();
    await site.close();
  });

  it("that is a program is not asked", async () => {
    const page = await open("");
    await page.keyboard.press("a");
    expect(await drawn(page)).toBe("processor");
    expected = await pixels(page);
    await page.context().close();
  });

  it("draws the processor's picture within a grey level", async () => {
    const page = await open("?gpu=any");
    await page.keyboard.press("a");
    expect(await drawn(page)).toBe("graphics");
    expect(await words(page, "by")).toMatch(/^Drawn by .*swiftshader.* in [\d.]+ m?s\.$/i);
    const { width, height, data } = await pixels(page);
    expect([width, height]).toEqual([expected.width, expected.height]);
    // The colour ramp goes from the panel's to the weights' colour, by at most 1 per channel and level.
    const greatest = data.reduce((most, v, i) => Math.max(most, Math.abs(v - expected.data[i]!)), 0);
    expect(greatest).toBeLessThanOrEqual(1);
    await page.context().close();
  });

  it("gives way to the processor where it stops amid a drawing", async () => {
    const page = await open("?gpu=any");
    // In the worker's own script: a patch that is sent to a running worker may arrive after the drawing.
    const stopAtFirstEncoder = () => {
      if (typeof GPUDevice === "undefined") return;
      const { createCommandEncoder } = GPUDevice.prototype;
      GPUDevice.prototype.createCommandEncoder = function (...of) {
        const encoder = createCommandEncoder.apply(this, of);
        this.destroy();
        return encoder;
      };
    };
    await page.route(/worker[^/]*\.js$/, async (route) => {
      const response = await route.fetch();
      await route.fulfill({ response, body: `(${stopAtFirstEncoder})();\n${await response.text()}` });
    });
    await page.keyboard.press("a");
    await eventually(() => words(page, "by")).toBe("The GPU stopped responding. Drawing continues on the CPU.");
    expect(await drawn(page)).toBe("processor");
    expect((await pixels(page)).data).toEqual(expected.data);
    await page.context().close();
  });
});
