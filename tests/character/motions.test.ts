/** Motions are written to files, and read again as the same poses. */
import "../../web/engine/whole";
import type { AnimationClip } from "three";
import { beforeAll, describe, expect, test } from "vitest";
import { chunksOf } from "../../web/character/glb_patch";
import { loadCharacter, loadMotions } from "../../web/character/load";
import type { Character, CharacterMotion, StyledPoses } from "../../web/character/types";
import { loadBuiltIn } from "../../web/engine/built_in";
import { Engine } from "../../web/engine/engine";
import { bvhText } from "../../web/formats/bvh";
import { mannequinGlb } from "../../web/formats/mannequin_glb";
import { vrmAnimation } from "../../web/formats/vrma";
import { POSE_FLOATS } from "../../web/humanoid";
import { FAMILIES, type Family } from "../rigs/families";
import { fbxFile } from "../rigs/fbx";
import { glbOf } from "../rigs/glb";
import { makeRig } from "../rigs/rig";
import { turnsApart } from "./compare";
import { type Performance, performances } from "./performance";

/** Number of frames of the motion. The last one is compared slightly before its time, because clips loop. */
const FRAMES = 120;

/**
 * Feet that would sink into the ground are lifted, which bends the legs of characters. Everything else is unchanged.
 */
const LEGS = /leg|foot/;

/** Greatest error of every file, degrees. */
const WANTED = 0.1;

const MIXAMO = FAMILIES.find(({ name }) => name === "Mixamo in cm")!;

let walk: Performance;

beforeAll(async () => {
  walk = (await performances()).find(({ name }) => name.endsWith("proud"))!;
});

/** Returns the walk on a body, scaled by its hips. */
function walkOn(proportions: Float32Array): StyledPoses {
  const scale = proportions[1]! / walk.proportions[1]!;
  const poses = walk.poses.slice(0, FRAMES * POSE_FLOATS);
  for (let i = 0; i < poses.length; i += POSE_FLOATS) for (let axis = 0; axis < 3; axis++) poses[i + axis]! *= scale;
  return { name: "walk", proportions, poses, timeOut: Float32Array.from({ length: FRAMES }, (_, f) => f / 60) };
}

/** Compares the poses of a motion that was read with those that were written. */
function compare(what: string, found: CharacterMotion, { poses }: StyledPoses, again: Float32Array, but?: RegExp) {
  expect(found).toMatchObject({ name: "walk", rateHz: 60, frames: FRAMES });
  const { degrees, role } = turnsApart(poses, again, FRAMES - 1, but);
  console.info(`${what}: ${degrees.toFixed(4)}° (${role})`);
  expect(degrees).toBeLessThan(WANTED);
}

/** Returns the largest distance between the hips read and written, metres. */
function hipsApart(a: Float32Array, b: Float32Array): number {
  let worst = 0;
  for (let i = 0; i < (FRAMES - 1) * POSE_FLOATS; i += POSE_FLOATS)
    worst = Math.max(worst, Math.hypot(a[i]! - b[i]!, a[i + 1]! - b[i + 1]!, a[i + 2]! - b[i + 2]!));
  return worst;
}

describe("of a character's file", () => {
  test.each(FAMILIES)("GLB of the $name", async (family) => {
    const character = await loadCharacter(makeRig(family).glb.buffer);
    const motion = walkOn(character.proportions);
    const read = await loadCharacter(character.toGLB(motion).buffer);
    read.setBody(motion.proportions);
    const found = read.motions.at(-1)!;
    compare(family.name, found, motion, found.poses(), LEGS);
    character.dispose();
    read.dispose();
  });

  test.each([
    ["+Y", { ...MIXAMO, armature: FAMILIES[0]!.armature }],
    ["+Z", MIXAMO],
  ])("FBX with %s up", async (up, family) => {
    const { clip, motion } = await clipOf(family);
    const character = await loadCharacter(fbxFile(family, { clip }).buffer, { glb: false });
    const [found] = character.motions;
    compare(`FBX with ${up} up`, found!, motion, found!.poses(character.proportions), LEGS);
    character.dispose();
  });
});

/** Returns the walk as a clip of a family's rig. */
async function clipOf(family: Family): Promise<{ clip: AnimationClip; motion: StyledPoses }> {
  const character = await loadCharacter(makeRig(family).glb.buffer);
  const motion = walkOn(character.proportions);
  const clip = character.toClip(motion);
  character.dispose();
  return { clip, motion };
}

