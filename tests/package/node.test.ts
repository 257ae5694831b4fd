/** The package in Node, installed from its tarball: the contract of DESIGN.md section 6, bit-equal to the command. */
import { execFileSync } from "node:child_process";
import { copyFileSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { POSE_FLOATS } from "../../web/humanoid";
import { root } from "../recordings";
import { type Consumer, FRAMES, installPackage } from "./consumer";

let consumer: Consumer;
beforeAll(() => {
  consumer = installPackage();
}, 900_000);
afterAll(() => consumer.remove());

describe("the contract", () => {
  let report: Record<string, unknown> & { refusals: string[]; clip: { duration: number }; durationOutSecs: number };
  beforeAll(() => {
    copyFileSync(new URL("./contract.mjs", import.meta.url), join(consumer.folder, "contract.mjs"));
    report = JSON.parse(execFileSync(process.execPath, ["contract.mjs"], { cwd: consumer.folder }).toString());
  });

  test("styles a file to the bytes that the command writes", () => {
    expect(readFileSync(join(consumer.folder, "package.bvh"), "utf8")).toBe(consumer.byCommand);
    expect(report).toMatchObject({ thread: "node", version: "0.1.0", rising: true });
    expect(report.motion).toMatchObject({ name: "motion", frames: FRAMES, rateHz: 120 });
  });

  test("gives a trace, a GLB, a VRMA and an AnimationClip", () => {
    const fields = ["frame", "time_in", "time_out", "dt", "class_weights", "planted"];
    expect(report.trace).toEqual([FRAMES, fields]);
    expect(report.glb).toBeGreaterThan(100_000);
    expect(report.vrma).toBeGreaterThan(FRAMES * POSE_FLOATS);
    expect(report.clip).toMatchObject({ tracks: 22, valid: true });
    expect(report.clip.duration).toBeCloseTo(report.durationOutSecs, 1);
  });

  test("styles poses as they arrive, in other styles after a change, and plays", () => {
    expect(report.live).toEqual([20 * POSE_FLOATS, 20 * POSE_FLOATS, true]);
    expect(report.played).toBeGreaterThan(10);
  });

  test("refuses what it cannot do with a code and a sentence", () => {
    expect(report.refusals.map((refusal) => refusal.split(":")[0])).toEqual([
      "bad-input",
      "bad-input",
      "load",
      "bad-file",
      "bad-input",
      "bad-input",
      "bad-input",
      "cancelled",
    ]);
    for (const refusal of report.refusals) expect(refusal).toMatch(/^[\w-]+: [A-Z].*\.$/);
  });

  test("has walks in eight styles built in", () => {
    expect(report.walk).toMatchObject({ actions: ["walk"], styles: expect.arrayContaining(["neutral", "proud"]) });
    const { styles, frames, out } = report.walk as { styles: string[]; frames: number; out: number };
    expect([styles.length, out]).toEqual([8, frames]);
  });
});

describe("the types", () => {
  const text = `import { loadStrut, StrutError, type Motion, type StyledMotion } from "strut-motion";
export async function proud(text: string): Promise<StyledMotion> {
  const strut = await loadStrut({ assets: "/assets" });
  const db = await strut.openDatabase("strut:walk", { onProgress: ({ fraction }) => fraction.toFixed() });
  const motion: Motion = await strut.openMotion(text);
  return strut.stylize(motion, db, { styles: { proud: 1 } });
}
export const refused = new StrutError({ code: "load", message: "", hint: "" }).code === "load";
// @ts-expect-error: there is no such option
export const wrong = loadStrut({ asset: "/assets" });
`;

  test.each([
    ["node16", "node16"],
    ["esnext", "bundler"],
  ])("serve users whose modules are %s and whose resolution is %s, without three.js", (module, resolution) => {
    writeFileSync(join(consumer.folder, "consumer.ts"), text);
    const compilerOptions = {
      strict: true,
      noEmit: true,
      skipLibCheck: false,
      target: "es2022",
      lib: ["es2023", "dom"],
      types: [],
      module,
      moduleResolution: resolution,
    };
    writeFileSync(join(consumer.folder, "tsconfig.json"), JSON.stringify({ compilerOptions, files: ["consumer.ts"] }));
    const tsc = join(root, "node_modules", "typescript", "bin", "tsc");
    const check = () => execFileSync(process.execPath, [tsc, "-p", "."], { cwd: consumer.folder, encoding: "utf8" });
    expect(check).not.toThrow();
  });
});
