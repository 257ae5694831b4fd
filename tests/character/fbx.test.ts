/** FBX files as Mixamo writes them, and their export as GLB. */
import { validateBytes } from "gltf-validator";
import { type AnimationClip, AnimationMixer, type Object3D, Quaternion, SkinnedMesh, Vector3 } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { expect, test, vi } from "vitest";
import { loadCharacter, loadMotions } from "../../web/character/load";
import { DEFAULT_PROPORTIONS, ROLES, restPose } from "../../web/humanoid";
import { movingAnimation, poseOf } from "../humanoid_animation";
import { FAMILIES, type Family } from "../rigs/families";
import { fbxFile } from "../rigs/fbx";
import { makeRig } from "../rigs/rig";
import { type Difference, farthest } from "./compare";

const Z_UP: Family = FAMILIES.find(({ name }) => name === "Mixamo in cm")!;
const MIXAMO: Family = { ...Z_UP, armature: new Quaternion() };

const { times, ...moving } = movingAnimation();
const motion = { ...moving, timeOut: times };

test.each([
  ["+Y", MIXAMO],
  ["+Z", Z_UP],
])("FBX with %s up is bound as the same rig in GLB is", async (up, family) => {
  const fbx = await loadCharacter(fbxFile(family).buffer);
  const glb = await loadCharacter(makeRig(family).glb.buffer);
  expect(fbx.roles).toEqual(Object.fromEntries(ROLES.map((role, j) => [role, MIXAMO.joints[j]])));
  expect(fbx.confidence).toBe(1);
  for (const [i, offset] of fbx.proportions.entries()) expect(offset).toBeCloseTo(glb.proportions[i]!, 4);
  let farthest = 0;
  for (const character of [fbx, glb]) character.setBody(motion.proportions);
  for (const frame of [0, 20, 45]) {
    for (const character of [fbx, glb]) {
      character.apply(poseOf(motion, frame));
      character.object.updateMatrixWorld(true);
    }
    for (const name of MIXAMO.joints) {
      const [a, b] = [fbx, glb].map(({ object }) => joint(object, name).getWorldPosition(new Vector3()));
      farthest = Math.max(farthest, 1000 * a!.distanceTo(b!));
    }
  }
  console.info(`FBX with ${up} up beside GLB: ${farthest.toFixed(4)} mm`);
  expect(farthest).toBeLessThan(0.1);
  for (const character of [fbx, glb]) character.dispose();
});

const joint = (object: Object3D, name: string) => object.getObjectByName(name.replace(":", ""))!;

test.each([
  [1, 0.941],
  [2.54, 0.941 * 2.54],
  // A body a hundred times as high as a person is scaled to a person's size, with a note.
  [100, DEFAULT_PROPORTIONS[1]!],
])("a unit of %d cm makes hips %d m high, and the soles stand on the ground", async (unitScaleFactor, height) => {
  const character = await loadCharacter(fbxFile(MIXAMO, { unitScaleFactor }).buffer);
  character.setBody(character.proportions);
  const pose = restPose();
  pose[1] = character.proportions[1]!;
  character.apply(pose);
  character.object.updateMatrixWorld(true);
  const hips = joint(character.object, character.roles.hips!).getWorldPosition(new Vector3());
  let lowest = Infinity;
  character.object.traverse((node) => {
    if (!(node instanceof SkinnedMesh)) return;
    for (let v = 0; v < node.geometry.attributes.position!.count; v++)
      lowest = Math.min(lowest, node.getVertexPosition(v, new Vector3()).applyMatrix4(node.matrixWorld).y);
  });
  console.info(`${unitScaleFactor} cm: hips at ${hips.y.toFixed(4)} m, soles at ${(100 * lowest).toFixed(3)} cm`);
  expect(hips.y / height).toBeCloseTo(1, 3);
  expect(Math.abs(lowest)).toBeLessThan(0.003);
  expect(character.notes.some((note) => note.includes("the size of a person"))).toBe(unitScaleFactor === 100);
  character.dispose();
});

