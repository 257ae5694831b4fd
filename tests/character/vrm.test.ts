/** VRM 0 and 1 with the real three-vrm: bones, springs and clips. */
import { type VRM, VRMLoaderPlugin } from "@pixiv/three-vrm";
import { AnimationMixer, type Object3D, Quaternion, Vector3 } from "three";
import { expect, test } from "vitest";
import { bindCharacter } from "../../web/character/character";
import { loadCharacter } from "../../web/character/load";
import type { Character } from "../../web/character/types";
import { ROLES } from "../../web/humanoid";
import { movingAnimation, poseOf } from "../humanoid_animation";
import { FAMILIES } from "../rigs/families";
import { type GltfDocument, makeRig } from "../rigs/rig";
import { angleBetween, type Difference, farthest } from "./compare";
import { loadVrm } from "./load_vrm";

const VRMS = FAMILIES.filter(({ vrm }) => vrm !== undefined);

/** Loads the character of a file, with three-vrm's object. */
async function load(file: ArrayBuffer): Promise<{ character: Character; vrm: VRM }> {
  let read: VRM | undefined;
  class Watched extends VRMLoaderPlugin {
    override async afterRoot(gltf: Parameters<VRMLoaderPlugin["afterRoot"]>[0]) {
      await super.afterRoot(gltf);
      read = gltf.userData.vrm as VRM;
    }
  }
  const character = await loadCharacter(file, {}, async () => ({ VRMLoaderPlugin: Watched }));
  return { character, vrm: read! };
}

const { times, ...moving } = movingAnimation();
const motion = { ...moving, timeOut: times };
const pose = (frame: number) => poseOf(motion, frame);

const named = (object: Object3D, name: string) => object.getObjectByName(name)!;

test.each(VRMS)("the raw bones of $name perform, and three-vrm leaves them", async (family) => {
  const { character, vrm } = await load(makeRig(family).glb.buffer);
  expect(Object.keys(character.roles)).toHaveLength(ROLES.length);
  expect(vrm.humanoid.autoUpdateHumanBones).toBe(false);
  character.setBody(motion.proportions);
  character.apply(pose(30));
  const bones = Object.values(vrm.humanoid.rawHumanBones).map(({ node }) => node.quaternion.clone());
  character.update(1 / 60);
  const after = Object.values(vrm.humanoid.rawHumanBones).map(({ node }) => node.quaternion);
  for (const [i, bone] of bones.entries()) expect(after[i]!.equals(bone)).toBe(true);
  expect(bones.filter((bone) => angleBetween(bone, new Quaternion()) > 1).length).toBeGreaterThan(15);
  character.dispose();
});

test.each(VRMS)("the hair of $name swings, in steps of at most 1/30 s, and settles", async (family) => {
  const { glb } = makeRig(family);
  const [a, b] = [await load(glb.slice().buffer), await load(glb.slice().buffer)];
  const [lockA, lockB] = [a, b].map(({ vrm }) => named(vrm.scene, family.hair[0]!)) as [Object3D, Object3D];
  const rest = lockA.quaternion.clone();
  for (const { character } of [a, b]) character.setBody(motion.proportions);
  for (let frame = 0; frame < 30; frame++) {
    // A tab that was hidden for a minute advances as far as one that missed a frame.
    for (const [{ character, vrm }, step] of [
      [a, 60],
      [b, 1 / 30],
    ] as const) {
      character.apply(pose(frame));
      vrm.scene.updateMatrixWorld(true);
      character.update(step);
    }
  }
  expect(angleBetween(lockA.quaternion, rest)).toBeGreaterThan(1);
  expect(angleBetween(lockA.quaternion, lockB.quaternion)).toBe(0);
  a.character.settle();
  expect(angleBetween(lockA.quaternion, rest)).toBeLessThan(1e-4);
  for (const { character } of [a, b]) character.dispose();
});

