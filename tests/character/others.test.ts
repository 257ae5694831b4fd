/** Third-party characters: bound correctly, or refused with the information that the user needs to continue. */
import { validateBytes } from "gltf-validator";
import {
  AnimationClip,
  AnimationMixer,
  type Bone,
  Box3,
  Frustum,
  Matrix4,
  Mesh,
  NumberKeyframeTrack,
  type Object3D,
  PerspectiveCamera,
  QuaternionKeyframeTrack,
  Skeleton,
  type SkinnedMesh,
  Vector3,
  VectorKeyframeTrack,
} from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { beforeAll, describe, expect, test } from "vitest";
import { bindCharacter } from "../../web/character/character";
import { converted } from "../../web/character/convert";
import { JointsError } from "../../web/character/joints_error";
import { type LoadCharacterOptions, loadCharacter, loadMotions } from "../../web/character/load";
import { DEFAULT_PROPORTIONS, JOINT, POSE_FLOATS, type Role, restPose } from "../../web/humanoid";
import { movingAnimation } from "../humanoid_animation";
import { FAMILIES } from "../rigs/families";
import { othersAbsent, rigOfOthers, withoutPictures } from "../rigs/others";
import { makeRig } from "../rigs/rig";

beforeAll(withoutPictures);

const load = (name: string, options: LoadCharacterOptions = {}) =>
  loadCharacter(rigOfOthers(name).buffer, { glb: false, ...options });
const mixamo = () => makeRig(FAMILIES.find(({ name }) => name === "Mixamo in cm")!);
const read = (glb: ArrayBuffer) => new GLTFLoader().parseAsync(glb, "");

/** Characters that are bound without help. */
const BOUND = [
  "m2m-sophia.glb",
  "m2m-sample-rig.glb",
  "Geno.fbx",
  "RobotExpressive.glb",
  "quaternius_Male_Casual.fbx",
  "rocketbox_Female_Adult_01.fbx",
  "valid_meshopt.glb",
  "HVGirl.glb",
];

/** Returns the node of a role. */
function nodeOf(character: { object: Object3D; roles: Partial<Record<Role, string>> }, role: Role): Object3D {
  let found: Object3D | undefined;
  character.object.traverse((node) => {
    if ((node.userData.name ?? node.userData.originalName ?? node.name) === character.roles[role]) found ??= node;
  });
  return found!;
}

const placeOf = (node: Object3D) => node.getWorldPosition(new Vector3());

describe.skipIf(othersAbsent)("a character of other people", () => {
  test.each(BOUND)("%s has all limbs, faces forward and stands on the ground", async (name) => {
    const character = await load(name);
    character.setBody(DEFAULT_PROPORTIONS);
    character.apply(restPose());
    character.object.updateMatrixWorld(true);
    const at = (role: Role) => placeOf(nodeOf(character, role));
    const legs = character.proportions[1]! / DEFAULT_PROPORTIONS[1]!;
    const lowest = new Box3().setFromObject(character.object, true).min.y;
    console.info(
      `${name}: soles ${(100 * lowest).toFixed(2)} cm, legs ${legs.toFixed(2)}, ${character.notes.join(" ")}`,
    );
    expect(Math.abs(lowest)).toBeLessThan(0.01 * Math.max(1, legs));
    // The person's left is at +x when facing +z.
    expect(at("left_hand").x).toBeGreaterThan(at("right_hand").x);
    expect(at("left_foot").x).toBeGreaterThan(at("right_foot").x);
    expect(at("chest").y).toBeGreaterThan(at("hips").y);
    character.dispose();
  });

  test.each(["RobotExpressive.glb", "quaternius_Male_Casual.fbx"])(
    "the feet of %s hang from the root, and go with its legs",
    async (name) => {
      const character = await load(name);
      const { poses } = movingAnimation();
      const lengths = new Set<string>();
      const clip = character.toClip({
        name: "moving",
        proportions: DEFAULT_PROPORTIONS,
        poses,
        timeOut: movingAnimation().times,
      });
      const mixer = new AnimationMixer(character.object);
      mixer.clipAction(clip).play();
      const feet = (["left", "right"] as const).flatMap((side) => [
        nodeOf(character, `${side}_lower_leg`),
        nodeOf(character, `${side}_foot`),
      ]);
      for (const frame of [0, 20, 40]) {
        character.setBody(DEFAULT_PROPORTIONS);
        character.apply(poses.subarray(frame * POSE_FLOATS, (frame + 1) * POSE_FLOATS));
        character.object.updateMatrixWorld(true);
        const applied = feet.map(placeOf);
        lengths.add(applied[0]!.distanceTo(applied[1]!).toFixed(3));
        mixer.setTime(movingAnimation().times[frame]!);
        character.object.updateMatrixWorld(true);
        for (const [i, node] of feet.entries()) expect(placeOf(node).distanceTo(applied[i]!)).toBeLessThan(1e-3);
      }
      expect(lengths.size, "the shin has one length").toBe(1);
      character.dispose();
    },
  );

  test("a fox is refused with its joints, and taken if a person says so", async () => {
    const error = await load("Fox.glb").catch((thrown: unknown) => thrown);
    expect(error).toBeInstanceOf(JointsError);
    const { message, joints, roles, missing } = error as JointsError;
    expect(message).toContain("stands on four legs");
    expect(joints).toContain("b_Hip_01");
    expect(missing).toEqual([]);
    const character = await load("Fox.glb", { roles: { ...roles } });
    expect(character.roles.hips).toBe("b_Hip_01");
    expect(character.notes.join(" ")).not.toContain(" 0.0 cm");
    character.dispose();
  });

  test("a body of another size than people is said to be one", async () => {
    expect((await load("HVGirl.glb")).notes.join(" ")).toContain("23");
  });

  test.each(["m2m-sample-rig.glb", "HVGirl.glb"])("%s is bound the same in the middle of a motion", async (name) => {
    const proportionsAt = async (time: number | undefined) => {
      const { scene, animations } = await read(rigOfOthers(name).buffer);
      if (time !== undefined) {
        const mixer = new AnimationMixer(scene);
        mixer.clipAction(animations.find(({ name }) => /walk/i.test(name)) ?? animations[0]!).play();
        mixer.setTime(time);
      }
      const character = await bindCharacter(scene);
      const { proportions } = character;
      character.dispose();
      return proportions;
    };
    const still = await proportionsAt(undefined);
    for (const time of [0.2, 0.5]) {
      const moving = await proportionsAt(time);
      const farthest = Math.max(...still.map((value, i) => Math.abs(value - moving[i]!)));
      expect(farthest, `at ${time} s`).toBeLessThan(0.005 * still[1]!);
    }
  });
});

