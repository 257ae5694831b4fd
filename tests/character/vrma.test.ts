/** VRM Animation export: three-vrm-animation plays the exported file on a VRM. */
import type { VRM } from "@pixiv/three-vrm";
import { createVRMAnimationClip, type VRMAnimation, VRMAnimationLoaderPlugin } from "@pixiv/three-vrm-animation";
import { AnimationMixer, Quaternion, Vector3 } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { expect, test } from "vitest";
import { bindCharacter } from "../../web/character/character";
import { vrmBone } from "../../web/character/vrm_humanoid";
import { vrmAnimation } from "../../web/formats/vrma";
import { createWorldPose, ROLES, type Role, worldFromLocal } from "../../web/humanoid";
import { movingAnimation, poseOf } from "../humanoid_animation";
import { FAMILIES, type Family } from "../rigs/families";
import { makeRig } from "../rigs/rig";
import { angleBetween } from "./compare";
import { loadVrm } from "./load_vrm";

const VRMS = FAMILIES.filter(({ vrm }) => vrm !== undefined);

async function readVrma(file: ArrayBuffer): Promise<VRMAnimation> {
  const loader = new GLTFLoader();
  loader.register((parser) => new VRMAnimationLoaderPlugin(parser));
  return ((await loader.parseAsync(file, "")).userData.vrmAnimations as VRMAnimation[])[0]!;
}

type Animation = ReturnType<typeof movingAnimation>;

/** Returns the difference between an animation and a VRM that plays a file of it. */
async function played(vrm: VRM, animation: Animation) {
  const clip = createVRMAnimationClip(await readVrma(vrmAnimation(animation).buffer), vrm);
  const mixer = new AnimationMixer(vrm.scene);
  mixer.clipAction(clip).play();
  const world = createWorldPose();
  // A VRM 0 faces the opposite direction.
  const facing = new Quaternion().setFromAxisAngle(new Vector3(0, 1, 0), vrm.meta.metaVersion === "0" ? Math.PI : 0);
  let [millimetres, degrees] = [0, 0];
  for (const frame of [0, 7, 30, 59]) {
    mixer.setTime(animation.times[frame]!);
    vrm.update(0);
    vrm.scene.updateMatrixWorld(true);
    worldFromLocal(animation.proportions, poseOf(animation, frame), world);
    for (const [j, role] of ROLES.entries()) {
      const position = new Vector3().fromArray(world.positions, 3 * j).applyQuaternion(facing);
      const rotation = new Quaternion().fromArray(world.rotations, 4 * j).premultiply(facing);
      rotation.multiply(facing.clone().invert());
      const [raw, normalized] = bonesOf(vrm, role);
      millimetres = Math.max(millimetres, 1000 * raw.getWorldPosition(new Vector3()).distanceTo(position));
      degrees = Math.max(degrees, angleBetween(normalized.getWorldQuaternion(new Quaternion()), rotation));
    }
  }
  return { millimetres, degrees };
}

function bonesOf({ humanoid }: VRM, role: Role) {
  const bone = vrmBone(role) as Parameters<VRM["humanoid"]["getRawBoneNode"]>[0];
  return [humanoid.getRawBoneNode(bone)!, humanoid.getNormalizedBoneNode(bone)!] as const;
}

/** Returns the body of a character, as the character measures it. */
async function bodyOf(family: Family): Promise<Float32Array> {
  const character = await bindCharacter(await loadVrm(makeRig(family).glb.buffer));
  const { proportions } = character;
  character.dispose();
  return proportions;
}

test.each(VRMS)("a $name of the same proportions stands where the file says", async (family) => {
  // Without a joint between spine and chest, like the animation.
  const same = { ...family, trunk: [] };
  const { millimetres, degrees } = await played(
    await loadVrm(makeRig(same).glb.buffer),
    movingAnimation(await bodyOf(same)),
  );
  console.info(`${family.name}: ${millimetres.toFixed(4)} mm, ${degrees.toFixed(5)}°`);
  expect(millimetres).toBeLessThan(0.1);
  expect(degrees).toBeLessThan(0.01);
});

test.each(VRMS)("a $name of another body is turned as the file says", async (family) => {
  for (const other of [family, { ...family, size: 0.7, shape: { left_upper_leg: 0.8, right_upper_leg: 0.8 } }]) {
    const { degrees } = await played(await loadVrm(makeRig(other).glb.buffer), movingAnimation());
    console.info(`${family.name} × ${other.size}: ${degrees.toFixed(5)}°`);
    expect(degrees).toBeLessThan(0.01);
  }
});
