/**
 * A lens shows the same values for a frame as `strut stylize --trace`, whose search, weights and durations are the
 * native ones.
 */
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, beforeAll, expect, test } from "vitest";
import { Engine } from "../../web/engine/engine";
import { Lens } from "../../web/engine/learn/lens";
import { Warps } from "../../web/engine/learn/warps";
import { serveLearnPackage } from "../../web/engine/learn/wasm";
import { buildPrograms, COMMAND } from "../programs";

const CLIP = "demo/walk_neutral_001.bvh";
const STYLE = "old";
/** A frame after a turn of the heading, one near the start, and one near the end. */
const FRAMES = [8, 160, 301, 700];

/**
 * Rounding of squared distances, m²: they are differences of squared norms of about 1 m², for which single precision
 * has an error of 1.2e-7, and a lens is warmed up on other frames than the command. Its root is a third of a millimetre
 * at distance 0.
 */
const ROUNDING = 3e-7;

/** A line of the trace. */
interface Traced {
  frame: number;
  dt: number;
  class_weights: Record<string, number>;
  neighbours: [clip: string, frame: number, distance: number][];
}

let folder: string;
let traced: Traced[];
beforeAll(() => {
  buildPrograms();
  folder = mkdtempSync(join(tmpdir(), "strut-lens-"));
  const run = (...args: string[]) => execFileSync(COMMAND, args, { cwd: folder, stdio: "pipe" });
  run("demo-db", "-o", "demo.strutdb", "--bvh", "demo");
  const files = ["--db", "demo.strutdb", "--input", CLIP, "--trace", "trace.jsonl", "-o", "out.bvh"];
  run("stylize", "--style", STYLE, ...files);
  const lines = readFileSync(join(folder, "trace.jsonl"), "utf8").trimEnd().split("\n");
  traced = lines.map((line) => JSON.parse(line) as Traced);
}, 900_000);
afterAll(() => {
  rmSync(folder, { recursive: true, force: true });
});

async function openLens() {
  serveLearnPackage();
  const engine = await Engine.load();
  const bytes = (name: string) => new Uint8Array(readFileSync(join(folder, name))).buffer;
  const database = engine.openDatabase({ kind: "strutdb", name: "demo", bytes: bytes("demo.strutdb") });
  const input = engine.openInput(database, { kind: "bvh", name: CLIP, bytes: bytes(CLIP) });
  const styles = Float32Array.from(database.info.styles, (style) => (style === STYLE ? 1 : 0));
  return { database, lens: new Lens(database, input, styles) };
}

test("neighbours, weights and durations of a frame are those of the command's trace", async () => {
  const { database, lens } = await openLens();
  const warps = new Warps(database, 0);
  const firstRows = new Map(warps.clipNames().map((name, clip) => [name, warps.rows(clip).first]));
  for (const frame of FRAMES) {
    const { neighbours, class_weights, dt } = traced[frame]!;
    expect(lens.at(frame)).toBe(frame);
    const found = lens.neighbours(lens.heaviestClass()!, neighbours.length);
    expect([...found.rows]).toEqual(neighbours.map(([clip, at]) => firstRows.get(clip)! + at));
    found.distances.forEach((distance, i) => {
      expect(Math.abs(distance ** 2 - neighbours[i]![2] ** 2)).toBeLessThan(ROUNDING);
    });
    const { weights } = lens.classes();
    database.info.classes.forEach(({ action, style }, i) => {
      // The trace omits weights below 1e-4.
      const traced = class_weights[`${action}/${style}`];
      if (traced === undefined) expect(weights[i]).toBeLessThan(1e-4);
      else expect(weights[i]).toBeCloseTo(traced, 5);
    });
    // The lens is warmed up on sixty frames, the command on all.
    expect(lens.stepSecs()).toBeCloseTo(dt, 4);
    expect(lens.timing(database.info.styles.indexOf(STYLE)).duration).toBeGreaterThan(0);
  }
}, 120_000);

test("the frame after shows other neighbours", async () => {
  const { lens } = await openLens();
  lens.at(161);
  const of = traced[160]!.neighbours.map(([, , distance]) => distance);
  const { distances } = lens.neighbours(lens.heaviestClass()!, of.length);
  expect(distances.some((distance, i) => Math.abs(distance - of[i]!) > 1e-4)).toBe(true);
}, 120_000);