test("three.js draws a character wherever it goes", async () => {
  const { scene } = await read(mixamo().glb.buffer);
  const character = await bindCharacter(scene);
  const pose = restPose();
  const camera = new PerspectiveCamera(50, 1, 0.1, 100);
  for (const x of [0, 3, 30]) {
    pose[0] = x;
    character.apply(pose);
    scene.updateMatrixWorld(true);
    camera.position.set(x * (character.proportions[1]! / DEFAULT_PROPORTIONS[1]!), 1, 4);
    camera.updateMatrixWorld(true);
    const seen = new Frustum().setFromProjectionMatrix(
      new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse),
    );
    scene.traverse((node) => {
      // As WebGLRenderer checks.
      if (node instanceof Mesh) expect(!node.frustumCulled || seen.intersectsObject(node), `at ${x} m`).toBe(true);
    });
  }
  character.dispose();
});

test("a root that was saved in the middle of a motion moves no pose", async () => {
  const family = FAMILIES.find(({ name }) => name === "Biped")!;
  const extentOf = async (isMoving: boolean) => {
    const { scene } = await read(makeRig(family).glb.buffer);
    scene.updateMatrixWorld(true);
    const root = scene.getObjectByName(family.root!)!;
    scene.traverse((node) => {
      const mesh = node as SkinnedMesh;
      if (!mesh.isSkinnedMesh) return;
      const { bones, boneInverses } = mesh.skeleton;
      mesh.skeleton = new Skeleton([...bones, root as Bone], [...boneInverses, root.matrixWorld.clone().invert()]);
      if (!isMoving) return;
      for (const [i, bone] of bones.entries()) bone.rotateZ(0.05 * ((i % 3) - 1.3));
    });
    if (isMoving) root.position.y -= 0.1;
    const character = await bindCharacter(scene);
    character.setBody(character.proportions);
    const pose = restPose();
    pose[1] = character.proportions[1]!;
    character.apply(pose);
    scene.updateMatrixWorld(true);
    const { min, max } = new Box3().setFromObject(scene, true);
    character.dispose();
    return { min, max };
  };
  const [modelled, moving] = [await extentOf(false), await extentOf(true)];
  expect(moving.min.distanceTo(modelled.min)).toBeLessThan(0.01);
  expect(moving.max.distanceTo(modelled.max)).toBeLessThan(0.01);
});

test("a skin that was left over does not limit the joints", async () => {
  const { scene } = await read(mixamo().glb.buffer);
  scene.traverse((node) => {
    const mesh = node as SkinnedMesh;
    if (!mesh.isSkinnedMesh) return;
    const hand = mesh.skeleton.bones.findIndex(({ name }) => name.endsWith("LeftHand"));
    mesh.geometry.attributes.skinIndex!.array.fill(0);
    mesh.skeleton = new Skeleton([mesh.skeleton.bones[hand]!], [mesh.skeleton.boneInverses[hand]!]);
  });
  const character = await bindCharacter(scene);
  expect(Object.keys(character.roles)).toHaveLength(21);
  character.dispose();
});

