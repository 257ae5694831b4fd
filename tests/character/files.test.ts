/** Import and export of character files: refused files with their messages, and exports that keep the model's bytes. */
import { validateBytes } from "gltf-validator";
import { AnimationMixer, Vector3 } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { expect, test } from "vitest";
import { bindCharacter } from "../../web/character/character";
import { chunksOf } from "../../web/character/glb_patch";
import { type LoadCharacterOptions, loadCharacter, loadMotions } from "../../web/character/load";
import { DEFAULT_PROPORTIONS, POSE_FLOATS } from "../../web/humanoid";
import { movingAnimation } from "../humanoid_animation";
import { FAMILIES, type Family } from "../rigs/families";
import { glbOf } from "../rigs/glb";
import { type Changes, makeRig } from "../rigs/rig";
import { type Difference, farthest, pairs } from "./compare";

const family = (name: string): Family => FAMILIES.find((each) => each.name === name)!;
const [VRM_1, VRM_0, MIXAMO] = ["VRM 1", "VRM 0", "Mixamo in cm"].map(family) as [Family, Family, Family];

const changed = (of: Family, document: NonNullable<Changes["document"]>) => makeRig(of, { document }).glb.buffer;

const refusal = (file: ArrayBuffer | Blob, options?: LoadCharacterOptions) =>
  loadCharacter(file, options).then(
    () => ({ code: "loaded", message: "" }),
    (error: { code: string; message: string }) => ({ code: error.code, message: error.message }),
  );

test.each(FAMILIES)("the $name performs from its file, and its export is read back", async (each) => {
  const { glb } = makeRig(each);
  const character = await loadCharacter(glb.slice().buffer);
  const { times, ...moving } = movingAnimation();
  const motion = { ...moving, timeOut: times };
  const out = character.toGLB(motion);

  const [before, after] = [chunksOf(glb).binary, chunksOf(out).binary];
  expect(after.length).toBeGreaterThan(before.length);
  expect(Buffer.compare(after.subarray(0, before.length), before)).toBe(0);
  // The validator also warns about the original: meshes below their armature, and the name of VRM 0's extension.
  const [was, is] = [await complaints(glb), await complaints(out)];
  expect(is).toEqual(was);
  expect(is.some(({ severity }) => severity === 0)).toBe(false);

  const read = await new GLTFLoader().parseAsync(out.buffer, "");
  const mixer = new AnimationMixer(read.scene);
  const clip = read.animations.at(-1)!;
  expect(clip.name).toBe("moving");
  mixer.clipAction(clip).play();
  character.setBody(motion.proportions);
  // The written file is read as a motion again, on the character's own body.
  const again = await bindCharacter(read);
  const poses = again.motions.at(-1)!;
  expect(poses).toMatchObject({ name: "moving", rateHz: 60 });
  expect(again.motions).toHaveLength(1);
  const twins = pairs(character.object, read.scene);
  let off: Difference = { millimetres: 0, degrees: 0 };
  for (const frame of [0, 7, 30, 59]) {
    character.apply(motion.poses.subarray(frame * POSE_FLOATS, (frame + 1) * POSE_FLOATS));
    mixer.setTime(times[frame]!);
    character.object.updateMatrixWorld(true);
    read.scene.updateMatrixWorld(true);
    off = farthest(twins, off);
  }
  console.info(`${each.name}: ${off.millimetres.toFixed(4)} mm, ${off.degrees.toFixed(5)}°`);
  expect(off.millimetres).toBeLessThan(0.1);
  expect(off.degrees).toBeLessThan(0.01);
  character.dispose();
});

/** Returns errors and warnings of Khronos' validator. */
async function complaints(file: Uint8Array) {
  const { messages } = (await validateBytes(file)).issues;
  return messages.flatMap(({ code, severity }) => (severity < 2 ? [{ code, severity }] : []));
}

test("a clip has a key a frame, and stays over its start if asked to", async () => {
  const character = await loadCharacter(makeRig(MIXAMO).glb.buffer);
  const { times, ...moving } = movingAnimation();
  const motion = { ...moving, timeOut: times };
  const mixer = new AnimationMixer(character.object);
  const clip = character.toClip(motion, { name: "away", inPlace: true });
  expect(clip.name).toBe("away");
  expect(clip.tracks.every((track) => track.times.length === times.length)).toBe(true);
  mixer.clipAction(clip).play();
  const hips = character.object.getObjectByName("mixamorigHips")!;
  const at = (seconds: number) => {
    mixer.setTime(seconds);
    character.object.updateMatrixWorld(true);
    return hips.getWorldPosition(new Vector3());
  };
  const [start, end] = [at(0), at(times.at(-1)! - 0.01)];
  // The hip joints stay in place; the hips swing about them.
  expect(Math.hypot(end.x - start.x, end.z - start.z)).toBeLessThan(0.15);
  character.dispose();
});