test("an FBX character goes out as GLB, and is read back", async () => {
  // three.js's exporter needs it; browsers have it.
  vi.stubGlobal("FileReader", Reader);
  const clip = await walkOf(MIXAMO);
  const character = await loadCharacter(fbxFile(MIXAMO, { clip }).buffer);
  vi.unstubAllGlobals();
  const out = character.toGLB(motion);
  const { messages } = (await validateBytes(out)).issues;
  expect(messages.filter(({ severity }) => severity === 0)).toEqual([]);
  const read = await loadCharacter(out.slice().buffer);
  expect(read.roles).toEqual(character.roles);
  expect(read.motions.map(({ name }) => name)).toEqual(["walk", "moving"]);
  for (const [i, offset] of read.proportions.entries()) expect(offset).toBeCloseTo(character.proportions[i]!, 5);

  const gltf = await new GLTFLoader().parseAsync(out.buffer, "");
  const mixer = new AnimationMixer(gltf.scene);
  mixer.clipAction(gltf.animations.at(-1)!).play();
  character.setBody(motion.proportions);
  let off: Difference = { millimetres: 0, degrees: 0 };
  for (const frame of [0, 7, 30, 59]) {
    character.apply(poseOf(motion, frame));
    mixer.setTime(times[frame]!);
    for (const object of [character.object, gltf.scene]) object.updateMatrixWorld(true);
    const inFile = (name: string) => gltf.parser.json.nodes.findIndex((node: { name: string }) => node.name === name);
    for (const name of MIXAMO.joints) {
      const twin = await gltf.parser.getDependency("node", inFile(name));
      off = farthest([[joint(character.object, name), twin]], off);
    }
  }
  console.info(`FBX as GLB: ${off.millimetres.toFixed(4)} mm, ${off.degrees.toFixed(5)}°`);
  expect(off.millimetres).toBeLessThan(0.1);
  expect(off.degrees).toBeLessThan(0.01);
  for (const each of [character, read]) each.dispose();
});

test("an FBX character that is not to go out is not converted", async () => {
  const character = await loadCharacter(fbxFile(MIXAMO).buffer, { glb: false });
  expect(() => character.toGLB(motion)).toThrow(/no motion can be added/);
  character.dispose();
});

test.each([
  ["a key is infinite", (clip: AnimationClip) => (clip.tracks[1]!.values[2] = Number.POSITIVE_INFINITY)],
  ["a hip flies off", (clip: AnimationClip) => (clip.tracks[0]!.values[4] = 1e12)],
  ["times fall", (clip: AnimationClip) => (clip.tracks[1]!.times[3] = 0)],
])("FBX whose keys would keep three.js busy for ever is refused: %s", async (_, damage) => {
  const clip = await walkOf(MIXAMO);
  damage(clip);
  for (const load of [loadCharacter, loadMotions])
    await expect(load(fbxFile(MIXAMO, { clip }).buffer)).rejects.toMatchObject({
      code: "bad-file",
      message: "The motion in this file has keyframes out of order, or out of range.",
    });
});

test("FBX 6.1 is refused in words", async () => {
  await expect(loadCharacter(fbxFile(MIXAMO, { version: 6100 }).buffer)).rejects.toMatchObject({
    code: "bad-file",
    message: "This file is FBX 6.1. Expected version 7 or newer.",
  });
});

/** The part of `FileReader` that three.js's exporter uses. */
class Reader {
  result: ArrayBuffer | undefined;
  onloadend: (() => void) | undefined;

  readAsArrayBuffer(blob: Blob): void {
    void blob.arrayBuffer().then((buffer) => {
      this.result = buffer;
      this.onloadend?.();
    });
  }
}

/** Returns a clip of a family's rig in which everything moves. */
async function walkOf(family: Family): Promise<AnimationClip> {
  const character = await loadCharacter(makeRig(family).glb.buffer);
  const clip = character.toClip(motion, { name: "walk" });
  character.dispose();
  return clip;
}
