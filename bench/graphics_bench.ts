/**
 * The paper's exhaustive search on the GPU, compared with the engine's: runs after the other engines, on the same
 * database.
 */
import { clockResolution, timedOften } from "./clock";
import { type GraphicsComparison, type Report, type Row, summarise } from "./report";
import type { Workload } from "./workload";

/** Number of windows that are searched together in mode `batch`, and number of batches. */
const BATCH = 256;
const BATCHES = 4;
/** Number of windows that are searched one by one in mode `all`, and compared where times are not meaningful. */
const SINGLE = 64;
/** Number of first searches of each mode that are not measured: drivers finish their compilation late. */
const WARM_UP = 3;

/** A GPU that a page may use. */
export interface Card {
  /** Name, as far as the browser reports it. */
  name: string;
  /** Whether the GPU is emulated in software. */
  software: boolean;
}

/** Returns the fastest GPU of the page; `undefined` if there is none. */
export async function findCard(): Promise<Card | undefined> {
  const gpu: GPU | undefined = navigator.gpu;
  const adapter = await gpu?.requestAdapter({ powerPreference: "high-performance" }).catch(() => null);
  if (!adapter) return undefined;
  const { vendor, architecture, description, isFallbackAdapter } = adapter.info;
  const name = description || [vendor, architecture].filter((word) => word !== "").join(" ") || "unnamed";
  return { name, software: isFallbackAdapter };
}

/** Adds the measurements of a GPU to a report, with times only for a hardware GPU. Loads its package. */
export async function benchmarkGraphics(
  report: Report,
  { bytes, queries }: Workload,
  card: Card,
  onProgress: (done: number) => void,
): Promise<void> {
  const glue = await import("./pkg/gpu/strut_bench_gpu.js");
  const module = await (await fetch(new URL("./pkg/gpu/strut_bench_gpu_bg.wasm", import.meta.url))).arrayBuffer();
  glue.initSync({ module });
  const yardstick = await glue.Yardstick.open(bytes);
  for (const { poses } of queries) yardstick.add(poses);
  const windows = yardstick.windows();
  const { frames } = report.rows[0]!;
  const classes = yardstick.classes();

  const numbers = (count: number) => Array.from({ length: count }, (_, i) => i);
  const single = Math.min(SINGLE, windows);
  const batch = Math.min(BATCH, windows);
  const alone = numbers(single).map((i) => ({ first: Math.floor((i * windows) / single), count: 1 }));
  const together = numbers(Math.min(BATCHES, Math.floor(windows / batch))).map((i) => ({
    first: i * batch,
    count: batch,
  }));
  const rounds = card.software ? [alone] : [alone, together];
  const work = rounds.flat().length + WARM_UP * rounds.length;
  let done = 0;
  const times: number[][] = [];
  for (const searches of rounds) {
    const all: number[] = [];
    for (const { first, count } of [...searches.slice(0, WARM_UP), ...searches]) {
      const began = performance.now();
      await yardstick.search(first, count);
      all.push((performance.now() - began) / count);
      onProgress(done++ / work);
    }
    times.push(all.slice(Math.min(WARM_UP, searches.length)));
  }

  const compared = rounds.at(-1)!.flatMap(({ first, count }) => numbers(count).map((i) => first + i));
  const identical = compared.reduce((sum, window) => sum + yardstick.identical(window), 0);
  const comparison: GraphicsComparison = {
    adapter: card.name,
    driver: "",
    backend: "WebGPU",
    software: card.software,
    frames,
    classes,
    sets: compared.length * classes,
    identical,
    candidates_per_neighbour: yardstick.candidatesPerNeighbour(),
  };
  if (identical < comparison.sets) throw new Error(`The GPU found different neighbours: ${JSON.stringify(comparison)}`);
  const row = (engine: Row["engine"], mode: Row["mode"], samples: number[]): Row => {
    const measured = { stage: "search", mode, engine, frames, classes, ...summarise(samples) };
    report.rows.push(measured);
    return measured;
  };
  const [ofOne, ofBatches] = times;
  if (ofOne && ofBatches) {
    const resolution = clockResolution();
    const ours = compared.map((window) => timedOften(() => yardstick.searchByEngine(window), resolution));
    const engine = row("wasm-simd", "batch", ours);
    const ratio = ({ median_ms }: Row) => median_ms / engine.median_ms;
    comparison.engine_is_faster = {
      all: ratio(row("gpu-brute", "all", ofOne)),
      batch: ratio(row("gpu-brute", "batch", ofBatches)),
    };
  }
  report.gpu = comparison;
  yardstick.free();
}
