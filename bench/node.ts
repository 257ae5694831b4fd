/** The benchmark in Node, called by `run.mjs`. */
import { readFile } from "node:fs/promises";
import { cpus, platform } from "node:os";
import { benchmark } from "./benchmark";
import { type ClipRow, timeClips } from "./clips";
import { loadInstances } from "./engines";
import { type LargeReport, measureLarge } from "./large";
import type { Report } from "./report";
import { makeWorkload, type Source } from "./workload";

export { PAPER_FRAMES } from "./benchmark";
export { clipLines } from "./clips";
export { document } from "./document";
export { LARGE_FRAMES, largeLines } from "./large";
export { text } from "./table";

/** Measures whole clips in this process. */
export async function clipsInNode(source: Source): Promise<ClipRow[]> {
  return timeClips((await instances()).simd, source);
}

/** Measures a large database in this process. */
export async function largeInNode(file: Uint8Array): Promise<LargeReport> {
  return measureLarge((await instances()).simd, file);
}

/** Runs the benchmark in this process, and reports the present work to `onProgress`. */
export async function benchmarkInNode(
  source: Source,
  onProgress: (what: string, done: number) => void,
): Promise<Report> {
  const [cpu] = cpus();
  const machine = `${cpu?.model.trim() ?? process.arch}, ${cpus().length} threads, ${platform()}, Node ${process.versions.node}`;
  const engines = await instances();
  onProgress("Generating a database", 0);
  return benchmark(engines, makeWorkload(engines.simd.glue, source), { machine, onProgress });
}

const instances = () => loadInstances(async (url) => WebAssembly.compile(new Uint8Array(await readFile(url))));
