/**
 * Characters that a user drops on the page: they perform, are credited, refused with a message, exported and removed.
 */
import type { Page } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import { chunksOf } from "../../web/character/glb_patch";
import { loadCharacter } from "../../web/character/load";
import { vrmAnimation } from "../../web/formats/vrma";
import { movingAnimation } from "../humanoid_animation";
import { FAMILIES, type Family } from "../rigs/families";
import { type Changes, makeRig } from "../rigs/rig";
import { axeFaults } from "./axe";
import { drawn, dropFile, eventually, inputName, openSite, saved, screenshot } from "./browser";

let page: Page;
let close: () => Promise<void>;
beforeAll(async () => {
  ({ page, close } = await openSite({ hash: "styles=proud:1", size: { width: 1440, height: 900 }, theme: "light" }));
});
afterAll(() => close());

const family = (name: string): Family => FAMILIES.find((each) => each.name === name)!;
const drop = (name: string, bytes: Uint8Array) => dropFile(page, name, bytes);
const dropRig = (name: string, changes?: Changes) => drop(`${name}.glb`, makeRig(family(name), changes).glb);
/** Returns the performing character's name; empty for the mannequin. */
const performer = async () => ((await page.locator(".cast").isVisible()) ? page.locator(".cast-name").innerText() : "");
const alert = () => page.getByRole("alert").textContent();
/** Returns the height of the body in the picture, from head to feet. */
const height = () =>
  page.evaluate(() => {
    const { strut } = window as unknown as { strut: { jointScreenPosition(role: string): { y: number } } };
    return strut.jointScreenPosition("left_foot").y - strut.jointScreenPosition("head").y;
  });

test("a character performs, with its author's name, in its own proportions", async () => {
  const before = await height();
  await dropRig("chibi");
  await eventually(performer).toBe("chibi");
  // The camera frames its height, of which the head is a third: the joint of the head is lower in the picture than the
  // mannequin's.
  await eventually(height).toBeLessThan(0.85 * before);
  await drawn(page, 10);
  await screenshot(page, "character-chibi");

  await dropRig("VRM 1");
  await eventually(performer).toBe("Mannequin");
  await eventually(() => page.locator(".cast").getByRole("link", { name: "by Strut" }).isVisible()).toBe(true);
  expect(await alert()).toBe("");
  await eventually(() => axeFaults(page)).toEqual([]);
  await drawn(page, 10);
  await screenshot(page, "character-vrm");
});

test("its export is its own file with one more animation", async () => {
  const { glb } = makeRig(family("VRM 1"));
  const { name, bytes } = await saved(page, "GLB");
  expect(name).toMatch(/proud\.glb$/);
  const [own, out] = [chunksOf(glb), chunksOf(new Uint8Array(bytes))];
  expect(Buffer.compare(out.binary.subarray(0, own.binary.length), own.binary)).toBe(0);
  const animations = ({ json }: { json: unknown }) => (json as { animations?: unknown[] }).animations?.length ?? 0;
  expect(animations(out)).toBe(animations(own) + 1);
});

test("it stays while other views are looked at, and the mannequin comes back with a click", async () => {
  await page.getByRole("link", { name: "Compare" }).click();
  await eventually(() => page.title()).toContain("Compare");
  await page.getByRole("link", { name: "Play" }).click();
  await eventually(() => page.title()).toContain("Play");
  await eventually(performer).toBe("Mannequin");
  await page.getByRole("button", { name: "Back to the mannequin" }).click();
  await eventually(performer).toBe("");
});

test("motions in a file become inputs, without the figure and with it", async () => {
  const { times, ...moving } = movingAnimation();
  await drop("wave.vrma", vrmAnimation({ ...moving, times }));
  await eventually(() => inputName(page)).toBe("wave");
  await eventually(performer, "the mannequin goes on").toBe("");

  const character = await loadCharacter(makeRig(family("Mixamo in cm")).glb.buffer);
  const motion = { ...moving, timeOut: times };
  const once = await loadCharacter(character.toGLB({ ...motion, name: "first" }).buffer);
  await drop("dancer.glb", once.toGLB({ ...motion, name: "second" }));
  await eventually(() => inputName(page)).toBe("dancer, first");
  await eventually(performer).toBe("dancer");
  await eventually(() => page.getByRole("status").allTextContents()).toContainEqual(
    expect.stringContaining("The file holds one more motion"),
  );
  await page.getByLabel("Input motion").selectOption("dancer, second");
  await eventually(() => inputName(page)).toBe("dancer, second");
});

test("where names say nothing, a person is offered to check its joints", async () => {
  await dropRig("unnamed giant");
  await eventually(performer).toBe("unnamed giant");
  await page.getByRole("button", { name: "Check joints" }).click();
  const hips = page.getByRole("dialog").getByLabel("hips");
  await eventually(() => hips.locator("option:checked").innerText()).toBe("Bone.000");
  await screenshot(page, "character-joints");
  await page.getByRole("button", { name: "Use these joints" }).click();
  await eventually(() => page.getByRole("dialog").count()).toBe(0);
  await eventually(() => page.getByRole("button", { name: "Check joints" }).isVisible(), "a person has said so").toBe(
    false,
  );
});

test("where not everybody may perform it, a person is asked, and no is an answer", async () => {
  const restricted: Changes = {
    document: ({ extensions }) => {
      Object.assign(extensions!.VRMC_vrm!.meta as object, { name: "Restricted", avatarPermission: "onlyAuthor" });
    },
  };
  await dropRig("VRM 1", restricted);
  const dialog = page.getByRole("dialog", { name: "Restricted use" });
  expect(await dialog.innerText()).toContain("The author of “Restricted” restricts who may perform with it.");
  await dialog.getByRole("button", { name: "Cancel" }).click();
  await eventually(() => dialog.count()).toBe(0);
  expect(await performer()).toBe("unnamed giant");
  expect(await alert()).toBe("");
  await dropRig("VRM 1", restricted);
  await dialog.getByRole("button", { name: "I have permission" }).click();
  await eventually(performer).toBe("Restricted");
});

test("where its author forbids to change it, only the motion is exported", async () => {
  await dropRig("VRM 1", {
    document: ({ extensions }) => {
      Object.assign(extensions!.VRMC_vrm!.meta as object, { name: "As it is", modification: "prohibited" });
    },
  });
  await eventually(performer).toBe("As it is");
  await page.getByRole("button", { name: "Export" }).click();
  await page.locator(".export-menu").getByRole("button", { name: /^GLB/ }).click();
  await eventually(alert).toContain("does not allow redistribution with a new motion");
  expect((await saved(page, "VRMA")).name).toMatch(/\.vrma$/);
  await page.getByRole("alert").getByRole("button").first().click();
});

test("a file that is none gets a sentence, and who performs goes on", async () => {
  const { glb } = makeRig(family("VRM 0"));
  const refused: [string, Uint8Array, string][] = [
    ["cut.glb", glb.subarray(0, glb.length / 2), "This file is incomplete"],
    ["old.fbx", new TextEncoder().encode("; FBX 6.1.0 project file\nFBXVersion: 6100\n"), "FBX 6.1"],
    [
      "parts.gltf",
      new TextEncoder().encode('{"asset":{"version":"2.0"},"buffers":[{"uri":"parts.bin","byteLength":4}]}'),
      "in another file: parts.bin",
    ],
  ];
  for (const [name, bytes, sentence] of refused) {
    await drop(name, bytes);
    await eventually(alert).toContain(sentence);
    expect(await performer()).toBe("As it is");
    await page.getByRole("alert").getByRole("button").first().click();
  }
});
