/** The benchmark: the engine with and without SIMD and two yardsticks on the same motion, in one run. */
import { EngineBench } from "./engine_bench";
import type { Instances } from "./engines";
import { NaiveTransfer } from "./naive";
import { ENGINES, type EngineName, MODES, type Mode, type Report } from "./report";
import { readStrutdb } from "./strutdb";
import { makeWorkload, type Source } from "./workload";
import { YardstickBench } from "./yardstick_bench";

/** Frames of the database that the paper's Table 2 was measured on. */
export const PAPER_FRAMES = 79_829;

export interface Options {
  /** Name of the machine. */
  machine: string;
  /** Hears what is being done and which share of the work is behind it. */
  onProgress?: (what: string, done: number) => void;
}

/** Runs it: minutes. Who wants to stop it ends its thread. */
export function benchmark(instances: Instances, source: Source, { machine, onProgress }: Options): Report {
  onProgress?.("Making a database", 0);
  const workload = makeWorkload(instances.simd.glue, source);
  const report: Report = { machine, rows: [], agreement: [], memory: [] };
  const work = ENGINES.length * MODES.length * workload.queries.length;
  let turns = 0;
  const turn = (engine: EngineName, mode: Mode) => onProgress?.(`${engine}, ${mode}`, turns++ / work);

  for (const [engine, instance] of [
    ["wasm-simd", instances.simd],
    ["wasm-scalar", instances.scalar],
  ] as const) {
    const bench = new EngineBench(instance, engine, workload, report);
    for (const mode of MODES) bench.measure(mode, () => turn(engine, mode));
    bench.measureMemory();
    bench.free();
  }

  const { glue } = instances.simd;
  const database = glue.Database.fromBytes(workload.bytes);
  const target = database.neutral();
  const yardsticks = {
    "wasm-naive": () => new glue.Naive(database, target),
    "js-naive": () => new NaiveTransfer(readStrutdb(workload.bytes), target, glue.jointWeights()),
  } as const;
  for (const engine of ["wasm-naive", "js-naive"] as const) {
    const bench = new YardstickBench(yardsticks[engine](), engine, instances.simd, database, workload, report);
    for (const mode of MODES) bench.measure(mode, () => turn(engine, mode));
  }
  database.free();
  return report;
}
