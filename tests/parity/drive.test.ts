/** Scripted driving, natively and with the packages that visitors load: the same bits in every frame. */
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { gunzipSync } from "node:zlib";
import { afterAll, beforeAll, expect, test } from "vitest";
import { DriverFrame, SPEED } from "../../web/engine/drive/driver";
import { POSE_FLOATS } from "../../web/humanoid";
import { buildPrograms, COMMAND, DRIVE } from "../programs";

/** A minute, or STRUT_DRIVE_FRAMES: ten minutes are 36,000. */
const FRAMES = Number(process.env.STRUT_DRIVE_FRAMES ?? 3600);
const RATE_HZ = 60;
/** Number of floats of a driver's frame, and of one with the styled pose. */
const DRIVEN = new DriverFrame().numbers.length;
const NUMBERS = DRIVEN + POSE_FLOATS;

/** Controls of a frame, and a `path` that starts in it. */
interface Asked {
  move: [number, number];
  gait: number;
  face?: number;
  action?: number;
  weights: number[];
  path?: number[];
}

let folder: string;
beforeAll(() => {
  buildPrograms();
  folder = mkdtempSync(join(tmpdir(), "strut-drive-"));
  execFileSync(COMMAND, ["demo-db", "-o", "demo.strutdb"], { cwd: folder, stdio: "pipe" });
  writeFileSync(join(folder, "takes"), takes());
}, 900_000);
afterAll(() => {
  rmSync(folder, { recursive: true, force: true });
});

const takes = () => gunzipSync(readFileSync(new URL("../../web/engine/motions/drive.bin", import.meta.url)));

/**
 * Returns a script that walks, runs, turns in place and about, stands, jumps, punches and kicks, follows a path, and
 * changes styles meanwhile.
 */
function script(styles: number): Asked[] {
  return Array.from({ length: FRAMES }, (_, frame) => {
    const secs = frame / RATE_HZ;
    const way = Math.floor(secs / 4) * 2.1 + Math.sin(secs);
    const stands = Math.floor(secs) % 9 > 6;
    const asked: Asked = {
      move: stands ? [0, 0] : [Math.fround(Math.sin(way)), Math.fround(Math.cos(way))],
      gait: Math.fround(1 + 0.5 * (1 + Math.sin(secs / 3))),
      weights: Array.from({ length: styles }, (_, i) => Math.fround(0.4 * Math.max(0, Math.sin(secs / 2 + i)))),
    };
    if (stands) asked.face = Math.fround(way + 1.5);
    if (frame % 400 === 390) asked.action = ((frame / 400) % 3) | 0;
    if (frame === 2000) {
      const round = Array.from({ length: 120 }, (_, i) => [2 * Math.sin(i / 10), 2 - 2 * Math.cos(i / 10)]);
      asked.path = round.flat().map(Math.fround);
    }
    if (frame === 2900) asked.path = [];
    return asked;
  });
}

/** Returns the native driver's and stylizer's output of a script. */
function natively(asked: readonly Asked[]): Float32Array {
  const lines = asked.flatMap(({ move, gait, face, action, weights, path }) => [
    ...(path ? [`path ${path.join(" ")}`] : []),
    [...move, gait, face ?? "-", action ?? "-", ...weights].join(" "),
  ]);
  writeFileSync(join(folder, "script"), lines.join("\n"));
  execFileSync(DRIVE, ["demo.strutdb", "takes", "script", "out"], { cwd: folder, stdio: "pipe" });
  const bytes = readFileSync(join(folder, "out"));
  return new Float32Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength));
}

async function glueOf(pkg: string, name: string) {
  const at = new URL(`../../${pkg}/`, import.meta.url);
  const glue = await import(/* @vite-ignore */ new URL(`${name}.js`, at).href);
  glue.initSync({ module: readFileSync(new URL(`${name}_bg.wasm`, at)) });
  return glue;
}

/** Returns the packages' output of the script. */
async function byPackages(asked: (styles: number) => readonly Asked[]): Promise<Float32Array> {
  const engine: typeof import("../../web/engine/pkg/strut_wasm.js") = await glueOf("web/engine/pkg", "strut_wasm");
  const driving: typeof import("../../web/engine/drive/pkg/strut_drive.js") = await glueOf(
    "web/engine/drive/pkg",
    "strut_drive",
  );
  const database = engine.Database.fromBytes(readFileSync(join(folder, "demo.strutdb")));
  const clips = new driving.Clips(database.proportions(), database.rateHz());
  const { Own, Takes } = driving.Among;
  const others = engine.Database.fromPacked(new engine.PackedMotions(takes()));
  for (const [among, of] of [[Own, database] as const, [Takes, others] as const])
    for (const clip of of.neutralClips())
      clips.add(
        among,
        of.clipName(clip),
        of.clipAction(clip),
        of.clipPoses(clip),
        of.clipContacts(clip),
        of.proportions(),
        of.rateHz(),
      );
  const driver = new driving.Driver(clips);
  const stylizer = new engine.Stylizer(database);
  const frames = asked(database.styles().length);
  const out = new Float32Array(NUMBERS * frames.length);
  const numbers = new Float32Array(DRIVEN);
  let hips: [number, number] | undefined;
  for (const [frame, { move, gait, face, action, weights, path }] of frames.entries()) {
    if (path) driver.setPath(Float32Array.from(path));
    driver.next(...move, gait, face, action, hips?.[0], hips?.[1]);
    driver.read(numbers);
    stylizer.setStyles(Float32Array.from(weights));
    stylizer.setStyleShare(numbers.at(-1)!);
    const styled = stylizer.push(numbers.slice(0, POSE_FLOATS));
    hips = [styled[0]!, styled[2]!];
    out.set(numbers, NUMBERS * frame);
    out.set(styled, NUMBERS * frame + DRIVEN);
  }
  return out;
}

/** Returns the first frame whose bits differ; −1 if none does. */
function firstDifference(a: Float32Array, b: Float32Array): number {
  const [left, right] = [a, b].map(({ buffer, byteOffset, length }) => new Uint32Array(buffer, byteOffset, length));
  const at = left!.findIndex((bits, i) => bits !== right![i]);
  return at < 0 ? -1 : Math.floor(at / NUMBERS);
}

test("scripted driving has the same bits", { timeout: 600_000 }, async () => {
  let asked: Asked[] = [];
  const page = await byPackages((styles) => {
    asked = script(styles);
    return asked;
  });
  const native = natively(asked);
  expect(native.length).toBe(NUMBERS * FRAMES);
  expect(firstDifference(page, native)).toBe(-1);

  // The script contains everything that it should.
  const column = (at: number) => Array.from({ length: FRAMES }, (_, frame) => page[NUMBERS * frame + at]!);
  const speeds = column(SPEED);
  expect([Math.min(...speeds) < 0.1, Math.max(...speeds) > 1.8]).toEqual([true, true]);
  const moves = column(SPEED + 6);
  expect(new Set(moves)).toEqual(new Set([0, 1, 2, 3]));

  // A changed control in a single frame is detected, if the character responds to it.
  const goes = (frame: number) => asked[frame]!.move.some((axis) => axis !== 0) && moves[frame] === 0;
  const at = moves.findIndex((_, frame) => frame > 1000 && Array.from({ length: 90 }, (_, i) => frame - i).every(goes));
  const changed = asked.map((of, frame) => (frame === at ? { ...of, gait: of.gait - 0.25 } : of));
  expect([at > 1000, firstDifference(page, natively(changed))]).toEqual([true, at]);
});