test("all that is missing is said at once, with the joints there are", async () => {
  const rig = makeRig(FAMILIES.find(({ name }) => name === "Mixamo in cm")!, {
    document: ({ nodes }) => {
      const named = (name: string) => nodes.findIndex((node) => String(node.name).endsWith(name));
      const gone = ["LeftForeArm", "RightForeArm"].map(named);
      for (const node of nodes)
        if (Array.isArray(node.children)) {
          const kept = (node.children as number[]).filter((child) => !gone.includes(child));
          if (kept.length > 0) node.children = kept;
          else delete node.children;
        }
    },
  });
  const error = await loadCharacter(rig.glb.buffer).catch((thrown: unknown) => thrown);
  expect(error).toBeInstanceOf(JointsError);
  const { missing, roles, joints, code, message } = error as JointsError;
  expect(code).toBe("bad-file");
  expect(missing).toEqual(["left_lower_arm", "left_hand", "right_lower_arm", "right_hand"]);
  expect(message).toContain("left elbow");
  expect(roles.left_lower_leg).toMatch(/LeftLeg$/);
  expect(joints.some((name) => name.endsWith("LeftArm"))).toBe(true);
});

test("soles of a robe's hem are forgotten again", async () => {
  const skirt = async (drop: number) => {
    const { scene } = await read(mixamo().glb.buffer);
    scene.traverse((node) => {
      const mesh = node as SkinnedMesh;
      if (!mesh.isSkinnedMesh) return;
      const { position, skinIndex } = mesh.geometry.attributes;
      const foot = mesh.skeleton.bones.findIndex(({ name }) => name.endsWith("LeftFoot"));
      // Centimetres, Z up: an object far below the feet, attached to one of them.
      for (let v = 0; v < position!.count; v++)
        if (skinIndex!.getX(v) === foot) position!.setZ(v, position!.getZ(v) - drop);
    });
    const character = await bindCharacter(scene, drop === 0 ? {} : { metresPerUnit: 1 });
    const { proportions, notes } = character;
    character.dispose();
    return { height: proportions[JOINT.hips * 3 + 1]!, notes: notes.join(" ") };
  };
  const [plain, hem] = [await skirt(0), await skirt(200)];
  expect(hem.height).toBeGreaterThan(0.9 * plain.height);
  expect(hem.height).toBeLessThan(1.1 * plain.height);
  expect(hem.notes).toContain("height was guessed");
});

test("a skin alone is bound with the bones beside it", async () => {
  const { scene } = await read(mixamo().glb.buffer);
  let skin: SkinnedMesh | undefined;
  scene.traverse((node) => {
    if ((node as SkinnedMesh).isSkinnedMesh) skin = node as SkinnedMesh;
  });
  const character = await bindCharacter(skin!);
  expect(Object.keys(character.roles)).toHaveLength(21);
  character.dispose();
});

test("a clip keeps what else the clip moves that was styled, in the time of the styled motion", async () => {
  const { scene } = await read(mixamo().glb.buffer);
  const character = await bindCharacter(scene);
  const { times, ...moving } = movingAnimation();
  const slower = { ...moving, timeOut: times.map((secs) => 2 * secs) };
  const finger = scene.getObjectByName("mixamorigLeftHandIndex1")!;
  const duration = times.at(-1)!;
  const curl = new QuaternionKeyframeTrack(`${finger.name}.quaternion`, [0, duration], [0, 0, 0, 1, 0, 0, 1, 0]);
  const smile = new NumberKeyframeTrack("Body.morphTargetInfluences[0]", [0, duration / 2], [0, 1]);
  const hips = new VectorKeyframeTrack("mixamorigHips.position", [0], [0, 5, 0]);
  const keep = new AnimationClip("own", duration, [curl, smile, hips]);
  const clip = character.toClip(slower, { keep });
  const kept = (name: string) => clip.tracks.filter((track) => track.name === name);
  expect(kept(curl.name)[0]!.times[1]).toBeCloseTo(clip.duration, 5);
  expect(kept(smile.name)[0]!.times[1]).toBeCloseTo(clip.duration / 2, 1);
  expect(kept("mixamorigHips.position")).toHaveLength(1);
  expect(curl.times[1]).toBeCloseTo(duration, 5);
  character.dispose();
});

test.skipIf(othersAbsent)("motions of a file are read by the joints that a person names", async () => {
  const source = rigOfOthers("Fox.glb").buffer;
  const error = (await load("Fox.glb").catch((thrown: unknown) => thrown)) as JointsError;
  const motions = await loadMotions(source, { roles: { ...error.roles } });
  expect(motions.map(({ name }) => name)).toContain("Walk");
});

test("a motion that moves nothing is not exported", async () => {
  class Reader {
    result: ArrayBuffer | undefined;
    onloadend = () => {};
    async readAsArrayBuffer(blob: Blob) {
      this.result = await blob.arrayBuffer();
      this.onloadend();
    }
  }
  Object.assign(globalThis, { FileReader: Reader });
  const { scene } = await read(mixamo().glb.buffer);
  // A clip without tracks, and one with missing nodes, as after the removal of a mesh.
  const lost = new VectorKeyframeTrack("nobody.position", [0, 1], [0, 0, 0, 1, 1, 1]);
  scene.animations = [new AnimationClip("empty", 1, []), new AnimationClip("lost", 1, [lost])];
  const { file } = await converted(scene);
  const { messages } = (await validateBytes(file)).issues;
  expect(messages.filter(({ code }) => code === "EMPTY_ENTITY")).toEqual([]);
});
