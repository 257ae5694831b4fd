// Writes the rigs of tests/rigs as files for Blender: node scripts/blender/rigs.mjs FOLDER.
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { runnerImport } from "vite";
import { main, root } from "../steps.mjs";

/**
 * Writes one GLB per rig, and `rigs.json`: for each its name, its file, the names of the joints of the 21 roles, the
 * world rotation of each in the T-pose facing +Z (x y z w, +Y up), and the length of its legs relative to the
 * mannequin's.
 */
export async function writeRigs(folder) {
  mkdirSync(folder, { recursive: true });
  const { rigs } = (await runnerImport(join(root, "tests", "rigs", "rig.ts"))).module;
  const { ROLES } = (await runnerImport(join(root, "web", "humanoid", "index.ts"))).module;
  const list = rigs().map(({ family, glb, rest, legRatio }, i) => {
    const file = `${i}.glb`;
    writeFileSync(join(folder, file), glb);
    const joints = Object.fromEntries(ROLES.map((role, j) => [role, family.joints[j]]));
    const turns = Object.fromEntries(ROLES.map((role, j) => [role, rest[j].toArray()]));
    return { name: family.name, file, joints, rest: turns, legRatio };
  });
  writeFileSync(join(folder, "rigs.json"), JSON.stringify(list));
}

if (process.argv[1] === fileURLToPath(import.meta.url)) await main(() => writeRigs(process.argv[2]));
