/** A live performer in Play: a sender with a real WebSocket, in JSON and as BVH. */
import type { Page } from "playwright-core";
import { afterAll, afterEach, beforeAll, describe, expect, it } from "vitest";
import { type BvhFile, jsonFrame, jsonSkeleton, readBvh } from "../../examples/live-sender/bvh.js";
import { type MessageServer, serveMessages } from "../../examples/live-sender/web_socket.js";
import type { StrutHook } from "../../web/app/shell/hook";
import type { LiveFrame } from "../../web/client/live_frame";
import { walksIn } from "../clips";
import { axeFaults } from "./axe";
import { closePage, eventually, inputName, launchSite, openPage, saved, screenshot, visit } from "./browser";
import { expectFitsNarrow } from "./narrow";
import { showTheme } from "./rest";

declare const window: { strut: StrutHook & { frame: LiveFrame } };

/** A looped walk that is sent. */
class Sender {
  private sending: ReturnType<typeof setInterval> | undefined;

  private constructor(
    private readonly walk: BvhFile,
    private readonly server: MessageServer,
    private readonly format: "json" | "bvh",
  ) {}

  static async start(walk: BvhFile, format: "json" | "bvh", port = 0): Promise<Sender> {
    const first = () => [format === "json" ? jsonSkeleton(walk) : walk.header];
    const sender = new Sender(walk, await serveMessages(port, first), format);
    sender.send();
    return sender;
  }

  get url(): string {
    return this.server.url;
  }

  get receivers(): number {
    return this.server.receivers;
  }

  /** Sends another message. */
  say(message: string): void {
    this.server.send(message);
  }

  async stop(): Promise<void> {
    clearInterval(this.sending);
    await this.server.close();
  }

  private send(): void {
    const begin = performance.now() / 1000;
    let sent = 0;
    this.sending = setInterval(() => {
      const due = Math.floor((performance.now() / 1000 - begin) / this.walk.frameSecs);
      for (; sent <= due; sent++) {
        const i = sent % this.walk.frames.length;
        const channels = this.walk.frames[i]!;
        const json = () => jsonFrame(this.walk, channels, i * this.walk.frameSecs);
        this.server.send(this.format === "json" ? json() : `${sent} Performer ${channels.join(" ")} ||`);
      }
    }, 4);
  }
}

let site: Awaited<ReturnType<typeof launchSite>>;
let page: Page;
let walk: BvhFile;
let sender: Sender | undefined;

beforeAll(async () => {
  site = await launchSite();
  walk = readBvh((await walksIn(["neutral"])).neutral);
  page = await openPage(site.browser, site.site.url, { size: { width: 1440, height: 900 }, notesStay: true });
});
afterEach(async () => {
  await sender?.stop();
  sender = undefined;
});
afterAll(async () => {
  await closePage(page).finally(site.close);
});

const dialog = () => page.locator("dialog.live-source");
const panel = () => page.locator(".live-panel");
const figure = (name: string, of = page) =>
  of.locator(".live-figures .live-row").filter({ hasText: name }).locator("b");
const stateOf = () => panel().locator(".live-row b").textContent();
const pose = () => page.evaluate(() => [...window.strut.frame.pose]);
/** Returns the difference between the styled pose and the performer's. */
const styling = () =>
  page.evaluate(() => {
    const { pose, inputPose } = window.strut.frame;
    return pose.slice(3).reduce((sum, value, i) => sum + Math.abs(value - inputPose[3 + i]!), 0);
  });

/** Chooses the live source and connects. */
async function connect(url: string, format = "JSON"): Promise<void> {
  await page.getByLabel("Input motion").selectOption({ label: "Live source…" });
  await dialog().waitFor();
  await dialog().getByLabel("Address").fill(url);
  await dialog().getByLabel("Format").selectOption({ label: format });
  await dialog().getByRole("button", { name: "Connect" }).click();
  await eventually(() => panel().locator(".section-heading").textContent()).toContain(new URL(url).host);
  await eventually(stateOf).toBe("connected");
}

