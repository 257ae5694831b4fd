/** Third-party characters on the page: textured, of other formats, of other sizes, with joints that are not found. */
import { readFileSync } from "node:fs";
import type { Page } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import { othersAbsent, rigOfOthers } from "../rigs/others";
import { drawn, dropFile, dropFiles, eventually, inputName, openSite, screenshot } from "./browser";
import { colouredPixels } from "./pixels";

let site: Awaited<ReturnType<typeof openSite>>;
let page: Page;
beforeAll(async () => {
  // Without the ghost and the corners of the styles, which are coloured.
  site = await openSite({ hash: "styles=proud:1&ghost=off", size: { width: 1280, height: 800 }, theme: "light" });
  page = site.page;
});
afterAll(() => site.close());

const performer = async () => ((await page.locator(".cast").isVisible()) ? page.locator(".cast-name").innerText() : "");
const dropRig = (name: string) => dropFile(page, name, rigOfOthers(name));

/** Returns the text of the toasts. */
const said = async () => (await page.getByRole("status").allTextContents()).join(" ");

/** Returns the picture of the stage, without the panels around it. */
async function pictureOfStage(): Promise<Buffer> {
  await drawn(page, 10);
  const box = (await page.locator(".stage").first().boundingBox())!;
  const [width, height] = [0.4 * box.width, 0.8 * box.height];
  return page.screenshot({
    clip: { x: box.x + (box.width - width) / 2, y: box.y + (box.height - height) / 2, width, height },
  });
}

test.skipIf(othersAbsent)("a textured character has its colours, under the page's own policy", async () => {
  await dropRig("m2m-sophia.glb");
  await eventually(performer).toBe("m2m-sophia");
  await eventually(async () => colouredPixels(site.browser, await pictureOfStage())).toBeGreaterThan(1000);
  await screenshot(page, "others-m2m-sophia");
});

/** Characters that are bound without help, and the messages about them. */
const OTHERS: readonly [file: string, told: string][] = [
  ["m2m-sample-rig.glb", ""],
  ["Geno.fbx", ""],
  ["RobotExpressive.glb", ""],
  ["quaternius_Male_Casual.fbx", ""],
  ["rocketbox_Female_Adult_01.fbx", "textures could not be loaded"],
  ["valid_meshopt.glb", ""],
  ["HVGirl.glb", "to the size of a person"],
];

test.skipIf(othersAbsent).each(OTHERS)("%s performs", async (file, told) => {
  const name = file.replace(/\.[^.]*$/, "");
  await dropRig(file);
  await eventually(performer).toBe(name);
  if (told) await eventually(said).toContain(told);
  await page.getByLabel("Input motion").selectOption("neutral walk");
  // A character is displayed in a person's size, whatever the unit of its file: between a third and nine tenths of the
  // picture.
  const heightOf = () =>
    page.evaluate(() => {
      const { strut } = window as unknown as { strut: { jointScreenPosition(role: string): { y: number } } };
      return strut.jointScreenPosition("left_foot").y - strut.jointScreenPosition("head").y;
    });
  await eventually(heightOf).toBeGreaterThan(120);
  await eventually(heightOf).toBeLessThan(600);
  await drawn(page, 20);
  await screenshot(page, `others-${name}`);
});

test("a character that is compressed with Draco performs, under the page's own policy", async () => {
  await dropFile(page, "mixamo_draco.glb", readFileSync(new URL("../rigs/mixamo_draco.glb", import.meta.url)));
  await eventually(performer).toBe("mixamo_draco");
  await drawn(page, 20);
  await screenshot(page, "others-draco");
});

test.skipIf(othersAbsent)("a character with a walk among its motions begins with that", async () => {
  await dropRig("HVGirl.glb");
  await eventually(() => inputName(page)).toBe("HVGirl, Walking");
  await drawn(page, 20);
  await screenshot(page, "others-own-walk");
  await page.getByLabel("Input motion").selectOption("neutral walk");
});

test.skipIf(othersAbsent)("a .gltf and the files beside it are dropped together", async () => {
  const [document, buffer, texture] = ["manny_med_mod.gltf", "manny_med_mod.bin", "mannequin_texture.png"];
  const drop = (...names: (string | undefined)[]) =>
    dropFiles(page, Object.fromEntries(names.map((name) => [name!, rigOfOthers(`kaykit/${name}`)])));
  await drop(document);
  await eventually(() => page.getByRole("alert").textContent()).toContain("manny_med_mod.bin");
  await drop(document, buffer, texture);
  await eventually(performer).toBe("manny_med_mod");
  await eventually(async () => colouredPixels(site.browser, await pictureOfStage())).toBeGreaterThan(1000);
  await screenshot(page, "others-kaykit");
});

test.skipIf(othersAbsent)("an animal is asked about, and performs only if a person says so", async () => {
  await dropRig("Fox.glb");
  const dialog = page.getByRole("dialog", { name: "Joint mapping" });
  await eventually(() => dialog.innerText()).toContain("stands on four legs");
  await eventually(() => dialog.getByLabel("hips").locator("option:checked").innerText()).toBe("b_Hip_01");
  await screenshot(page, "others-fox-joints");
  await dialog.getByRole("button", { name: "Cancel" }).click();
  await eventually(() => dialog.count()).toBe(0);
  expect(await performer()).toBe("manny_med_mod");
});
