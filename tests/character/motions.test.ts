/** A motion goes out into a character's file and comes back as the poses that it was made of. */
import { Quaternion } from "three";
import { expect, test } from "vitest";
import { loadCharacter } from "../../web/character/load";
import { JOINTS, POSE_FLOATS, ROLES } from "../../web/humanoid";
import { FAMILIES } from "../rigs/families";
import { makeRig } from "../rigs/rig";
import { angleBetween } from "./compare";
import { performances } from "./performance";

test.each(FAMILIES)("a motion in a file of the $name is read as it was written", async (family) => {
  const walk = (await performances()).find(({ name }) => name.endsWith("proud"))!;
  const character = await loadCharacter(makeRig(family).glb.buffer);
  const times = Float32Array.from({ length: 120 }, (_, f) => f / 60);
  // On the character's own body nothing is scaled, so that the same poses are expected.
  const { proportions } = character;
  const scale = proportions[1]! / walk.proportions[1]!;
  const poses = walk.poses.slice(0, times.length * POSE_FLOATS);
  for (let i = 0; i < poses.length; i += POSE_FLOATS) for (let axis = 0; axis < 3; axis++) poses[i + axis]! *= scale;
  const motion = { name: "walk", proportions, poses, timeOut: times };
  const read = await loadCharacter(character.toGLB(motion).buffer);
  read.setBody(proportions);
  const found = read.motions.at(-1)!;
  expect(found).toMatchObject({ name: "walk", rateHz: 60, frames: 120 });
  const again = found.poses();
  let [worst, of] = [0, ""];
  for (let f = 0; f < 119; f++)
    for (let j = 0; j < JOINTS; j++) {
      // Feet that would sink are lifted, which bends the legs; everything else is as it was.
      if (/leg/.test(ROLES[j]!)) continue;
      const at = f * POSE_FLOATS + 3 + 4 * j;
      const angle = angleBetween(new Quaternion().fromArray(poses, at), new Quaternion().fromArray(again, at));
      if (/foot/.test(ROLES[j]!)) continue;
      if (angle > worst) [worst, of] = [angle, ROLES[j]!];
    }
  console.info(`${family.name}: ${worst.toFixed(4)}° (${of})`);
  expect(worst).toBeLessThan(0.1);
  character.dispose();
  read.dispose();
});