test("poses are refused unless they are 87 finite numbers", async () => {
  const character = await bindCharacter(await new GLTFLoader().parseAsync(makeRig(VRM_1).glb.buffer, ""));
  expect(() => character.apply(new Float32Array(86))).toThrow(/87 numbers, not 86/);
  expect(() => character.apply(new Float32Array(87).fill(Number.NaN))).toThrow(/finite/);
  expect(() => character.setBody(DEFAULT_PROPORTIONS.subarray(3))).toThrow(/63/);
  character.dispose();
  expect(() => character.apply(new Float32Array(87))).toThrow(/dispose/);
});

test("a person's choice of joints is taken, and refused where there is no such joint", async () => {
  const gltf = await new GLTFLoader().parseAsync(makeRig(MIXAMO).glb.buffer, "");
  const character = await bindCharacter(gltf, { roles: { chest: "mixamorig:Spine1" } });
  expect(character.roles.chest).toBe("mixamorig:Spine1");
  character.dispose();
  await expect(bindCharacter(gltf, { roles: { chest: "Tail" } })).rejects.toThrow("This model has no joint 'Tail'.");
});

test("broken files are refused in words", async () => {
  const lying = changed(MIXAMO, (d) => {
    (d.accessors as unknown) = undefined;
  });
  expect((await refusal(lying)).code).toBe("loaded");
  const { glb } = makeRig(MIXAMO);
  const told = new TextDecoder().decode(glb).match(/"count":(\d+),"type":"VEC3"/)![1]!;
  const lie = String(Number(told) * 9)
    .slice(0, told.length)
    .replace(/./, "9");
  const text = Buffer.from(glb)
    .toString("latin1")
    .replace(`"count":${told},"type":"VEC3"`, `"count":${lie},"type":"VEC3"`);
  expect(await refusal(Uint8Array.from(Buffer.from(text, "latin1")).buffer)).toEqual({
    code: "bad-file",
    message: "An array of this model is longer than its data.",
  });
  expect(await refusal(glb.slice(0, glb.length - 1000).buffer)).toEqual({
    code: "bad-file",
    message: "This file is incomplete.",
  });
  expect((await refusal(new TextEncoder().encode("not a model at all, just text").buffer)).message).toBe(
    "This is not a binary glTF file.",
  );
  expect((await refusal(new ArrayBuffer(0))).code).toBe("bad-file");
});

test("models that are no bodies are refused in words", async () => {
  const noHumanoid = changed(VRM_1, (d) => {
    delete d.extensions!.VRMC_vrm!.humanoid;
  });
  expect((await refusal(noHumanoid)).message).toMatch(/^This VRM has no humanoid/);
  const twoHeads = changed(VRM_0, (d) => {
    const { humanBones } = d.extensions!.VRM!.humanoid as { humanBones: object[] };
    humanBones.push({ bone: "head", node: 3 });
  });
  expect((await refusal(twoHeads)).message).toBe("This VRM names two joints as its head.");
  const noSkin = changed(MIXAMO, (d) => {
    delete (d as Record<string, unknown>).skins;
    for (const node of d.nodes) delete node.skin;
  });
  expect((await refusal(noSkin)).message).toMatch(/^This model has no skin/);
  const uneven = changed(MIXAMO, (d) => {
    d.nodes.find(({ name }) => name === "mixamorig:LeftUpLeg")!.scale = [1, 1.3, 1];
  });
  expect((await refusal(uneven)).message).toMatch(/is scaled differently along its axes/);
  const circle = changed(MIXAMO, (d) => {
    d.nodes[5]!.children = [0];
  });
  expect((await refusal(circle)).message).toBe("The nodes of this model do not form a tree.");
  const oneBone = changed(MIXAMO, (d) => {
    const joints = d.skins[0]!.joints as number[];
    for (const node of d.nodes) if (joints.includes(d.nodes.indexOf(node))) delete node.children;
    (d.scenes as { nodes: number[] }[])[0]!.nodes = [0, d.nodes.length - 1];
    d.nodes.at(-2)!.children = [];
    joints.splice(1);
    d.skins[0] = { joints };
  });
  expect(await refusal(oneBone)).toEqual({
    code: "bad-file",
    message: "No legs and arms were found in this skeleton. Use a file of a humanoid.",
  });
});