/** Waits until frames are displayed. */
const performing = () => eventually(() => figure("Rate").textContent(), "rate").toMatch(/^(5\d|6\d)$/);

describe("the dialog", () => {
  it("begins with the usual sender, says what cannot be, and changes nothing where it is cancelled", async () => {
    const before = await inputName(page);
    await page.getByLabel("Input motion").selectOption({ label: "Live source…" });
    await dialog().waitFor();
    const address = dialog().getByLabel("Address");
    expect(await address.inputValue()).toBe("ws://127.0.0.1:39541");
    expect(await dialog().getByLabel("Format").inputValue()).toBe("json");
    await address.fill("ws://192.168.0.7:1");
    expect(await dialog().getByRole("status").textContent()).toMatch(/^ws: works only for this computer, .*Use wss:/);
    expect(await dialog().getByRole("button", { name: "Connect" }).isDisabled()).toBe(true);
    for (const theme of ["light", "dark"] as const) {
      await showTheme(page, theme);
      await eventually(() => axeFaults(page), theme).toEqual([]);
      await screenshot(page, `live-dialog-${theme}`);
    }
    await dialog().getByRole("button", { name: "Cancel" }).click();
    await eventually(() => dialog().count()).toBe(0);
    expect(await inputName(page)).toBe(before);
  });
});

describe("a performer", () => {
  it("is followed in the style at once, which the polygon changes", async () => {
    sender = await Sender.start(walk, "json");
    await connect(sender.url);
    await performing();
    expect(await page.evaluate(() => window.strut.state.input)).toBe(`live:${sender?.url}`);
    expect(await page.locator(".timeline").isVisible()).toBe(false);
    await eventually(styling).toBeGreaterThan(0.5);
    const at = await pose();
    await eventually(async () => Math.hypot((await pose())[0]! - at[0]!, (await pose())[2]! - at[2]!)).toBeGreaterThan(
      0.2,
    );
    const title = page.locator(".stage-title").first();
    await page.keyboard.press("1");
    await eventually(() => title.textContent()).toMatch(/^Walk, proud/);
    for (const theme of ["light", "dark"] as const) {
      await showTheme(page, theme);
      await eventually(() => axeFaults(page), theme).toEqual([]);
      await screenshot(page, `live-${theme}`);
    }
  });

  it("who dies stays on screen with a sentence, and is shown again when they are back", async () => {
    sender = await Sender.start(walk, "json");
    const port = Number(new URL(sender.url).port);
    await connect(sender.url);
    await performing();
    await sender.stop();
    await eventually(() => panel().locator(".live-fault").textContent()).toMatch(
      /^(The connection to 127\.0\.0\.1:\d+ has ended|No sender answers at 127\.0\.0\.1:\d+); trying again in \d+ s\.$/,
    );
    await eventually(stateOf).toMatch(/^not reachable; retry in \d+ s$/);
    // Received frames are displayed to the end.
    let left: number[] = [];
    await eventually(async () => {
      left = await pose();
      await page.waitForTimeout(600);
      return JSON.stringify(await pose()) === JSON.stringify(left);
    }).toBe(true);
    expect(await page.locator(".stage canvas").first().isVisible()).toBe(true);
    await screenshot(page, "live-lost");
    sender = await Sender.start(walk, "json", port);
    await eventually(stateOf).toBe("connected");
    await eventually(async () => JSON.stringify(await pose()) !== JSON.stringify(left)).toBe(true);
    expect(await panel().locator(".live-fault").textContent()).toBe("");
  });

  it("who sends what cannot be understood is counted, and shown all the same", async () => {
    sender = await Sender.start(walk, "json");
    await connect(sender.url);
    await performing();
    for (const message of ["{", "[]", '{"t":1}', '{"t":"NaN","p":[0,0,0],"q":[]}', "x".repeat(70_000)])
      sender.say(message);
    await eventually(() => figure("Unreadable").textContent()).toBe("5");
    sender.say('{"strut":1,"names":["a"],"parents":[-1],"offsets":[[0,0,0]]}');
    await eventually(() => panel().locator(".live-fault").textContent()).toMatch(/^No legs and arms/);
    const { inputFrame } = await page.evaluate(() => window.strut.frame);
    await eventually(() => page.evaluate(() => window.strut.frame.inputFrame)).toBeGreaterThan(inputFrame + 10);
  });

  it("may send the channels of a BVH file", async () => {
    sender = await Sender.start(walk, "bvh");
    await connect(sender.url, "BVH");
    await eventually(() => figure("Rate").textContent()).toMatch(/^\d+$/);
    expect(await page.evaluate(() => window.strut.state.input)).toBe(`live:bvh:${sender?.url}`);
    await eventually(styling).toBeGreaterThan(0.5);
  });

  it("is kept as an input with its styles, which plays and can be exported", async () => {
    sender = await Sender.start(walk, "json");
    await connect(sender.url);
    await performing();
    await eventually(() => page.evaluate(() => window.strut.frame.inputFrame)).toBeGreaterThan(90);
    await page.getByRole("button", { name: "Keep" }).click();
    await eventually(() => page.evaluate(() => window.strut.state.input)).toBe("performed 1");
    await eventually(() => panel().count()).toBe(0);
    await eventually(() => sender!.receivers, "disconnected").toBe(0);
    expect(await inputName(page)).toBe("performed 1");
    await eventually(() => page.evaluate(() => window.strut.analysed)).toBe(true);
    expect(await page.locator(".timeline").isVisible()).toBe(true);
    const { name, bytes } = await saved(page, "BVH");
    expect(name).toMatch(/^performed-1-.*\.bvh$/);
    expect(bytes.toString("utf8")).toMatch(/^HIERARCHY[\s\S]*Frames: \d{2,}\n/);
  });
});

