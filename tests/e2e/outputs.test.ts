/** Every file that the page exports, as the browser saves it. */
import { mkdirSync, writeFileSync } from "node:fs";
import { ALL_FORMATS, BufferSource, Input } from "mediabunny";
import type { Page } from "playwright-core";
import { beforeAll, describe, expect, it } from "vitest";
import type { StrutHook } from "../../web/app/shell/hook";
import { eventually, openSite, saved, screenshot, settledPose, visit } from "./browser";

declare const window: { strut: StrutHook };

let page: Page;
let makesMp4: boolean;

beforeAll(async () => {
  const opened = await openSite();
  page = opened.page;
  await visit(page, "play=0&frame=60&styles=old:1,proud:0,childlike:0&range=60-90");
  await settledPose(page);
  makesMp4 = await page.evaluate(async () => {
    const config = { codec: "avc1.640028", width: 1920, height: 1080 };
    return (await VideoEncoder.isConfigSupported(config)).supported === true;
  });
  return opened.close;
});

/** Returns the first bytes of a saved file, which identify its type. */
const head = (bytes: Buffer, n: number) => bytes.subarray(0, n).toString("latin1");

describe("the menu", () => {
  it("names every format and closes with Escape", async () => {
    await page.getByRole("button", { name: "Export" }).click();
    await screenshot(page, "export-menu");
    // MP4 is present if the browser can encode it.
    const names = page.locator(".export-menu .menu-item:visible > :first-child");
    const mp4 = makesMp4 ? ["MP4"] : [];
    await eventually(() => names.allTextContents()).toEqual([
      "BVH",
      "GLB",
      "VRMA",
      "WebM",
      ...mp4,
      "PNG",
      "CSV",
      "JSON",
    ]);
    await page.keyboard.press("Escape");
    await eventually(() => page.locator(".export-menu").isVisible()).toBe(false);
  });
});

describe("a saved file", () => {
  it("is a GLB with the mannequin and one animation", async () => {
    const { name, bytes } = await saved(page, "GLB");
    expect(name).toBe("neutral-walk-old.glb");
    expect(head(bytes, 4)).toBe("glTF");
    expect(bytes.readUInt32LE(8)).toBe(bytes.length);
    const gltf = JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)).toString());
    expect(gltf.animations[0].channels).toHaveLength(22);
    const frames = Number(await page.locator(".scrub input").getAttribute("max")) + 1;
    const { input } = gltf.animations[0].samplers[0];
    expect(gltf.accessors[input].count).toBe(frames);
    expect(gltf.accessors[input].max[0], "the old walk takes longer").toBeGreaterThan(frames / 60);
  });

  it("is the motion alone, for any VRM", async () => {
    const { name, bytes } = await saved(page, "VRMA");
    expect(name).toBe("neutral-walk-old.vrma");
    const gltf = JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)).toString());
    expect(gltf.extensionsUsed).toEqual(["VRMC_vrm_animation"]);
    expect(gltf.meshes).toBeUndefined();
  });

  it("is a picture of the stage's shape", async () => {
    const { name, bytes } = await saved(page, "PNG");
    expect(name).toMatch(/\.png$/);
    expect(head(bytes, 4)).toBe("\x89PNG");
    const stage = (await page.locator(".stage-view").boundingBox())!;
    expect(bytes.readUInt32BE(16) / bytes.readUInt32BE(20)).toBeCloseTo(stage.width / stage.height, 2);
    // An empty picture compresses to a few bytes.
    expect(bytes.length).toBeGreaterThan(20_000);
  });

  it("is a picture of the size that was asked for, drawn at it", async () => {
    await page.getByRole("button", { name: "Export" }).click();
    await page.getByLabel("Size of pictures").selectOption("1920 × 1080");
    await page.keyboard.press("Escape");
    const { bytes } = await saved(page, "PNG");
    expect([bytes.readUInt32BE(16), bytes.readUInt32BE(20)]).toEqual([1920, 1080]);
    mkdirSync("tests/output", { recursive: true });
    writeFileSync("tests/output/asked-size.png", bytes);
    await screenshot(page, "asked-size-afterwards");
  });

  it("is a table of the trace, or lines of JSON", async () => {
    const csv = (await saved(page, "CSV")).bytes.toString();
    const [header, first] = csv.split("\n");
    expect(header).toMatch(/^frame,time_in,time_out,dt,planted_left,planted_right,.*walk\/neutral/);
    expect(first).toMatch(/^0,0,0,0,/);
    const json = (await saved(page, "JSON")).bytes.toString();
    const line = JSON.parse(json.split("\n")[5]!);
    expect(line).toMatchObject({ frame: 5 });
    const weights = Object.values(line.class_weights as Record<string, number>);
    expect(weights.reduce((sum, w) => sum + w, 0)).toBeCloseTo(1, 2);
  });

  it("is an MP4 that other programs open, where the browser makes it", async ({ skip }) => {
    if (!makesMp4) skip("this browser makes no MP4");
    const { name, bytes } = await saved(page, "MP4");
    expect(name).toBe("neutral-walk-old.mp4");
    const video = new Input({ source: new BufferSource(bytes), formats: ALL_FORMATS });
    const track = (await video.getPrimaryVideoTrack())!;
    expect(track.codec).toBe("avc");
    const { packetCount } = await track.computePacketStats();
    expect((await video.computeDuration()) * 60).toBeCloseTo(packetCount, 1);
  });

  it("is a video of every picture of the range, of the chosen size", async () => {
    await page.getByRole("button", { name: "Export" }).click();
    await page.getByLabel("Size of pictures").selectOption("1280 × 720");
    await page.keyboard.press("Escape");
    const { name, bytes } = await saved(page, "WebM");
    expect(name).toBe("neutral-walk-old.webm");
    expect(bytes.readUInt32BE(0).toString(16)).toBe("1a45dfa3");
    // The page's policy forbids videos.
    const blank = await page.context().newPage();
    const size = await blank.evaluate(async (data) => {
      const bytes = Uint8Array.from(atob(data), (c) => c.charCodeAt(0));
      const video = document.createElement("video");
      video.src = URL.createObjectURL(new Blob([bytes], { type: "video/webm" }));
      await new Promise((resolve, reject) => {
        video.onloadeddata = resolve;
        video.onerror = () => reject(new Error("the video does not play"));
      });
      return { width: video.videoWidth, height: video.videoHeight };
    }, bytes.toString("base64"));
    expect(size).toEqual({ width: 1280, height: 720 });
    const video = new Input({ source: new BufferSource(bytes), formats: ALL_FORMATS });
    const { packetCount } = await (await video.getPrimaryVideoTrack())!.computePacketStats();
    const shown = (await video.computeDuration()) * 60;
    expect(shown, "however slow this machine is").toBeCloseTo(packetCount, 1);
    // The old walk takes about a fifth longer than its input of thirty frames.
    expect(packetCount).toBeGreaterThan(32);
    expect(packetCount).toBeLessThan(48);
    const state = () => page.evaluate(() => [window.strut.state.playing, window.strut.state.frame]);
    await eventually(state, "afterwards all is as it was").toEqual([false, 60]);
  });
});
