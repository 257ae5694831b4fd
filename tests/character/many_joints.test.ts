/** Skeletons with more joints than the engine binds: hair, skirts and faces are omitted, limbs are kept. */
import { Quaternion, Vector3 } from "three";
import { expect, test } from "vitest";
import { chunksOf } from "../../web/character/glb_patch";
import { loadCharacter } from "../../web/character/load";
import { ROLES } from "../../web/humanoid";
import { movingAnimation, poseOf } from "../humanoid_animation";
import { FAMILIES } from "../rigs/families";
import { glbOf } from "../rigs/glb";
import { makeRig } from "../rigs/rig";
import { angleBetween } from "./compare";

const MIXAMO = FAMILIES.find(({ name }) => name === "Mixamo in cm")!;

interface Document {
  nodes: { name?: string; translation?: number[]; rotation?: number[]; children?: number[] }[];
  skins: { joints: number[]; inverseBindMatrices?: number }[];
}

/** Makes a rig with chains of hair on its head, each of some joints of 2 cm. */
function hairy(chains: number, joints: number): ArrayBuffer {
  const { json, binary } = chunksOf(makeRig(MIXAMO).glb);
  const document = structuredClone(json) as unknown as Document;
  const head = document.nodes.find(({ name }) => name === "mixamorig:Head")!;
  const skin = document.skins[0]!;
  const added: number[] = [];
  for (let chain = 0; chain < chains; chain++) {
    let above = head;
    for (let j = 0; j < joints; j++) {
      const node = { name: `hair ${chain} ${j}`, translation: [2 * Math.cos(chain), 2, 2 * Math.sin(chain)] };
      const index = document.nodes.push(node) - 1;
      above.children ??= [];
      above.children.push(index);
      above = document.nodes[index]!;
      added.push(index);
    }
  }
  // A second skin with only the hair: without matrices its joints are as modelled.
  document.skins.push({ joints: added });
  document.nodes.push({ name: "Hair", mesh: 0, skin: document.skins.indexOf(skin) + 1 } as Document["nodes"][number]);
  const scene = (document as unknown as { scenes: { nodes: number[] }[] }).scenes[0]!;
  scene.nodes.push(document.nodes.length - 1);
  return glbOf(document, binary).buffer;
}

const { times, ...moving } = movingAnimation();
const motion = { ...moving, timeOut: times };

test.each([
  [120, 5],
  [700, 1],
  [16_000, 1],
])("%d chains of %d joints of hair do not keep a character from performing", async (chains, joints) => {
  const plain = await loadCharacter(makeRig(MIXAMO).glb.buffer);
  const file = hairy(chains, joints);
  // CPU time, since other tests run at the same time.
  const start = process.cpuUsage();
  const large = await loadCharacter(file);
  const took = process.cpuUsage(start).user / 1000;
  expect(large.roles).toEqual(Object.fromEntries(ROLES.map((role, j) => [role, MIXAMO.joints[j]])));
  const left = large.notes.find((note) => note.endsWith("joints of hair, face or clothes were left out."));
  console.info(`${chains} × ${joints}: ${took.toFixed(0)} ms; ${left}`);
  const dropped = Number(left!.split(" ")[0]);
  const all = chains * joints;
  expect(dropped).toBeGreaterThan(all - 512);
  expect(dropped).toBeLessThanOrEqual(all);
  for (const character of [large, plain]) {
    character.setBody(motion.proportions);
    character.apply(poseOf(motion, 20));
    character.object.updateMatrixWorld(true);
  }
  for (const name of MIXAMO.joints) {
    const [a, b] = [large, plain].map(({ object }) => object.getObjectByName(name.replace(":", ""))!);
    expect(1000 * a!.getWorldPosition(new Vector3()).distanceTo(b!.getWorldPosition(new Vector3()))).toBeLessThan(0.1);
    expect(angleBetween(a!.getWorldQuaternion(new Quaternion()), b!.getWorldQuaternion(new Quaternion()))).toBeLessThan(
      0.01,
    );
  }
  const read = await loadCharacter(large.toGLB(motion).buffer);
  expect(read.motions.at(-1)!.poses().every(Number.isFinite)).toBe(true);
  for (const character of [large, plain, read]) character.dispose();
});

test("a model whose nodes lie in one another without end is refused in words", async () => {
  const { json, binary } = chunksOf(makeRig(MIXAMO).glb);
  const document = structuredClone(json) as unknown as Document;
  for (let depth = 0; depth < 2000; depth++) document.nodes.push({ children: [document.nodes.length + 1] });
  document.nodes.push({});
  await expect(loadCharacter(glbOf(document, binary).buffer)).rejects.toMatchObject({
    code: "bad-file",
    message: "The nodes of this model do not form a tree, or it is too deep.",
  });
});