describe("of a file alone", () => {
  test("VRM Animation, of all joints", async () => {
    const motion = walkOn(walk.proportions);
    const file = vrmAnimation({ ...motion, times: motion.timeOut });
    const [found] = await loadMotions(file.buffer);
    const poses = found!.poses();
    compare("VRMA", found!, motion, poses);
    for (const [i, offset] of found!.proportions.entries()) expect(offset).toBeCloseTo(walk.proportions[i]!, 5);
    const metres = hipsApart(motion.poses, poses);
    console.info(`VRMA: hips ${(1000 * metres).toFixed(3)} mm`);
    expect(metres).toBeLessThan(1e-4);
    // A VRM Animation contains no figure.
    await expect(loadCharacter(file.buffer)).rejects.toMatchObject({ code: "bad-file" });
  });

  test("the mannequin as GLB, of all joints", async () => {
    const motion = walkOn(walk.proportions);
    const [found] = await loadMotions(mannequinGlb({ ...motion, times: motion.timeOut }).buffer);
    compare("mannequin", found!, motion, found!.poses(walk.proportions));
  });

  test.each(FAMILIES)("GLB of the $name without its mesh", async (family) => {
    const character = await loadCharacter(makeRig(family).glb.buffer);
    const motion = walkOn(character.proportions);
    const found = (await loadMotions(withoutMesh(character.toGLB(motion)))).at(-1)!;
    // Its rest pose is the bind pose, as in exports for animation.
    compare(`${family.name}, no mesh`, found, motion, found.poses(), LEGS);
    character.dispose();
  });

  test("FBX without skin", async () => {
    const { clip, motion } = await clipOf(MIXAMO);
    const [found] = await loadMotions(fbxFile(MIXAMO, { clip, skin: false }).buffer);
    compare("FBX without skin", found!, motion, found!.poses(), LEGS);
  });

  test("VRM with a motion in it, whatever its author allows a performer", async () => {
    const only = makeRig(FAMILIES[0]!, {
      document: (d) => {
        Object.assign(d.extensions!.VRMC_vrm!.meta as object, { avatarPermission: "onlyAuthor" });
      },
    });
    const character = await loadCharacter(only.glb.slice().buffer, { accept: () => true });
    const motion = walkOn(character.proportions);
    const [found] = await loadMotions(character.toGLB(motion).buffer);
    compare("VRM", found!, motion, found!.poses(), LEGS);
    character.dispose();
  });

  test("a file without motions has none, and one that is no body is refused when it has", async () => {
    expect(await loadMotions(makeRig(MIXAMO).glb.buffer)).toEqual([]);
    await expect(loadMotions(new ArrayBuffer(3))).rejects.toMatchObject({ code: "bad-file" });
  });
});

/** Returns a GLB without its meshes and skins; their data stay in its buffer. */
function withoutMesh(glb: Uint8Array): ArrayBuffer {
  const { json, binary } = chunksOf(glb);
  const { nodes } = json as { nodes: { mesh?: number; skin?: number }[] };
  for (const each of nodes) {
    delete each.mesh;
    delete each.skin;
  }
  delete json.meshes;
  delete json.skins;
  return glbOf(json, binary).buffer;
}

test("a motion of a file is opened through BVH as the motion itself is", async () => {
  const [engine, motions] = await Promise.all([Engine.load(), loadBuiltIn()]);
  const database = engine.openDatabase({ kind: "demo", motions });
  const opened = (text: string) => {
    const bytes = new TextEncoder().encode(text).buffer as ArrayBuffer;
    return engine.openInput(database, { kind: "bvh", name: "walk", bytes });
  };
  const motion = walkOn(database.info.proportions);
  const direct = opened(bvhText({ ...motion, rateHz: 60 }));
  const character: Character = await loadCharacter(makeRig(MIXAMO).glb.buffer);
  for (const [what, file, but] of [
    ["VRMA", vrmAnimation({ ...motion, times: motion.timeOut }), undefined],
    ["mannequin", mannequinGlb({ ...motion, times: motion.timeOut }), undefined],
    ["GLB of another body", character.toGLB(motion), LEGS],
  ] as const) {
    const [found] = await loadMotions(file.slice().buffer);
    const input = opened(found!.toBVH());
    expect(input.info.frames).toBe(FRAMES);
    const { degrees, role } = turnsApart(direct.info.poses, input.info.poses, FRAMES - 1, but);
    console.info(`${what} through BVH: ${degrees.toFixed(4)}° (${role})`);
    expect(degrees).toBeLessThan(WANTED);
    input.dispose();
  }
  direct.dispose();
  database.dispose();
  character.dispose();
});
