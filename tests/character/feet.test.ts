/** Eight rigs, every built-in input, three styles: the feet must stand on the ground as the input's do. */
import type { Object3D } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { beforeAll, expect, test } from "vitest";
import { bindCharacter } from "../../web/character/character";
import type { Role } from "../../web/humanoid";
import { FAMILIES } from "../rigs/families";
import { makeRig } from "../rigs/rig";
import {
  characterSoles,
  feetOf,
  inputSoles,
  type Performance,
  performances,
  readMannequinFeet,
  type Soles,
} from "./performance";

let motions: Performance[];
let inputs: Soles[];

beforeAll(async () => {
  await readMannequinFeet();
  motions = await performances();
  inputs = motions.map(inputSoles);
});

/** Greatest depth of a sole below the ground, metres. */
const DEEPEST = 0.005;

const worst = (a: number, b: number) => (Math.abs(b) > Math.abs(a) ? b : a);

test.each(FAMILIES)("the feet of the $name meet the ground", async (family) => {
  const rig = makeRig(family);
  const gltf = await new GLTFLoader().parseAsync(rig.glb.buffer, "");
  const character = await bindCharacter(gltf);
  const nodes = new Map<Role, Object3D>();
  for (const [role, name] of Object.entries(character.roles) as [Role, string][])
    gltf.scene.traverse((node) =>
      node.userData.name === name || node.name === name ? nodes.set(role, node) : undefined,
    );
  const nodeOf = (role: Role) => nodes.get(role)!;
  const feet = feetOf(gltf.scene, nodeOf);
  character.setBody(motions[0]!.proportions);
  let [height, literal, deepest, skate, deepestOf] = [0, 0, 0, 0, ""];
  for (const [i, motion] of motions.entries()) {
    const input = inputs[i]!;
    const soles = characterSoles(motion, feet, nodeOf, (pose) => {
      character.apply(pose);
      gltf.scene.updateMatrixWorld(true);
    });
    let [own, theirs] = [0, 0];
    for (const [k, planted] of motion.planted.entries()) {
      if (soles.heights[k]! < deepest) [deepest, deepestOf] = [soles.heights[k]!, motion.name];
      if (!planted) continue;
      // Where the input is deeper than characters may be, they stand at the limit.
      height = worst(height, soles.heights[k]! - Math.max(input.heights[k]! * rig.legRatio, -DEEPEST));
      literal = worst(literal, soles.heights[k]! - input.heights[k]!);
      if (k < 2 || !motion.planted[k - 2]) continue;
      own += soles.travels[k]!;
      theirs += input.travels[k]!;
    }
    skate = Math.max(skate, own / (theirs * Math.max(0.75, rig.legRatio)));
  }
  const cm = (metres: number) => `${(100 * metres).toFixed(2)} cm`;
  console.info(
    `${family.name} (legs ${rig.legRatio.toFixed(2)}): planted sole ${cm(height)} (unscaled ${cm(literal)}), deepest ${cm(deepest)} in ${deepestOf}, skate ${skate.toFixed(2)}`,
  );
  character.dispose();
  expect.soft(Math.abs(height), "planted sole").toBeLessThan(0.005);
  expect.soft(deepest, "deepest").toBeGreaterThan(-DEEPEST);
  expect.soft(skate, "skate").toBeLessThan(1.25);
});

test("the input's own", () => {
  let deepest = 0;
  let planted = 0;
  for (const [i, motion] of motions.entries())
    for (const [k, height] of inputs[i]!.heights.entries()) {
      deepest = Math.min(deepest, height);
      if (motion.planted[k]) planted = worst(planted, height);
    }
  console.info(`${motions.length} motions; input deepest ${deepest}, planted ${planted}`);
});
