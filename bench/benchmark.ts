/** The benchmark: the engine with and without SIMD and two reference implementations on the same motion, in one run. */
import { EngineBench } from "./engine_bench";
import type { Instances } from "./engines";
import { NaiveTransfer } from "./naive";
import { ENGINES, type EngineName, MODES, type Report } from "./report";
import { readStrutdb } from "./strutdb";
import type { Workload } from "./workload";
import { YardstickBench } from "./yardstick_bench";

/** Number of frames of the database of the paper's Table 2. */
export const PAPER_FRAMES = 79_829;

export interface Options {
  /** Name of the machine. */
  machine: string;
  /** Receives the present work and the share of the work that is done. */
  onProgress?: (what: string, done: number) => void;
}

/** Runs the benchmark, which takes minutes. To stop it, end its thread. */
export function benchmark(instances: Instances, workload: Workload, { machine, onProgress }: Options): Report {
  const report: Report = { machine, rows: [], agreement: [], memory: [] };
  const { glue } = instances.simd;
  const engines = {
    "wasm-simd": new EngineBench(instances.simd, "wasm-simd", workload, report),
    "wasm-scalar": new EngineBench(instances.scalar, "wasm-scalar", workload, report),
  };
  const database = glue.Database.fromBytes(workload.bytes);
  const target = database.neutral();
  const naive = new NaiveTransfer(readStrutdb(workload.bytes), target, glue.jointWeights(), glue.legJoints());
  const plain = new glue.Naive(workload.bytes, target);
  const benches = {
    ...engines,
    "wasm-naive": new YardstickBench(plain, "wasm-naive", instances.simd, database, report),
    "js-naive": new YardstickBench(naive, "js-naive", instances.simd, database, report),
  } satisfies Record<EngineName, unknown>;

  // Interleaved, so that other load on the machine affects all of them equally.
  const work = ENGINES.length * MODES.length * workload.queries.length;
  let turns = 0;
  for (const mode of MODES)
    for (const query of workload.queries)
      for (const engine of ENGINES) {
        onProgress?.(`${mode}: ${engine}`, turns++ / work);
        benches[engine].measure(mode, query);
      }
  for (const engine of ENGINES) benches[engine].finish();
  database.free();
  return report;
}