test("motions whose values do not fit their keys are refused in words", async () => {
  const character = await loadCharacter(makeRig(MIXAMO).glb.buffer);
  const { times, ...moving } = movingAnimation();
  const { json, binary } = chunksOf(character.toGLB({ ...moving, timeOut: times }));
  character.dispose();
  const { animations, accessors } = json as unknown as {
    animations: { samplers: { input: number; output: number }[] }[];
    accessors: { count: number; type: string }[];
  };
  const { output } = animations[0]!.samplers[1]!;
  for (const lie of [{ count: 1 }, { count: 0 }, { type: "SCALAR" }]) {
    const document = { ...json, accessors: accessors.map((each, i) => (i === output ? { ...each, ...lie } : each)) };
    for (const load of [loadCharacter, loadMotions])
      await expect(load(glbOf(document, binary).buffer)).rejects.toMatchObject({
        code: "bad-file",
        message: "An animation of this model has the wrong number of values for its keyframes.",
      });
  }
});

test("files outside of the limits are refused before they are read", async () => {
  const huge = { size: 129 * 1024 * 1024, arrayBuffer: () => Promise.reject(new Error("was read")) };
  const blob = Object.setPrototypeOf(huge, Blob.prototype) as Blob;
  Object.defineProperty(blob, "size", { value: huge.size });
  expect(await refusal(blob)).toEqual({
    code: "bad-file",
    message: "This file has 129 MB; the limit is 128 MB.",
  });
  const old = new Uint8Array(4000);
  old.set(new TextEncoder().encode("Kaydara FBX Binary  \0\x1a\0"));
  new DataView(old.buffer).setUint32(23, 6100, true);
  expect((await refusal(old.buffer)).message).toBe("This file is FBX 6.1. Expected version 7 or newer.");
  const compressed = changed(MIXAMO, (d) => {
    d.extensionsRequired = ["KHR_texture_basisu"];
  });
  expect((await refusal(compressed)).message).toBe(
    "The textures of this model are KTX2 files (KHR_texture_basisu), which cannot be read here.",
  );
  // The header of a PNG of 9000 × 10 pixels at the start of the buffer.
  const { glb } = makeRig(MIXAMO, {
    document: (d) => {
      d.images = [{ bufferView: 0, mimeType: "image/png" }];
    },
  });
  const start = glb.length - chunksOf(glb).binary.length;
  glb.set([0x89, 0x50, 0x4e, 0x47, 13, 10, 26, 10, 0, 0, 0, 13, 73, 72, 68, 82, 0, 0, 0x23, 0x28, 0, 0, 0, 10], start);
  expect((await refusal(glb.buffer)).message).toMatch(/^A texture of this model has 9000 × 10 pixels/);
  // Indices without data are all zero: two million and one degenerate triangles.
  const whole = chunksOf(makeRig(MIXAMO).glb);
  const { meshes, accessors } = whole.json as {
    meshes: { primitives: { indices: number }[] }[];
    accessors: { bufferView?: number; count: number }[];
  };
  const indices = accessors[meshes[0]!.primitives[0]!.indices]!;
  delete indices.bufferView;
  indices.count = 6_000_003;
  expect((await refusal(glbOf(whole.json, whole.binary).buffer)).message).toBe(
    "This model has more than two million triangles.",
  );
  const outside = changed(MIXAMO, (d) => {
    d.images = [{ uri: "https://example.org/skin.png" }];
  });
  expect((await refusal(outside)).message).toBe("This model keeps its textures in other files.");
});

test("a model that not everybody may perform is asked about, and one that may not be changed is not exported", async () => {
  const only = changed(VRM_0, (d) => {
    Object.assign(d.extensions!.VRM!.meta as object, { allowedUserName: "OnlyAuthor", licenseName: "CC_BY_ND" });
  });
  expect((await refusal(only.slice(0))).code).toBe("licence");
  expect((await refusal(only.slice(0), { accept: () => false })).code).toBe("licence");
  const character = await loadCharacter(only.slice(0), { accept: ({ everybody }) => !everybody });
  expect(character.licence).toMatchObject({ everybody: false, mayExport: false });
  const { times, ...moving } = movingAnimation();
  const motion = { ...moving, timeOut: times };
  expect(() => character.toGLB(motion)).toThrow(/does not allow redistribution/);
  expect(character.toClip(motion).tracks.length).toBeGreaterThan(20);
  character.dispose();
});

test("loading is cancelled by its signal", async () => {
  const signal = AbortSignal.abort("enough");
  expect((await refusal(makeRig(VRM_1).glb.buffer, { signal })).code).toBe("cancelled");
});
