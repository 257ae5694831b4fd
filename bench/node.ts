/** The benchmark in Node: what `run.mjs` calls. */
import { readFile } from "node:fs/promises";
import { cpus, platform } from "node:os";
import { benchmark } from "./benchmark";
import { loadInstances } from "./engines";
import type { Report } from "./report";
import type { Source } from "./workload";

export { PAPER_FRAMES } from "./benchmark";
export { document } from "./document";
export { text } from "./table";

/** Runs it with everything in this process, telling `onProgress` what is being done. */
export async function benchmarkInNode(
  source: Source,
  onProgress: (what: string, done: number) => void,
): Promise<Report> {
  const instances = await loadInstances(async (url) => WebAssembly.compile(new Uint8Array(await readFile(url))));
  const [cpu] = cpus();
  const machine = `${cpu?.model.trim() ?? process.arch}, ${cpus().length} threads, ${platform()}, Node ${process.versions.node}`;
  return benchmark(instances, source, { machine, onProgress });
}