describe("a link", () => {
  it("opens the dialog with its sender, but connects only when it is told to", async () => {
    sender = await Sender.start(walk, "json");
    const before = await inputName(page);
    await visit(page, `input=live:${sender.url}`);
    await dialog().waitFor();
    expect(await dialog().getByLabel("Address").inputValue()).toBe(sender.url);
    // Many times as long as a connection would take.
    await page.waitForTimeout(500);
    expect(sender.receivers).toBe(0);
    expect(await inputName(page)).toBe(before);
    await dialog().getByRole("button", { name: "Connect" }).click();
    await panel().waitFor();
    await performing();
    expect(sender.receivers).toBe(1);
  });

  it("does so on a page that is opened with it, on a narrow screen too", async () => {
    sender = await Sender.start(walk, "json");
    const hash = `input=live:${sender.url}&tab=input`;
    const narrow = await openPage(site.browser, site.site.url, { hash, size: { width: 390, height: 844 } });
    const asked = narrow.locator("dialog.live-source");
    await asked.waitFor();
    expect(sender.receivers).toBe(0);
    await screenshot(narrow, "live-narrow-dialog");
    await asked.getByRole("button", { name: "Connect" }).click();
    await eventually(() => figure("Rate", narrow).textContent()).toMatch(/^\d+$/);
    // Software rendering needs a while for the first frame.
    await eventually(() => narrow.evaluate(() => window.strut.frame.inputFrame)).toBeGreaterThan(60);
    await screenshot(narrow, "live-narrow");
    await narrow.getByRole("button", { name: "Curves" }).click();
    expect(await figure("Latency", narrow).isVisible()).toBe(true);
    await screenshot(narrow, "live-narrow-curves");
    await expectFitsNarrow(narrow, ".live-bar button");
    await closePage(narrow);
  });
});
