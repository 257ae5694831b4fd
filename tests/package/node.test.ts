/** The package in Node, installed from its tarball: its contract, bit-identical to the command. */
import { execFileSync, spawnSync } from "node:child_process";
import { copyFileSync, existsSync, mkdirSync, readFileSync, symlinkSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { POSE_FLOATS } from "../../web/humanoid";
import { COMMAND } from "../programs";
import { root } from "../recordings";
import { FAMILIES } from "../rigs/families";
import { makeRig } from "../rigs/rig";
import { type Consumer, FRAMES, installPackage } from "./consumer";

const { version: VERSION } = JSON.parse(readFileSync(join(root, "package.json"), "utf8")) as { version: string };

let consumer: Consumer;
beforeAll(() => {
  consumer = installPackage();
}, 900_000);
afterAll(() => consumer.remove());

/** Runs a script of this folder in the consumer's folder and returns its output. */
function run(script: string, ...args: string[]): string {
  copyFileSync(new URL(`./${script}`, import.meta.url), join(consumer.folder, script));
  return execFileSync(process.execPath, ["--expose-gc", script, ...args], { cwd: consumer.folder, encoding: "utf8" });
}

describe("the contract", () => {
  let report: Record<string, unknown> & { refusals: string[]; clip: { duration: number }; durationOutSecs: number };
  beforeAll(() => {
    report = JSON.parse(run("contract.mjs"));
  });

  test("styles a file to the bytes that the command writes", () => {
    expect(readFileSync(join(consumer.folder, "package.bvh"), "utf8")).toBe(consumer.byCommand);
    expect(report).toMatchObject({ thread: "node", version: VERSION, rising: true });
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

describe("characters", () => {
  const MODULE = "assets/strut_wasm_character_bg.wasm";
  beforeAll(() => writeFileSync(join(consumer.folder, "character.glb"), makeRig(FAMILIES[0]!).glb));

  test("are bound in Node by the package's own module", () => {
    expect(JSON.parse(run("characters.mjs", "character.glb"))).toEqual({ roles: 21, motions: 0 });
  });

  test("that are compressed with Draco are bound, by the decoder where loadStrut says that it lies", () => {
    copyFileSync(join(root, "tests/rigs/mixamo_draco.glb"), join(consumer.folder, "draco.glb"));
    expect(JSON.parse(run("characters.mjs", "draco.glb"))).toEqual({ roles: 21, motions: 0 });
    const nowhere = join(consumer.folder, "nowhere");
    expect(JSON.parse(run("characters.mjs", "draco.glb", `${pathToFileURL(nowhere).href}/`))).toMatchObject({
      code: "load",
      message: expect.stringContaining("nowhere/draco_decoder.wasm"),
    });
  });

  test("are bound by the module where loadStrut says that it lies, and only there", () => {
    const [inside, elsewhere] = [join(consumer.installed, MODULE), join(consumer.folder, "elsewhere")];
    mkdirSync(elsewhere, { recursive: true });
    const assets = `${pathToFileURL(elsewhere).href}/`;
    expect(JSON.parse(run("characters.mjs", "character.glb", assets))).toMatchObject({
      code: "load",
      message: expect.stringContaining("elsewhere/strut_wasm_character_bg.wasm"),
    });
    copyFileSync(inside, join(elsewhere, "strut_wasm_character_bg.wasm"));
    expect(JSON.parse(run("characters.mjs", "character.glb", assets))).toMatchObject({ roles: 21 });
  });
});

describe("what is built and trained", () => {
  let report: { refusals: string[] } & Record<string, unknown>;
  const command = (...args: string[]) => execFileSync(COMMAND, args, { cwd: consumer.folder, stdio: "pipe" });
  const file = (name: string) => readFileSync(join(consumer.folder, name));
  beforeAll(() => {
    report = JSON.parse(run("models.mjs"));
  });

  test("are databases, byte for byte those of the command", () => {
    mkdirSync(join(consumer.folder, "two"));
    for (const style of ["neutral", "old"]) {
      const clip = `walk_${style}_001.bvh`;
      copyFileSync(join(consumer.folder, "clips", clip), join(consumer.folder, "two", clip));
    }
    command("build-db", "two", "-o", "built_by_command.strutdb");
    expect(file("built.strutdb").equals(file("built_by_command.strutdb"))).toBe(true);
    // A database stores the path of every clip; a single file has none.
    copyFileSync(join(consumer.folder, "clips/walk_proud_001.bvh"), join(consumer.folder, "walk_proud_001.bvh"));
    const clip = ["--input", "walk_proud_001.bvh", "--style", "cross"];
    command("add-style", "--db", "built_by_command.strutdb", ...clip, "-o", "more_by_command.strutdb");
    expect(file("more.strutdb").equals(file("more_by_command.strutdb"))).toBe(true);
    expect(report).toMatchObject({ built: ["neutral", "old"], more: ["neutral", "old", "cross"], styled: true });
  });

  test("are models of walks and of key styles", () => {
    expect(report).toMatchObject({ walk: { styles: 8, pose: POSE_FLOATS }, keys: ["foot_separation"], last: 1 });
  });

  test("or are refused with a code and a sentence", () => {
    expect(report.refusals.map((refusal) => refusal.split(":")[0])).toEqual([
      "bad-file",
      "bad-file",
      "bad-file",
      "bad-file",
      "bad-input",
      "bad-input",
      "bad-input",
      "cancelled",
    ]);
    for (const refusal of report.refusals) expect(refusal).toMatch(/^[\w-]+: .*\.$/);
  });
});

describe("a file that is missing", () => {
  test("is named by an error of code load, and is had once it is there", () => {
    const report = JSON.parse(run("missing.mjs")) as Record<string, [missing: string, there: string]>;
    expect(Object.keys(report)).toHaveLength(6);
    for (const [file, [missing, there]] of Object.entries(report)) {
      expect(missing).toMatch(/^load: The (engine|built-in motions) could not be loaded: there is no file .*\.$/);
      expect(missing).toContain(`/strut-motion/assets/${file}.`);
      expect(there).toBe("done");
    }
  });
});

test("a performer is styled as poses arrive, and recorded; what does not work is said", () => {
  const report = JSON.parse(run("live.mjs"));
  const { frames, floats, stats } = report;
  expect(frames).toBeGreaterThan(50);
  expect(floats).toEqual([frames * POSE_FLOATS, frames * POSE_FLOATS]);
  expect(report).toMatchObject({ finite: true, styled: true, bvh: [String(frames), String(frames)], afterwards: 0 });
  expect(stats).toMatchObject({ delaySecs: 0.05, refused: 0 });
  expect(report.noBody).toMatch(/^No .* in this skeleton\. .*\.$/);
  // Node has WebSockets from version 22 on.
  expect(report.nobody).toMatch(
    /^(WebSocket is not available here|No sender answers at 127\.0\.0\.1:1; trying again in 1 s)\.$/,
  );
  expect(report.refusals).toEqual(["bad-input", "bad-input", "bad-input"]);
  expect(report.cancelled).toEqual({ codes: ["cancelled", "cancelled", "cancelled"], open: ["database", "motion"] });
});

/** Number of poses of the stream: 100,000 take minutes. */
const PUSHES = Number(process.env.STRUT_PUSHES ?? 20_000);

describe(`a stream of ${PUSHES} poses`, () => {
  test("leaves the memory as it was, and ends at once when it is asked to", { timeout: 600_000 }, () => {
    const { before, after, abort } = JSON.parse(run("stream.mjs", String(PUSHES)));
    console.log(JSON.stringify({ before, after }));
    expect(after.wasm).toBe(before.wasm);
    expect(after.arrayBuffers).toBeLessThanOrEqual(before.arrayBuffers * 1.05);
    expect(after.heap).toBeLessThanOrEqual(before.heap * 1.05);
    expect(abort.code).toBe("cancelled");
  });
});

describe("the types", () => {
  const text = `import { loadStrut, StrutError, type Motion, type StyledMotion } from "strut-motion";
import { loadStrut as loadInline } from "strut-motion/inline";
import { loadStrut as loadInNode } from "strut-motion/node";
export const same: (typeof loadStrut)[] = [loadInline, loadInNode];
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

  /** Module systems and resolutions of users. */
  const SETTINGS = [
    ["node16", "node16"],
    ["esnext", "bundler"],
  ];

  /** Compiles a file in the consumer's folder. @returns the compiler's output: empty if there is no error */
  function compile(file: string, text: string, options: Readonly<Record<string, unknown>>): string {
    writeFileSync(join(consumer.folder, file), text);
    const compilerOptions = {
      strict: true,
      noEmit: true,
      skipLibCheck: false,
      target: "es2022",
      lib: ["es2023", "dom"],
      types: [],
      ...options,
    };
    writeFileSync(join(consumer.folder, "tsconfig.json"), JSON.stringify({ compilerOptions, files: [file] }));
    const tsc = join(root, "node_modules", "typescript", "bin", "tsc");
    return spawnSync(process.execPath, [tsc, "-p", "."], { cwd: consumer.folder, encoding: "utf8" }).stdout;
  }

  /** Installs types of other packages, as the consumer does. */
  function installTypes(name: string): void {
    const folder = join(consumer.folder, "node_modules", "@types");
    mkdirSync(folder, { recursive: true });
    if (!existsSync(join(folder, name))) symlinkSync(join(root, "node_modules", "@types", name), join(folder, name));
  }

  test.each(SETTINGS)("serve users whose modules are %s and whose resolution is %s, without three.js", (...setting) => {
    const [module, moduleResolution] = setting;
    expect(compile("consumer.ts", text, { module, moduleResolution })).toBe("");
  });

  test.each(SETTINGS)("of characters serve users of three.js: %s, %s", (module, moduleResolution) => {
    installTypes("three");
    const figure = `import { bindCharacter, loadCharacter, type Character, type Role } from "strut-motion/three";
import { AnimationMixer, Group, type AnimationClip } from "three";
import type { StyledMotion } from "strut-motion";
export async function perform(group: Group, walk: StyledMotion): Promise<AnimationClip> {
  const character: Character = await loadCharacter("figure.vrm", { accept: ({ title }) => confirm(title) });
  const bound = await bindCharacter(group, { roles: { hips: "Pelvis" } });
  bound.apply(walk.poses.subarray(0, 87));
  group.add(character.object);
  const clip = character.toClip(walk);
  new AnimationMixer(character.object).clipAction(clip).play();
  return clip;
}
export const role: Role = "hips";
// @ts-expect-error: there is no such role
export const wrong: Role = "tail";
`;
    // The declarations of three.js may have errors.
    const options = { module, moduleResolution, skipLibCheck: true };
    expect(compile("figure.ts", figure, options)).toBe("");
  });

  test.each(SETTINGS)("of the element serve users of React 19: %s, %s", (module, moduleResolution) => {
    installTypes("react");
    const page = `import type {} from "strut-motion/jsx";
import { useRef } from "react";
import type { StrutPlayer } from "strut-motion/element";
export function Figure({ old }: { old: number }) {
  const player = useRef<StrutPlayer>(null);
  return (
    <strut-player
      ref={player}
      src="walk.bvh"
      styles={{ old }}
      autoplay
      ghost="off"
      onstylechange={({ detail }) => console.log(detail.styles.old)}
    >
      <p slot="fallback">A film instead</p>
    </strut-player>
  );
}
// @ts-expect-error: there is no such place
export const wrong = <strut-player ghost="behind" />;
`;
    expect(compile("page.tsx", page, { module, moduleResolution, jsx: "react-jsx" })).toBe("");
  });
});
