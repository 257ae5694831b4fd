/** Data of a character on the stage: positions of its joints, its size, and its direction. */
import { Vector3 } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { beforeAll, expect, test } from "vitest";
import { bindCharacter } from "../../web/character/character";
import { JOINT, POSE_FLOATS, ROLES } from "../../web/humanoid";
import { Actor } from "../../web/viewer/performer";
import { FAMILIES } from "../rigs/families";
import { makeRig } from "../rigs/rig";
import { type Performance, performances } from "./performance";

let walk: Performance;
beforeAll(async () => {
  walk = (await performances()).find(({ name }) => /^neutral walk, proud/.test(name))!;
});

test.each(FAMILIES)("the $name is where the stage says", async (family) => {
  const { poses, proportions } = walk;
  const character = await bindCharacter(await new GLTFLoader().parseAsync(makeRig(family).glb.buffer, ""));
  const actor = new Actor(character);
  actor.setBody(proportions);
  let [farthest, astray] = [0, 0];
  const [travelled, performed] = [actor.travelling(poses), actor.performed(poses)];
  for (let frame = 0; frame < poses.length / POSE_FLOATS; frame += 16) {
    const first = frame * POSE_FLOATS;
    actor.perform(poses.subarray(first, first + POSE_FLOATS));
    character.object.updateMatrixWorld(true);
    for (const role of ROLES) {
      const said = new Vector3().fromArray(actor.world.positions, 3 * JOINT[role]);
      farthest = Math.max(farthest, said.distanceTo(placeOf(character, role)));
    }
    const [dx, dz] = [travelled[first]! - performed[first]!, travelled[first + 2]! - performed[first + 2]!];
    astray = Math.max(astray, Math.hypot(dx, dz));
  }
  console.log(`${family.name}: joints ${(1000 * farthest).toFixed(2)} mm, way ${(1000 * astray).toFixed(2)} mm`);
  // Thighs whose parent is the spine are not exactly at a humanoid's positions.
  expect(farthest).toBeLessThan(family.isBiped ? 0.05 : 0.01);
  expect(astray).toBeLessThan(0.01);
});

/** Returns the true position of a role's joint. */
function placeOf({ object, roles }: Awaited<ReturnType<typeof bindCharacter>>, role: (typeof ROLES)[number]): Vector3 {
  const place = new Vector3();
  object.traverse((node) => {
    if ((node.userData.name ?? node.name) === roles[role]) node.getWorldPosition(place);
  });
  return place;
}