test.each(VRMS)("after a cut the hair of $name hangs where the head is now", async (family) => {
  const { character, vrm } = await load(makeRig(family).glb.buffer);
  const lock = named(vrm.scene, family.hair[0]!);
  const rest = lock.quaternion.clone();
  character.setBody(motion.proportions);
  character.apply(pose(0));
  vrm.scene.updateMatrixWorld(true);
  character.settle();
  // 100 m away, before anything was drawn: hair that stayed behind would point back.
  const away = pose(0);
  away[2]! += 100;
  character.apply(away);
  character.settle();
  vrm.scene.updateMatrixWorld(true);
  character.update(1e-4);
  const angle = angleBetween(lock.quaternion, rest);
  console.info(`${family.name}: ${angle.toFixed(3)}° after the cut`);
  expect(angle).toBeLessThan(1);
  character.dispose();
});

/** Removes the joint between spine and chest from VRM's bones. */
const outside = (document: GltfDocument) => {
  const one = document.extensions?.VRMC_vrm?.humanoid as { humanBones: Record<string, unknown> } | undefined;
  if (one) {
    one.humanBones.chest = one.humanBones.upperChest;
    delete one.humanBones.upperChest;
  }
  const zero = document.extensions?.VRM?.humanoid as { humanBones: { bone: string }[] } | undefined;
  if (zero) {
    zero.humanBones = zero.humanBones.filter(({ bone }) => bone !== "chest");
    for (const entry of zero.humanBones) if (entry.bone === "upperChest") entry.bone = "chest";
  }
};

const TRUNKS = VRMS.flatMap((family) => [
  { family, name: family.name, document: () => {} },
  { family, name: `${family.name} with a joint that is no bone`, document: outside },
]);

test.each(TRUNKS)("a clip of normalized bones of $name does what apply does", async ({ name, family, document }) => {
  const { glb } = makeRig(family, { document });
  const vrm = await loadVrm(glb.slice().buffer);
  const character = await bindCharacter(await loadVrm(glb.slice().buffer));
  const clip = character.toClip(motion);
  expect(clip.tracks.filter((track) => track.name.startsWith("Normalized_")).length).toBeGreaterThanOrEqual(
    ROLES.length + 1,
  );
  const mixer = new AnimationMixer(vrm.scene);
  mixer.clipAction(clip).play();
  character.setBody(motion.proportions);
  const twins = boneTwins(character.object, vrm.scene, family.joints.concat(family.trunk));
  let off: Difference = { millimetres: 0, degrees: 0 };
  for (const frame of [0, 7, 30, 59]) {
    character.apply(pose(frame));
    mixer.setTime(times[frame]!);
    vrm.update(0);
    for (const scene of [character.object, vrm.scene]) scene.updateMatrixWorld(true);
    off = farthest(twins, off);
  }
  console.info(`${name}: ${off.millimetres.toFixed(4)} mm, ${off.degrees.toFixed(5)}°`);
  expect(off.millimetres).toBeLessThan(0.1);
  expect(off.degrees).toBeLessThan(0.01);
  character.dispose();
});

const boneTwins = (a: Object3D, b: Object3D, names: readonly string[]) =>
  names.map((name) => [named(a, name), named(b, name)] as const);

test.each(VRMS)(
  "a clip of $name stays right where the page has placed the character and it has performed",
  async (family) => {
    const vrm = await loadVrm(makeRig(family).glb.buffer);
    vrm.scene.position.set(3, 0, -2);
    const character = await bindCharacter(vrm);
    character.setBody(motion.proportions);
    character.apply(pose(50));
    const clip = character.toClip(motion);
    const hips = named(vrm.scene, family.joints[0]!);
    character.apply(pose(7));
    const expected = hips.getWorldPosition(new Vector3());
    const mixer = new AnimationMixer(vrm.scene);
    mixer.clipAction(clip).play();
    mixer.setTime(times[7]!);
    vrm.humanoid.autoUpdateHumanBones = true;
    vrm.update(0);
    expect(1000 * hips.getWorldPosition(new Vector3()).distanceTo(expected)).toBeLessThan(0.1);
    character.dispose();
  },
);
