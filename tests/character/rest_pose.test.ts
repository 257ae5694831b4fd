/** Every rig is bound with all roles and the right T-pose. */
import { Quaternion } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { expect, test } from "vitest";
import { bindCharacter } from "../../web/character/character";
import { ROLES, restPose } from "../../web/humanoid";
import { FAMILIES } from "../rigs/families";
import { makeRig } from "../rigs/rig";

const degrees = (radians: number) => (radians * 180) / Math.PI;

test.each(FAMILIES)("the $name has 21 roles and rests in the T-pose", async (family) => {
  const rig = makeRig(family);
  const gltf = await new GLTFLoader().parseAsync(rig.glb.buffer, "");
  const character = await bindCharacter(gltf);
  expect(character.roles).toEqual(Object.fromEntries(ROLES.map((role, j) => [role, family.joints[j]])));
  // On its own body nothing is scaled: what remains is the T-pose that the binding detected.
  character.setBody(character.proportions);
  const pose = restPose();
  pose[1] = character.proportions[1]!;
  character.apply(pose);
  character.object.updateMatrixWorld(true);
  const angles = ROLES.map((role, j) => {
    const node = character.object.getObjectByProperty(
      "name",
      character.roles[role]!.replace(/[\s]/g, "_").replace(/[[\].:/]/g, ""),
    )!;
    return [role, degrees(node.getWorldQuaternion(new Quaternion()).angleTo(rig.rest[j]!))] as const;
  });
  const worst = Math.max(...angles.map(([, angle]) => angle));
  console.info(
    `${family.name}: confidence ${character.confidence.toFixed(2)}, rest ${worst.toFixed(2)}° (${angles.find(([, a]) => a === worst)![0]})`,
  );
  expect(worst).toBeLessThan(family.pose === "T" ? 1 : 8);
  character.dispose();
});
