/** Characters with an exported motion move in Blender as they do here. */
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { type Object3D, Quaternion, Vector3 } from "three";
import { afterAll, expect, test } from "vitest";
import { loadCharacter } from "../../web/character/load";
import { POSE_FLOATS } from "../../web/humanoid";
import { movingAnimation } from "../humanoid_animation";
import { root } from "../recordings";
import { FAMILIES } from "../rigs/families";
import { makeRig } from "../rigs/rig";

const blender = ["/usr/bin/blender", process.env.BLENDER_PATH ?? ""].find(existsSync);
if (!blender) console.warn("skipping: no Blender at /usr/bin/blender or $BLENDER_PATH");
const folder = mkdtempSync(join(tmpdir(), "strut-blender-"));
afterAll(() => rmSync(folder, { recursive: true }));

/** Compared frames; turns are relative to the first one. */
const FRAMES = [0, 7, 30, 59];

/** Position of a joint, metres, and its turn since the first frame, wxyz. */
type Place = [place: [number, number, number], turn: [number, number, number, number]];

test.skipIf(!blender)("exports open in Blender within 0.1 mm and 0.01°", async ({ skip }) => {
  const { times, ...moving } = movingAnimation();
  const motion = { ...moving, timeOut: times };
  const jobs: string[] = [];
  const expected: Map<string, { place: Vector3; turn: Quaternion }>[][] = [];
  for (const [i, family] of FAMILIES.entries()) {
    const character = await loadCharacter(makeRig(family).glb.buffer);
    character.setBody(motion.proportions);
    const file = join(folder, `${i}.glb`);
    writeFileSync(file, character.toGLB(motion));
    jobs.push(join(folder, `${i}.json`));
    writeFileSync(jobs[i]!, JSON.stringify({ file, times: FRAMES.map((frame) => times[frame]!) }));
    const rest = new Map<Object3D, Quaternion>();
    expected.push(
      FRAMES.map((frame) => {
        character.apply(motion.poses.subarray(frame * POSE_FLOATS, (frame + 1) * POSE_FLOATS));
        character.object.updateMatrixWorld(true);
        const places = new Map<string, { place: Vector3; turn: Quaternion }>();
        const named = new Set(Object.values(character.roles));
        character.object.traverse((node) => {
          const name = node.userData.name ?? node.name;
          if (!named.has(name)) return;
          const turn = node.getWorldQuaternion(new Quaternion());
          if (!rest.has(node)) rest.set(node, turn.clone().invert());
          places.set(name, { place: node.getWorldPosition(new Vector3()), turn: turn.multiply(rest.get(node)!) });
        });
        return places;
      }),
    );
    character.dispose();
  }
  const script = join(root, "tests", "interop", "blender_characters.py");
  const flags = ["--background", "--python-exit-code", "1", "--python", script, "--", ...jobs];
  const text = execFileSync(blender!, flags, { encoding: "utf8", maxBuffer: 2 ** 26 });
  skip(text.includes("numpy is missing"), "Blender's Python has no numpy, which its glTF importer needs");
  const reports = text.split("\n").filter((line) => line.startsWith('{"file"'));
  expect(reports).toHaveLength(FAMILIES.length);
  for (const [i, line] of reports.entries()) {
    const { places } = JSON.parse(line) as { places: Record<string, Place>[] };
    let [distance, angle, compared] = [0, 0, 0];
    for (const [f, joints] of places.entries())
      for (const [name, { place, turn }] of expected[i]![f]!) {
        const [at, [w, x, y, z]] = joints[name]!;
        distance = Math.max(distance, place.distanceTo(new Vector3(...at)));
        // A single-precision arc cosine would be off by 0.03°.
        const between = turn
          .clone()
          .invert()
          .multiply(new Quaternion(x, y, z, w).normalize());
        angle = Math.max(angle, 2 * Math.asin(Math.min(1, Math.hypot(between.x, between.y, between.z))));
        compared += 1;
      }
    const degrees = (angle * 180) / Math.PI;
    console.info(`${FAMILIES[i]!.name}: ${(1000 * distance).toFixed(4)} mm, ${degrees.toFixed(4)}°`);
    expect(compared, FAMILIES[i]!.name).toBe(21 * FRAMES.length);
    expect(distance, FAMILIES[i]!.name).toBeLessThan(1e-4);
    expect(degrees, FAMILIES[i]!.name).toBeLessThan(0.01);
  }
});
