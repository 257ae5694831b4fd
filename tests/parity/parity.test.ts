/**
 * The engine computes the same bits natively, and in WebAssembly with SIMD and without: `rust/strut-wasm/src/engine/parity.rs`
 * compiled in three ways, over whole clips and every stage. The modules are built as the page's module is, plus the
 * report.
 */
import { execFile } from "node:child_process";
import { join } from "node:path";
import { promisify } from "node:util";
import { beforeAll, describe, expect, test } from "vitest";
import { buildPrograms, REPORT } from "../programs";
import { recordings } from "../recordings";
import { firstDifference } from "./compare";

/** Real clips of every available skeleton; two have the same actor, to be registered with each other. */
const REAL_CLIPS = [
  "bandai-namco-2/dataset-2_walk_normal_001.bvh",
  "bandai-namco-2/dataset-2_walk_elderly_001.bvh",
  "bandai-namco-1/dataset-1_bow_angry_001.bvh",
  "xia/angry_01_000.bvh",
  "cmu/female-walk.bvh",
];

const mocap = recordings();
const clips = mocap ? REAL_CLIPS.map((clip) => join(mocap, clip)) : [];

const run = promisify(execFile);

/** Returns the output of a program. */
async function printed(program: string, args: readonly string[]): Promise<string> {
  return (await run(program, args, { encoding: "utf8", maxBuffer: 1 << 28 })).stdout;
}

/** Returns the report of a WASM build. `nudgedFrame` changes the input of that frame by one unit in the last place. */
function wasmReport(build: "simd" | "scalar", nudgedFrame?: number): Promise<string> {
  const nudge = nudgedFrame === undefined ? [] : ["--nudge", String(nudgedFrame)];
  return printed(process.execPath, [join(import.meta.dirname, "report.mjs"), build, ...nudge, ...clips]);
}

/** Returns a hash for each frame's row of degrees of freedom, by input. */
function rowHashes(report: string): Map<string, string[]> {
  return new Map([...report.matchAll(/^(\S+)\/rows (.*)$/gm)].map(([, input, all]) => [input!, all!.split(" ")]));
}

describe("native and WASM", () => {
  /** The changed frame. */
  const NUDGED = 100;
  let native: string;
  let reports: Record<"simd" | "scalar", string>;
  let nudged: string;
  beforeAll(async () => {
    buildPrograms();
    // Each uses one core for a while.
    const [ofNative, simd, scalar, ofNudged] = await Promise.all([
      printed(REPORT, clips),
      wasmReport("simd"),
      wasmReport("scalar"),
      wasmReport("simd", NUDGED),
    ]);
    native = ofNative;
    reports = { simd, scalar };
    nudged = ofNudged;
  }, 900_000);

  test("the report covers every stage of every input", () => {
    const stages = native.trimEnd().split("\n");
    expect(stages.length).toBeGreaterThanOrEqual(9 * (2 + clips.length) + 6 * (clips.length ? 4 : 3) + 3);
  });

  test.each(["simd", "scalar"] as const)("%s gives the same bits at every stage of every frame", (build) => {
    expect(firstDifference(native, reports[build])).toBeUndefined();
  });

  test("a change of one bit in one frame is not hidden, whatever the input", () => {
    expect(firstDifference(native, nudged)).toEqual({ stage: "neutral-walk/retargeted", frame: NUDGED });
    // Height is a degree of freedom, so the change of its last bit must be visible; a distance may round it away.
    const [before, after] = [rowHashes(native), rowHashes(nudged)];
    expect(before.size).toBeGreaterThan(clips.length);
    for (const [input, rows] of before) {
      const changed = after.get(input)!;
      expect(changed.slice(0, NUDGED), `${input}: earlier frames do not depend on it`).toEqual(rows.slice(0, NUDGED));
      if (rows.length > NUDGED) expect(changed[NUDGED], input).not.toBe(rows[NUDGED]);
    }
  });
});

test("a difference is named by stage and frame", () => {
  const report = "walk/rows 1 2 3\nwalk/search 4 5 6\n";
  expect(firstDifference(report, report)).toBeUndefined();
  expect(firstDifference(report, report.replace("5", "7"))).toEqual({ stage: "walk/search", frame: 1 });
  expect(firstDifference(report, "walk/rows 1 2 3\n")).toEqual({ stage: "walk/search", frame: -1 });
  expect(firstDifference(report, report.replace(" 3", ""))).toEqual({ stage: "walk/rows", frame: -1 });
});
