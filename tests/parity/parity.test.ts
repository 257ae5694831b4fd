/**
 * The engine gives the same bits natively, in WebAssembly with SIMD and without: `rust/strut-wasm/src/parity.rs` compiled
 * all three ways, over whole clips and every stage. The modules are built as the one that the page loads is, plus the
 * report.
 */
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { basename, join } from "node:path";
import { beforeAll, describe, expect, test } from "vitest";
import { buildPrograms, REPORT } from "../programs";
import { recordings, root } from "../recordings";
import { firstDifference } from "./compare";

/** Real clips of every skeleton there is; four of one cast, to be registered with each other. */
const REAL_CLIPS = [
  "bandai-namco-2/dataset-2_walk_normal_001.bvh",
  "bandai-namco-2/dataset-2_walk_normal_002.bvh",
  "bandai-namco-2/dataset-2_walk_elderly_001.bvh",
  "bandai-namco-2/dataset-2_walk_elderly_002.bvh",
  "bandai-namco-1/dataset-1_bow_angry_001.bvh",
  "xia/angry_01_000.bvh",
  "cmu/female-walk.bvh",
];

const mocap = recordings();
const clips = mocap ? REAL_CLIPS.map((clip) => join(mocap, clip)) : [];

/** As much of the package as is used here; it is built by this test, so that its own types may not be there yet. */
interface ParityGlue {
  initSync(source: { module: BufferSource }): unknown;
  ParityReport: new () => {
    addFile(name: string, bytes: Uint8Array): void;
    run(nudgedFrame?: number): string;
    free(): void;
  };
}

/** The report of a build; `nudgedFrame` changes the input of that frame by the least there is. */
async function wasmReport(build: "simd" | "scalar", files: string[], nudgedFrame?: number): Promise<string> {
  const folder = new URL(`../../bench/pkg/${build}/`, import.meta.url);
  const glue: ParityGlue = await import(/* @vite-ignore */ new URL("strut_bench.js", folder).href);
  glue.initSync({ module: readFileSync(new URL("strut_bench_bg.wasm", folder)) });
  const report = new glue.ParityReport();
  try {
    for (const path of files) report.addFile(basename(path), readFileSync(path));
    return report.run(nudgedFrame);
  } finally {
    report.free();
  }
}

describe("native and WASM", () => {
  let native: string;
  beforeAll(() => {
    execFileSync(process.env.CARGO ?? "cargo", ["run", "--quiet", "--profile", "tool", "-p", "xtask", "--", "bench"], {
      cwd: join(root, "rust"),
    });
    buildPrograms();
    native = execFileSync(REPORT, clips, { encoding: "utf8", maxBuffer: 1 << 28 });
  }, 900_000);

  test("give the same bits at every stage of every frame", { timeout: 600_000 }, async () => {
    const stages = native.trimEnd().split("\n");
    expect(stages.length).toBeGreaterThanOrEqual(9 * (2 + clips.length) + 6 * (clips.length ? 4 : 3) + 2);
    expect(firstDifference(native, await wasmReport("simd", clips))).toBeUndefined();
  });

  test("give the same bits without SIMD as well", { timeout: 600_000 }, async () => {
    expect(firstDifference(native, await wasmReport("scalar", clips))).toBeUndefined();
  });

  test("a change of one bit in one frame does not go unnoticed", { timeout: 600_000 }, async () => {
    const mutated = await wasmReport("simd", [], 100);
    expect(firstDifference(native, mutated)).toEqual({ stage: "neutral-walk/retargeted", frame: 100 });
    // Height is a degree of freedom, so its last bit must arrive; a distance may round it away.
    const hashes = (report: string) => /^neutral-walk\/rows (.*)$/m.exec(report)![1]!.split(" ");
    const [before, after] = [hashes(native), hashes(mutated)];
    expect(after.slice(0, 100), "earlier frames do not depend on it").toEqual(before.slice(0, 100));
    expect(after[100]).not.toBe(before[100]);
  });
});

test("a difference is named by stage and frame", () => {
  const report = "walk/rows 1 2 3\nwalk/search 4 5 6\n";
  expect(firstDifference(report, report)).toBeUndefined();
  expect(firstDifference(report, report.replace("5", "7"))).toEqual({ stage: "walk/search", frame: 1 });
  expect(firstDifference(report, "walk/rows 1 2 3\n")).toEqual({ stage: "walk/search", frame: -1 });
  expect(firstDifference(report, report.replace(" 3", ""))).toEqual({ stage: "walk/rows", frame: -1 });
});
