/** The output of `strut stylize` opens in other programs: three.js's BVHLoader, Blender's importer. */
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { BVHLoader } from "three/addons/loaders/BVHLoader.js";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { buildPrograms, COMMAND } from "../programs";
import { recordings, root } from "../recordings";

const blender = ["/usr/bin/blender", process.env.BLENDER_PATH ?? ""].find(existsSync);
if (!blender) console.warn("skipping: no Blender at /usr/bin/blender or $BLENDER_PATH");
const data = recordings();
const folder = mkdtempSync(join(tmpdir(), "strut-interop-"));

/** Input and styled output of each clip. */
const pairs: { name: string; input: string; output: string }[] = [];

beforeAll(() => {
  buildPrograms();
  const db = join(folder, "demo.strutdb");
  execFileSync(COMMAND, ["demo-db", "--page", "-o", db, "--bvh", join(folder, "demo")]);
  const demo = readdirSync(join(folder, "demo")).filter((file) => file.includes("neutral"));
  const inputs = [
    join(folder, "demo", demo[0]!),
    ...(data
      ? ["xia/neutral_01_000.bvh", "cmu/walk.bvh", "bandai-namco-2/dataset-2_walk_normal_001.bvh"].map((file) =>
          join(data, file),
        )
      : []),
  ];
  inputs.forEach((input, i) => {
    const output = join(folder, `styled-${i}.bvh`);
    execFileSync(COMMAND, ["stylize", "--db", db, "--input", input, "--style", "old", "-o", output]);
    pairs.push({ name: input, input, output });
  });
}, 900_000);

afterAll(() => rmSync(folder, { recursive: true }));

/** Returns joint names and channels, in file order. */
const hierarchy = (path: string) =>
  readFileSync(path, "utf8")
    .match(/(ROOT|JOINT|CHANNELS).*/g)
    ?.map((line) => line.trim().replace(/\s+/g, " "));

describe("styled BVH", () => {
  it("keeps the input's names, order and channels", () => {
    for (const { input, output } of pairs) expect(hierarchy(output)).toEqual(hierarchy(input));
  });

  it("opens in three.js's BVHLoader and moves", () => {
    for (const { name, output } of pairs) {
      const { skeleton, clip } = new BVHLoader().parse(readFileSync(output, "utf8"));
      const joints = hierarchy(output)!.filter((line) => !line.startsWith("CHANNELS"));
      expect(skeleton.bones.filter((bone) => bone.name !== "ENDSITE").length, name).toBe(joints.length);
      expect(clip.duration, name).toBeGreaterThan(1);
      let greatestChange = 0;
      for (const track of clip.tracks) {
        expect(track.values.every(Number.isFinite), `${name} ${track.name}`).toBe(true);
        const size = track.getValueSize();
        for (let i = size; i < track.values.length; i++)
          greatestChange = Math.max(greatestChange, Math.abs(track.values[i]! - track.values[i % size]!));
      }
      expect(greatestChange, name).toBeGreaterThan(0.2);
    }
  });

  it.skipIf(!blender)("opens in Blender's importer", () => {
    const script = join(root, "tests", "interop", "blender_import.py");
    const files = pairs.map(({ output }) => output);
    const text = execFileSync(
      blender!,
      ["--background", "--python-exit-code", "1", "--python", script, "--", ...files],
      {
        encoding: "utf8",
      },
    );
    const reports = text
      .split("\n")
      .filter((line) => line.startsWith("{"))
      .map((line) => JSON.parse(line));
    expect(reports.length).toBe(pairs.length);
    for (const [i, report] of reports.entries()) {
      const declared = Number(/Frames:\s*(\d+)/.exec(readFileSync(files[i]!, "utf8"))![1]);
      expect(report.frames, report.file).toBe(declared);
      expect(report.travel, report.file).toBeGreaterThan(0.01);
    }
  });
});
