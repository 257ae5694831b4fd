/** The benchmark: the engine with and without SIMD and two yardsticks on the same motion, in one run. */
import { EngineBench } from "./engine_bench";
import type { Instances } from "./engines";
import { NaiveTransfer } from "./naive";
import { ENGINES, MODES, type Report } from "./report";
import { readStrutdb } from "./strutdb";
import { makeWorkload, type Source } from "./workload";
import { measureYardstick } from "./yardstick_bench";

/** Frames of the database that the paper's Table 2 was measured on. */
export const PAPER_FRAMES = 79_829;

export interface Options {
  /** Name of the machine. */
  machine: string;
  /** Hears what is being done and which share of the work is behind it. */
  onProgress?: (what: string, done: number) => void;
  /** Stops the run, which then rejects with the signal's reason. */
  signal?: AbortSignal;
}

/** Runs it. */
export async function benchmark(instances: Instances, source: Source, options: Options): Promise<Report> {
  const { machine, onProgress = () => {}, signal } = options;
  let turns = 0;
  let work = 1;
  /** Tells how far it is, and lets the thread hear whether this is still wanted. */
  const turn = async (what: string) => {
    onProgress(what, turns++ / work);
    await new Promise((resolve) => setTimeout(resolve));
    signal?.throwIfAborted();
  };

  await turn("Making a database");
  const workload = makeWorkload(instances.simd.glue, source);
  work = workload.queries.length * MODES.length * ENGINES.length;
  const report: Report = { machine, rows: [], agreement: [], memory: [] };
  for (const [engine, instance] of [
    ["wasm-simd", instances.simd],
    ["wasm-scalar", instances.scalar],
  ] as const) {
    const bench = new EngineBench(instance, engine, workload, report);
    try {
      for (const mode of MODES) await bench.measure(mode, () => turn(`${engine}, ${mode}`));
      bench.measureMemory();
    } finally {
      bench.free();
    }
  }

  const { glue } = instances.simd;
  const database = glue.Database.fromBytes(workload.bytes);
  const target = database.neutral();
  const yardsticks = {
    "wasm-naive": () => new glue.Naive(database, target),
    "js-naive": () => new NaiveTransfer(readStrutdb(workload.bytes), target, glue.jointWeights()),
  } as const;
  for (const engine of ["wasm-naive", "js-naive"] as const) {
    const yardstick = yardsticks[engine]();
    for (const mode of MODES)
      await measureYardstick(yardstick, engine, mode, instances.simd, database, workload, report, () =>
        turn(`${engine}, ${mode}`),
      );
  }
  database.free();
  return report;
}
